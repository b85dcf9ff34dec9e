"""The running node: rate, jitter, latency, processor time; compared with a bare rospy node."""

import live
import numpy as np
import pytest
from live import BARE_NODE, FAKE_TURTLEBOT, PERIOD_NS, lost_periods, observe, topics_of

from tutorial_testing.claims import claim

pytestmark = claim("The simulator's figures, of a class that scans too")
MESSAGES = ["/odom", "/tf", "/joint_states"]
BEAMS, ROBOTS, SECONDS, MOST_LOAD = 640, 30, 20, 0.3  # a whole class that scans


@pytest.fixture(scope="module", autouse=True)
def ros_master():
    with live.master():
        yield


def test_a_minute_of_one_robot(figure):
    heard, _ = observe([FAKE_TURTLEBOT], MESSAGES, 60)
    stamps = np.array(heard["/odom"]["stamps"])
    elapsed_ns = stamps - stamps[0]
    rate = (len(stamps) - 1) / (elapsed_ns[-1] * 1e-9)
    # The distance of each stamp from a grid of exact periods through their median.
    off = elapsed_ns - np.rint(elapsed_ns / PERIOD_NS) * PERIOD_NS
    jitter_ms = np.quantile(np.abs(off - np.median(off)), 0.99) * 1e-6
    gap_ms = max(np.diff(heard["/odom"]["arrivals"]).max(), np.diff(stamps).max()) * 1e-6
    figure("rate over a minute", f"{rate:.3f} Hz", "50 ± 0.1 Hz")
    figure("jitter, 99 of 100 messages", f"{jitter_ms:.2f} ms", "≤ 2 ms")
    figure("longest gap", f"{gap_ms:.1f} ms", "≤ 30 ms")
    assert abs(rate - 50) <= 0.1
    assert jitter_ms <= 2
    assert gap_ms <= 30


def test_a_new_command_shows_at_once(figure):
    with live.running(FAKE_TURTLEBOT):
        took_s = live.delays("cmd_vel", 13.7, 200)  # at any moment of the period
    median_ms, worst_ms = np.quantile(took_s, [0.5, 0.99]) * 1e3
    what = "command to /odom, median and 99 of 100"
    figure(what, f"{median_ms:.1f}, {worst_ms:.1f} ms", "≤ 25 ms")
    assert worst_ms <= 25


def test_processor_time_beside_a_bare_node(figure):
    ours_s = bare_s = 0.0
    for _ in range(2):  # alternating, so that other load affects both
        bare_s += observe([BARE_NODE], MESSAGES, 20)[1][0]
        ours_s += observe([FAKE_TURTLEBOT], [*MESSAGES, "/diagnostics"], 20)[1][0]
    ratio = ours_s / bare_s
    figure("processor time, one robot / bare rospy node", f"{ratio:.2f}", "≤ 1.15")
    assert ratio <= 1.15


def test_growth_with_the_number_of_robots(figure):
    loads = {}
    for count in (10, 100):
        robots = [*FAKE_TURTLEBOT, f"_robots:={count}"]
        heard, (loads[count],) = observe([robots], topics_of(count, "odom"), 20)
    lost = lost_periods(heard)
    figure("100 robots, odometry and TF", f"{loads[100]:.0%} of a core, {lost} periods lost", "0")
    figure("processor time, 100 / 10 robots", f"{loads[100] / loads[10]:.1f}", "≤ 10")
    assert lost == 0
    assert loads[100] <= 10 * loads[10]


def test_a_class_that_scans_in_the_maze(figure):
    robots = [*FAKE_TURTLEBOT, "_world:=maze", f"_robots:={ROBOTS}"]
    heard, (load,) = observe([robots], topics_of(ROBOTS, "odom", "scan"), SECONDS)
    lost = lost_periods({name: heard[name] for name in topics_of(ROBOTS, "odom")[1:]})
    rate = sum(len(heard[name]["arrivals"]) for name in topics_of(ROBOTS, "scan")[1:]) / SECONDS
    shown = f"{rate:,.0f} scans a second, {lost} periods lost, {load:.0%} of a core"
    figure(f"{ROBOTS} robots that scan with {BEAMS} beams in the maze", shown, "0 lost, ≤ 30 %")
    assert lost == 0
    assert rate > 0.98 * ROBOTS * 10
    assert load <= MOST_LOAD
