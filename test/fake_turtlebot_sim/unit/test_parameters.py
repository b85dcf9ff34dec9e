"""Private parameters: defaults, one clear line for each mistake, the same names everywhere."""

import re
from dataclasses import fields
from math import inf
from pathlib import Path

import pytest
import yaml

import fake_turtlebot_sim
from fake_turtlebot_sim.safety.parameters import SafetyParameters
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from tutorial_testing.claims import claim

pytestmark = claim(
    "A mistake in the simulator's parameters is one line; config/ has the table's defaults"
)
PACKAGE = Path(fake_turtlebot_sim.__file__).parents[2]
ALL = (*fields(SimulatorParameters), *fields(SafetyParameters))
CHECKS = {field.name: field.metadata["check"] for field in ALL}
BOUNDS = re.findall(
    r"^\| `~(\w+)` \| .*? \| a (whole )?number from (\S+) to (\S+)(.*? or 0)?",
    (PACKAGE / "README.md").read_text(), re.M,
)  # fmt: skip


def test_nothing_given_is_a_turtlebot_2():
    parameters = parse_parameters({})
    assert parameters == SimulatorParameters()
    periods_ns = parameters.period_ns(), SimulatorParameters(rate=6.0).period_ns()
    assert periods_ns == (20_000_000, 166_666_667)
    assert parameters.start_poses() == {"": (0.0, 0.0, 0.0)}


@pytest.mark.parametrize(("given", "parts"), [
    ({"odom_frame": "/odom"}, ["~odom_frame: '/odom'", "leading slash"]),
    ({"base_frame": "odom"}, ["~base_frame: 'odom'", "differ from ~odom_frame"]),
    ({"left_wheel_joint": "a", "right_wheel_joint": "a"}, ["~right_wheel_joint: 'a'"]),
    ({"world": "moon"}, ["~world: 'moon': no world of this package", "take maze, "]),
    ({"world": "maze", "robots": 500}, ["~world: 'maze': the world has room for"]),
    ({"world": "maze", "robots": {"ada": [1, 1, 0]}}, ["start: in the world's file or x:="]),
    ({"scan_no_return": "0"}, ["~scan_no_return: '0': must be inf or nan"]),
    ({"scan_range_min": 11.0}, ["~scan_range_min: must be less than ~scan_range_max"]),
    ({"scan_range_min": 10.0}, ["~scan_range_min: must be less than ~scan_range_max"]),
    ({"robots": 0}, ["~robots: 0", "1 to 1000", "[ada, bob]", "{ada: [0, 0, 0]"]),
    ({"robots": ["ada"] * 1001}, ["~robots: ['ada'", "1 to 1000"]),
    ({"robots": ["ada", "bob", "ada"]}, ["~robots: [", "'ada': is listed twice"]),
    ({"robots": {"ada": [1e7, 0, 0]}}, ["~robots: {", "ada: [10000000.0", "up to 1e6"]),
    ({"robots": {"bob": [0, 0]}}, ["bob: [0, 0]: must be [x in m, y in m, yaw in rad]"]),
])  # fmt: skip
def test_a_mistake_is_named_with_its_value_and_what_is_allowed(given, parts):
    with pytest.raises(ValueError) as caught:
        parse_parameters(given)
    assert "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(("name", "whole", "least", "most", "off"), BOUNDS)
def test_bounds_are_those_of_the_readme(name, whole, least, most, off):
    check = CHECKS[name]
    for bound, beyond in ((float(least), -1), (float(most), 1)):
        step = 1 if whole else 1e-5 * abs(bound) + 1e-9  # the README has six digits
        check(int(bound) if whole else bound - beyond * step)
        with pytest.raises(ValueError, match="must be"):
            check(bound + beyond * step)
    if off:
        assert check(0) == 0


def test_robots_that_meet_at_full_speed_are_near_long_before():
    """Twice the distance of a robot until its timeout plus 10 periods, on a busy machine."""
    assert SimulatorParameters().meeting_reach() == pytest.approx(1.0 + 2 * 0.7 * (0.6 + 10 * 0.02))
    assert SimulatorParameters(cmd_vel_timeout=0.0).meeting_reach() == inf
    assert SimulatorParameters(max_linear_speed=0.0).meeting_reach() == inf


def test_robots_by_name_and_by_number():
    named = parse_parameters({"robots": {"alice": [1e6, 1, 2]}})
    assert named.start_poses() == {"alice": (1e6, 1.0, 2.0)}
    one = parse_parameters({"initial_x": 1, "initial_y": 2, "initial_yaw": 3})
    assert one.start_poses() == {"": (1.0, 2.0, 3.0)}
    for count in (1, 1000):
        robots = parse_parameters({"robots": count}).robots
        assert len(robots) == count and parse_parameters({"robots": list(robots)}).robots == robots
    numbered = parse_parameters({"robots": 30}).start_poses()
    in_rows = [(-float(k // 10), -float(k % 10), 0.0) for k in range(30)]  # of ten, 1 m apart
    assert numbered == {f"robot_{k}": pose for k, pose in enumerate(in_rows, start=1)}
    listed = parse_parameters({"robots": ["ada", "bob"]}).start_poses()
    assert listed == {"ada": numbered["robot_1"], "bob": numbered["robot_2"]}


def test_the_yaml_file_holds_parameters_with_their_defaults():
    given = yaml.safe_load((PACKAGE / "config" / "fake_turtlebot.yaml").read_text())
    assert parse_parameters(given) == SimulatorParameters()


def test_rbx1s_robot_drives_on_without_limit_as_the_original():
    given = yaml.safe_load((PACKAGE / "config" / "rbx1.yaml").read_text())
    robot = parse_parameters(given)
    assert robot.cmd_vel_timeout == robot.max_linear_speed == robot.max_angular_speed == 0
