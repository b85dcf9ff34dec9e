"""A world: a class that scans in the maze."""

from live import FAKE_TURTLEBOT, lost_periods, master, observe, topics_of

BEAMS, ROBOTS, SECONDS, MOST_LOAD = 640, 30, 20, 0.3


def test_a_class_that_scans_in_the_maze(figure):
    robots = [*FAKE_TURTLEBOT, "_world:=maze", f"_robots:={ROBOTS}"]
    with master():
        heard, (load,) = observe([robots], topics_of(ROBOTS, "odom", "scan"), SECONDS)
    lost = lost_periods({one: heard[one] for one in topics_of(ROBOTS, "odom")[1:]})
    rate = sum(len(heard[one]["arrivals"]) for one in topics_of(ROBOTS, "scan")[1:]) / SECONDS
    shown = f"{rate:,.0f} scans a second, {lost} periods lost, {load:.0%} of a core"
    figure(f"{ROBOTS} robots that scan with {BEAMS} beams in the maze", shown, "0 lost, ≤ 30 %")
    assert lost == 0
    assert rate > 0.98 * ROBOTS * 10
    assert load <= MOST_LOAD
