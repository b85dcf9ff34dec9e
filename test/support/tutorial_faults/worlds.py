"""Real objects, what must never happen to them (FAULTS.md), and a clock.

The invariants follow the documentation, not the code. A velocity is linear x, y, z [m/s] and
angular x, y, z [rad/s], in the frame of the base.
"""

import math

TICK, SUSPENDED = "tick", "suspended"  # events; a TICK: the node looks at the clock
ROUNDING = 1e-9  # float64 rounding, as part of a limit


def moves(velocity):
    """Return whether a velocity is not zero, as NaN is not."""
    return any(part != 0 for part in velocity)


def beyond(velocity, linear=math.inf, angular=math.inf):
    """Yield (c) of a velocity that is not finite, or beyond the limits [m/s, rad/s] of vectors."""
    if not all(map(math.isfinite, velocity)):
        yield "c", f"{velocity} is not finite"
    lengths = math.hypot(*velocity[:3]), math.hypot(*velocity[3:])
    if any(length > most * (1 + ROUNDING) for length, most in zip(lengths, (linear, angular))):
        yield "c", f"{velocity} is beyond the limits"


class Moment(int):
    """A time [us], so that sums of seconds meet a threshold exactly."""

    __slots__ = ()

    def __add__(self, seconds):
        """Return the Moment this many seconds later, or infinity."""
        return seconds if math.isinf(seconds) else Moment(int(self) + round(seconds * 1e6))

    __radd__ = __add__

    def __sub__(self, other):
        """Return the seconds since another Moment, or the Moment this many seconds before."""
        if isinstance(other, Moment):
            return (int(self) - int(other)) / 1e6
        return self + -other


class World:
    """Passes events to real objects, by their public interface, and judges their answers.

    A subclass's happen(event) yields (letter of a violated invariant, how).
    """

    now = Moment(0)

    def take(self, event):
        """Let an event happen; a number lets so many seconds pass.

        Raise AssertionError with the letter of a violated invariant, and how.
        """
        if isinstance(event, float):
            self.now += event
            return
        for letter, what in self.happen(event):
            raise AssertionError(f"({letter}) {what}, at {self.now - Moment(0):.6f} s: {event}")
