"""Which robot a launch file drives, and the line that reports it."""

import pytest

from kobuki_driver.choice import BaseOptions as Options
from kobuki_driver.choice import choose
from tutorial_testing.claims import claim

pytestmark = claim(
    "Launch files drive the port that is named, and never simulate in its place; a world is never "
    "driven in by a real robot; one line says which of the two"
)
USB = "/dev/ttyUSB0"
USUAL = "/dev/kobuki"  # turtlebot_bringup's environment hook sets the variable to this


@pytest.mark.parametrize(("given", "port", "part"), [
    (Options(), "", "as there is no /dev/kobuki; serialport:=PATH drives"),
    (Options(port_variable=USUAL), "", "as there is no /dev/kobuki"),
    (Options(has_usual=True), USUAL, "which is plugged in; simulation:=true simulates"),
    (Options(port_variable=USB), USB, "at /dev/ttyUSB0, by TURTLEBOT_SERIAL_PORT"),
    (Options(USB, has_usual=True), USB, "the real Kobuki at /dev/ttyUSB0; simulation:=true"),
    (Options(USUAL, port_variable=USUAL), USUAL, "the real Kobuki at /dev/kobuki;"),
    (Options(USB, "true"), "", "by simulation:=true; without it, serialport:=PATH"),
    (Options(world="room", port_variable=USB, has_usual=True), "", "as a world is simulated"),
    (Options(simulation_variable="true", has_usual=True), "", "by TURTLEBOT_SIMULATION=true"),
    (Options(USB, simulation_variable="true"), USB, "the real Kobuki at"),
    (Options("", "false", simulation_variable="true", has_usual=True), USUAL, "plugged in"),
])  # fmt: skip
def test_a_port_that_is_named_is_never_replaced(given, port, part):
    choice = choose(given)
    assert choice.port == port
    assert part in choice.line


@pytest.mark.parametrize(("given", "part"), [
    (Options(USB, world="room"), "give one of them"),
    (Options(simulation="yes"), "simulation:=yes: must be true or false"),
])  # fmt: skip
def test_a_mistake_is_one_line(given, part):
    with pytest.raises(ValueError, match=part):
        choose(given)
