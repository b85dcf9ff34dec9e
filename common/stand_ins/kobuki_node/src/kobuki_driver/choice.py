"""The choice whether a launch file drives a real Kobuki or simulates one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

USUAL_PORT = "/dev/kobuki"  # made by the udev rule; turtlebot_bringup's hook sets it, too
VARIABLE = "TURTLEBOT_SERIAL_PORT"
SIMULATION = "TURTLEBOT_SIMULATION"
REAL = "serialport:=PATH drives a real Kobuki"


@dataclass(frozen=True)
class BaseOptions:
    """The arguments of the launch file, the variables, and whether the usual port exists."""

    port: str = ""  # serialport:=
    simulation: str = ""  # simulation:=, true or false
    world: str = ""  # world:=, for a simulation
    port_variable: str = ""
    simulation_variable: str = ""
    has_usual: bool = False  # USUAL_PORT exists


class Choice(NamedTuple):
    """The port of a real robot, or "" for a simulation, and a line with the reason."""

    port: str
    line: str


def choose(given: BaseOptions) -> Choice:
    """Return the Choice, by the arguments, then by the variables. Raises ValueError, one line.

    A simulation never replaces a port that was named.
    """
    if given.simulation not in ("true", "false", ""):
        raise ValueError(f"simulation:={given.simulation}: must be true or false")
    return _by_arguments(given) or _by_variables(given)


def _by_arguments(given: BaseOptions) -> Choice | None:
    if given.simulation == "true":
        return Choice("", f"a simulated Kobuki, by simulation:=true; without it, {REAL}")
    if given.world and given.port:
        line = f"world:= is for a simulation, and serialport:={given.port} for a real robot"
        raise ValueError(f"{line}: give one of them")
    if given.world:
        return Choice("", f"a simulated Kobuki, as a world is simulated; without one, {REAL}")
    return _real(given.port, "") if given.port else None


def _by_variables(given: BaseOptions) -> Choice:
    if given.simulation_variable == "true" and not given.simulation:
        return Choice("", f"a simulated Kobuki, by {SIMULATION}=true; {REAL}")
    if given.port_variable not in ("", USUAL_PORT):
        return _real(given.port_variable, f", by {VARIABLE}")
    if given.has_usual:
        return _real(USUAL_PORT, ", which is plugged in")
    return Choice("", f"a simulated Kobuki, as there is no {USUAL_PORT}; {REAL}")


def _real(port: str, why: str) -> Choice:
    return Choice(port, f"the real Kobuki at {port}{why}; simulation:=true simulates one")
