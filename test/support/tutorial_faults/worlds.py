"""Real objects, the invariants of FAULTS.md that they must keep, and a clock.

What they are judged by is written from the documentation, and knows nothing of their code. A
velocity is linear x, y, z [m/s] and angular x, y, z [rad/s], in the frame of the base.
"""

import math

TICK, SUSPENDED = "tick", "suspended"  # events; a TICK: the node looks at the clock
ROUNDING = 1e-9  # float64 rounding, as part of a limit


def moves(velocity):
    """Return whether a velocity is other than zero; NaN is, too."""
    return any(part != 0 for part in velocity)


def beyond(velocity, linear=math.inf, angular=math.inf):
    """Yield (c) of a velocity that is not finite, or beyond the limits [m/s, rad/s] of vectors."""
    if not all(map(math.isfinite, velocity)):
        yield "c", f"{velocity} is not finite"
    lengths = math.hypot(*velocity[:3]), math.hypot(*velocity[3:])
    if any(one > most * (1 + ROUNDING) for one, most in zip(lengths, (linear, angular))):
        yield "c", f"{velocity} is beyond the limits"


class Moment(int):
    """A time [us] to which seconds are added without rounding: at a threshold is at it exactly."""

    __slots__ = ()

    def __add__(self, seconds):
        """Return the Moment so many seconds later, or infinity."""
        return seconds if math.isinf(seconds) else Moment(int(self) + round(seconds * 1e6))

    __radd__ = __add__

    def __sub__(self, other):
        """Return the seconds since another Moment, or the Moment so many seconds before."""
        if isinstance(other, Moment):
            return (int(self) - int(other)) / 1e6
        return self + -other


class World:
    """Shows events to real objects, by their public interface, and judges what they answer.

    happen(event) yields the letter of each invariant that is violated, and how.
    """

    now = Moment(0)

    def take(self, event):
        """Let an event happen (a number: seconds pass).

        Raises AssertionError with the letter of an invariant that is violated, and how.
        """
        if isinstance(event, float):
            self.now += event
            return
        for letter, what in self.happen(event):
            raise AssertionError(f"({letter}) {what}, at {self.now - Moment(0):.6f} s: {event}")
