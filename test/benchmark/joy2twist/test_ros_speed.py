"""The running node beside a bare rospy relay, in one run. Its table is in the package's README.

Ratios, because they hold on any machine; the relays take turns, because machines change.
"""

import json
import statistics
import subprocess
import sys
from pathlib import Path

import pytest
from live import FAKE_TURTLEBOT, master, processor_time, running

HERE = Path(__file__).parent
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
RELAYS = {
    "bare rospy relay": [str(HERE / "bare_relay.py")],
    "step 2 of the tutorial": ["rosrun", "joy2twist", "publish_twist.py"],
    "joy2twist.py, all safety on": [
        "rosrun", "joy2twist", "joy2twist.py", "_enable_button:=4", "_enable_turbo_button:=5",
        "_arm_on_neutral:=true", "_max_joy_age:=0.5", "_max_linear_speed:=5.0",
        "_max_angular_speed:=5.0",
    ],
}  # fmt: skip
LOADS = {50: 250, 1000: 4000}  # rate [Hz]: messages
ROUNDS = 3
BASE = [*FAKE_TURTLEBOT, "_rate:=500"]  # its odometry is frequent enough to time the wheels by
PUSHES = 100
MOST = 1.5  # times the latency through a bare relay


@pytest.fixture(scope="module", autouse=True)
def ros_master():
    with master():
        yield


def probed(program, *arguments):
    """Return what a probe of this folder prints as JSON."""
    command = [sys.executable, str(HERE / program), *map(str, arguments)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True, timeout=120)
    return json.loads(done.stdout)


def median_and_p99(latency_s):
    """Return the two of a sorted list."""
    return latency_s[len(latency_s) // 2], latency_s[len(latency_s) * 99 // 100]


def relayed(command):
    """Return, by rate: median and 99th percentile [us], processor time of a message [us]."""
    figures = {}
    with running(command, **QUIET) as relay:
        for rate, count in LOADS.items():
            used_s = processor_time(relay.pid)
            heard = probed("probe.py", rate, count)
            used_s = processor_time(relay.pid) - used_s
            # A student's program logs every message, and falls behind at 1000 Hz.
            assert heard["newest"] or "publish_twist.py" in command, "the newest is not answered"
            times_s = *median_and_p99(heard["latency_s"]), used_s / count
            figures[f"{rate} Hz"] = [1e6 * time_s for time_s in times_s]
    return figures


def stick_to_wheel(command):
    """Return median and 99th percentile [ms] of the time from a moved stick to the wheels."""
    with running(BASE, **QUIET), running(command, **QUIET):
        latency_s = probed("wheel_probe.py", PUSHES)
    return {"stick to wheel": [1e3 * time_s for time_s in median_and_p99(latency_s)]}


@pytest.mark.parametrize(("measure", "unit"), [(relayed, "us"), (stick_to_wheel, "ms")])
def test_latency_and_processor_time_beside_a_bare_relay(measure, unit):
    rounds = {name: [] for name in RELAYS}
    for _ in range(ROUNDS):
        for name, command in RELAYS.items():
            rounds[name].append(measure(command))
    print("\n\n| | | median | 99 of 100 | processor time |\n|---|---|---|---|---|")
    late = []
    for load in rounds["bare rospy relay"][0]:
        bare = None
        for name, measured in rounds.items():
            figures = [statistics.median(each) for each in zip(*(one[load] for one in measured))]
            bare = bare or figures
            ratios = [mine / least for mine, least in zip(figures, bare)]
            cells = [f"{f:.1f} {unit} ({r:.2f})" for f, r in zip(figures, ratios)]
            print(f"| {name} | {load} | " + " | ".join(cells) + " |")
            if name.startswith("joy2twist.py") and ratios[0] >= MOST:
                late.append(f"{load}: {ratios[0]:.2f} times the latency of a bare relay")
    assert not late
