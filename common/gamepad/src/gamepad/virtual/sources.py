"""Sources that move a virtual gamepad: keys, a script of moves, or a recording.

A source has at(now), which returns (position, until), or None at the end. position: (axes, buttons)
as on /joy, or None for an unplugged gamepad; until: when it changes next. Times in seconds, of a
clock that never jumps. The first call of at() is the start.
"""

from __future__ import annotations

import bisect
import itertools
from typing import Optional, Sequence, Tuple

from gamepad.gamepads import Gamepad
from gamepad.virtual.controls import Controls, Position, positions
from gamepad.virtual.keyboard import Keyboard
from gamepad.virtual.moves import MoveScript

LARGEST_AXIS = 1.001  # the kernel's range is asymmetric, so that some drivers exceed 1


At = Tuple[Optional[Position], float]


def _position(gamepad: Gamepad, controls: Controls) -> Position | None:
    return positions(gamepad, controls) if controls.plugged else None


class KeySource:
    """Follows a keyboard.Keyboard until it quits."""

    def __init__(self, gamepad: Gamepad, keyboard: Keyboard) -> None:
        self._gamepad, self.keyboard = gamepad, keyboard
        self.controls = Controls()

    def at(self, now: float) -> At | None:
        """Return (position, until), or None at the end."""
        if self.keyboard.quit:
            return None
        self.controls, until = self.keyboard.at(now)
        return _position(self._gamepad, self.controls), until


class TimedSource:
    """Follows a script or a recording."""

    def __init__(self, steps: Sequence[tuple[float, Position | None]], loop: bool) -> None:
        """Take pairs of a duration [s] and a position; loop: restart at the end."""
        self._positions = [position for _, position in steps]
        self._ends = list(itertools.accumulate(duration for duration, _ in steps))
        self._loop = loop
        self._start: float | None = None

    def at(self, now: float) -> At | None:
        """Return (position, until), or None at the end."""
        if self._start is None:
            self._start = now
        rounds, time_s = divmod(now - self._start, self._ends[-1])
        if rounds and not self._loop:
            return None
        index = bisect.bisect_right(self._ends, time_s)
        until = self._start + rounds * self._ends[-1] + self._ends[index]
        return self._positions[index], until


def script_source(gamepad: Gamepad, script: MoveScript, loop: bool) -> TimedSource:
    """Return a source from a script of moves."""
    return TimedSource([(d, _position(gamepad, controls)) for d, controls in script.moves], loop)


def recording_source(
    gamepad: Gamepad, recorded: Sequence[tuple[float, Position]], loop: bool
) -> TimedSource:
    """Return a source from (time [s], position), in order. Raises ValueError."""
    expected = (len(gamepad.axes), len(gamepad.buttons))
    for _, (axes, buttons) in recorded:
        if (len(axes), len(buttons)) != expected:
            raise ValueError(
                f"a message has {len(axes)} axes and {len(buttons)} buttons; "
                f"this gamepad has {expected[0]} and {expected[1]}"
            )
        if not all([abs(axis) <= LARGEST_AXIS for axis in axes]):
            raise ValueError(f"a message has axes beyond -1 to 1: {list(axes)}")
    if len(recorded) < 2:
        raise ValueError("there are fewer than two messages")
    times = [time for time, _ in recorded]
    gaps = [max(0.0, later - earlier) for earlier, later in zip(times, times[1:])]
    # The last position is held for the average duration.
    gaps.append(sum(gaps) / len(gaps))
    if not sum(gaps):
        raise ValueError("all messages have the same time")
    return TimedSource([(gap, position) for gap, (_, position) in zip(gaps, recorded)], loop)
