"""The parameters of serial_kobuki."""

import pytest

from fake_turtlebot_sim.serial_kobuki.parameters import parse_parameters
from kobuki_protocol.identity import FirmwareVersion


def test_the_simulation_gets_world_pose_errors_and_timeout():
    p = parse_parameters({"world": "room", "initial_x": 1, "track_ratio": 1.1})
    simulation = p.simulation()
    assert simulation.world == p.world
    assert (simulation.track_ratio, simulation.cmd_vel_timeout) == (1.1, 0.6)
    assert p.start_pose() == (1.0, 0.0, 0.0)


def test_version_battery_and_charger_are_built_in():
    given = {"other_firmware": "2.0.1", "battery": 13.1, "charger": "adapter"}
    equipment = parse_parameters(given).equipment()
    assert equipment.firmware == FirmwareVersion(1, 0, 2)
    assert (equipment.battery, equipment.charger) == (131, 22)
    assert str(parse_parameters({}).equipment().firmware) == "1.2.0"


@pytest.mark.parametrize(("given", "words"), [
    ({"drop": 2}, "~drop: 2: must be a number from 0 to 1"),
    ({"stall": 10}, "~stall: 10: must be a number from 0 to 9 s"),
    ({"other_firmware": "2"}, "~other_firmware: '2': must be empty, or major.minor.patch"),
    ({"charger": "sun"}, "~charger: 'sun': must be none, dock or adapter"),
    ({"wrold": "room"}, "did you mean ~world"),
    ({"world": "room", "initial_x": 4.0}, "inside a wall"),
])  # fmt: skip
def test_a_mistake_is_one_line(given, words):
    with pytest.raises(ValueError, match=r"^[^\n]*$") as caught:
        parse_parameters(given)
    assert words in str(caught.value)
