"""Whether a launch file drives a real Kobuki or simulates one (pure)."""

from __future__ import annotations

from typing import NamedTuple

USUAL_PORT = "/dev/kobuki"  # what the udev rule makes; turtlebot_bringup's hook sets it, too
VARIABLE = "TURTLEBOT_SERIAL_PORT"
REAL = "serialport:=PATH drives a real Kobuki"


class Choice(NamedTuple):
    """The port of a real robot, or "" for a simulation; and the line that says which and why."""

    port: str
    line: str


def choose(given: str, variable: str, simulation: str, world: str, has_usual: bool) -> Choice:
    """Return the Choice. Raises ValueError, one line.

    given: serialport:=, or "". variable: the value of VARIABLE. simulation: the argument, true or
    false. world: of a simulation, or "". has_usual: whether USUAL_PORT exists. A port that is named
    is never replaced by a simulation.
    """
    if simulation not in ("true", "false"):
        raise ValueError(f"simulation:={simulation}: must be true or false")
    if simulation == "true":
        return Choice("", f"a simulated Kobuki, by simulation:=true; without it, {REAL}")
    if world and given:
        raise ValueError(
            f"a world is simulated, and serialport:={given} is of a real robot: give one of them"
        )
    if world:
        return Choice("", f"a simulated Kobuki, as a world is simulated; without one, {REAL}")
    named = given or (variable if variable != USUAL_PORT else "")
    if named or has_usual:
        reason = "" if given else (f", by {VARIABLE}" if named else ", which is plugged in")
        port = named or USUAL_PORT
        return Choice(port, f"the real Kobuki at {port}{reason}; simulation:=true simulates one")
    return Choice("", f"a simulated Kobuki, as there is no {USUAL_PORT}; {REAL}")
