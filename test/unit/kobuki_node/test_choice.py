"""Which robot a launch file drives, and what it says of it."""

import pytest

from kobuki_driver.choice import choose

USB = "/dev/ttyUSB0"
USUAL = "/dev/kobuki"  # as turtlebot_bringup's hook sets the variable


@pytest.mark.parametrize(
    ("given", "variable", "simulation", "world", "has_usual", "port", "part"),
    [
        ("", "", "false", "", False, "", "as there is no /dev/kobuki; serialport:=PATH drives"),
        ("", USUAL, "false", "", False, "", "as there is no /dev/kobuki"),
        ("", USUAL, "false", "", True, USUAL, "which is plugged in; simulation:=true simulates"),
        ("", USB, "false", "", False, USB, "the real Kobuki at /dev/ttyUSB0, by TURTLEBOT_SERIAL"),
        (USB, "", "false", "", True, USB, "the real Kobuki at /dev/ttyUSB0; simulation:=true"),
        (USUAL, USUAL, "false", "", False, USUAL, "the real Kobuki at /dev/kobuki;"),
        (USB, USB, "true", "", True, "", "by simulation:=true; without it, serialport:=PATH"),
        ("", USB, "false", "room", True, "", "as a world is simulated; without one,"),
    ],
)
def test_a_port_that_is_named_is_never_replaced(
    given, variable, simulation, world, has_usual, port, part
):
    choice = choose(given, variable, simulation, world, has_usual)
    assert choice.port == port
    assert part in choice.line


@pytest.mark.parametrize(
    ("given", "simulation", "world", "part"),
    [
        (USB, "false", "room", "give one of them"),
        ("", "yes", "", "simulation:=yes: must be true or false"),
    ],
)
def test_a_mistake_is_one_line(given, simulation, world, part):
    with pytest.raises(ValueError, match=part):
        choose(given, "", simulation, world, False)
