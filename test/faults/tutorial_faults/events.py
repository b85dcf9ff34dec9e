"""What is recorded of a robot and those who drive it. Times [s] are of one clock that never jumps.

A velocity is a tuple: linear x, y, z [m/s] and angular x, y, z [rad/s], in the frame of the base.
"""

from typing import Hashable, NamedTuple, Tuple

Velocity = Tuple[float, ...]


class Joy(NamedTuple):
    """A joystick message, as whoever drives by it has it."""

    at_s: float
    sender: Hashable  # tells one joystick node from another
    axes: Tuple[float, ...]
    buttons: Tuple[int, ...]
    age_s: float = 0.0  # since its stamp


class Twist(NamedTuple):
    """A velocity that was sent to the robot."""

    at_s: float
    velocity: Velocity


class Command(NamedTuple):
    """A velocity that came at an input of the multiplexer."""

    at_s: float
    input: str
    velocity: Velocity
    sender: Hashable = None  # tells apart those who speak on one input


class Through(NamedTuple):
    """A command of this input went through the multiplexer."""

    at_s: float
    input: str
    velocity: Velocity


class Wheels(NamedTuple):
    """What the wheels do, by the truth of the simulator."""

    at_s: float
    v: float  # [m/s]
    w: float  # [rad/s]
    robot: str = ""


class Loss(NamedTuple):
    """A part was lost: killed, stopped, cut off, started anew."""

    at_s: float
    part: str
    settles_s: float = 0.0  # messages that come within this time were sent before


class Violation(NamedTuple):
    """An invariant does not hold."""

    invariant: str  # its letter
    at_s: float
    what: str
