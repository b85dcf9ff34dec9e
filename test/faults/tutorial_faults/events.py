"""Records of a robot and of what drives it. Times [s] are of one clock that never jumps.

A velocity is a tuple: linear x, y, z [m/s] and angular x, y, z [rad/s], in the frame of the base.
"""

from typing import Hashable, NamedTuple, Tuple

Velocity = Tuple[float, ...]


class Joy(NamedTuple):
    """A joystick message, as the node that drives by it received it."""

    at_s: float
    sender: Hashable  # the joystick node
    axes: Tuple[float, ...]
    buttons: Tuple[int, ...]
    age_s: float = 0.0  # since its stamp


class Twist(NamedTuple):
    """A velocity that was sent to the robot."""

    at_s: float
    velocity: Velocity


class Command(NamedTuple):
    """A velocity at an input of the multiplexer."""

    at_s: float
    input: str
    velocity: Velocity
    sender: Hashable = None  # one of several on the same input


class Through(NamedTuple):
    """A command of this input that passed the multiplexer."""

    at_s: float
    input: str
    velocity: Velocity


class Wheels(NamedTuple):
    """The motion of the wheels, by the truth of the simulator."""

    at_s: float
    v: float  # [m/s]
    w: float  # [rad/s]


class Loss(NamedTuple):
    """A part was lost: killed, suspended, cut off, restarted."""

    at_s: float
    part: str
    settles_s: float = 0.0  # messages that arrive within this time were sent before


class Violation(NamedTuple):
    """An invariant does not hold."""

    invariant: str  # its letter
    at_s: float
    what: str
