"""Drives a gamepad with the keys of a terminal.

A terminal reports only presses: while a key is held, it repeats the key that was pressed last. So
keys count as held until the terminal is silent for longer than its repetition period, and are then
all released together.
"""

from __future__ import annotations

import math
import re

from gamepad.virtual.controls import Controls

# Delay before the first repetition: X server 0.66 s, GNOME 0.5 s, console 0.25 s.
FIRST_HOLD_S = 0.75
# Repetitions: 11 (console) to 33 (GNOME) a second; one may be late.
REPEAT_HOLD_S = 0.2

HELP = """\
  W A S D or arrows   left stick: forward, left, back, right
  space               LB, the dead-man button: hold it (tap it, then hold a direction)
  T                   RB, turbo
  1 ... 9, 0          how far the stick goes: 10 % ... 90 %, all the way
  M                   MODE: swaps the left stick and the D-pad
  U                   unplug the gamepad, plug it in again
  Q or Ctrl-C         quit
"""

# Directions as (x, y), left and up positive.
DIRECTIONS = {
    "w": (0, 1), "\x1b[A": (0, 1), "\x1bOA": (0, 1),
    "s": (0, -1), "\x1b[B": (0, -1), "\x1bOB": (0, -1),
    "a": (1, 0), "\x1b[D": (1, 0), "\x1bOD": (1, 0),
    "d": (-1, 0), "\x1b[C": (-1, 0), "\x1bOC": (-1, 0),
}  # fmt: skip
BUTTONS = {" ": "LB", "t": "RB"}
QUIT = ("q", "\x03", "\x04")
# A key: a character, or a sequence such as for F4 or Ctrl with an arrow. The sequences are those of
# ECMA-48, and of the function keys of the Linux console.
_KEY = re.compile(r"\x1b(?:\[\[.|\[[0-?]*[ -/]*[@-~]|O.)|.", re.DOTALL)
_STARTED_KEY = re.compile(r"\x1b(?:\[\[|\[[0-?]*[ -/]*|O)?\Z")


class Keyboard:
    """Turns keys into Controls. Times in seconds, of a clock that never jumps."""

    def __init__(self) -> None:
        self._rest = ""  # the start of a sequence that a slow line has cut
        self._held: set[str] = set()  # keys of directions and buttons
        self._released_at = -math.inf
        self._deflection = 1.0
        self._mode_led = False
        self._plugged = True
        self.quit = False

    def press(self, text: str, now: float) -> None:
        """Take the characters that the terminal sent at a time."""
        self._expire(now)
        text = self._rest + text
        started = _STARTED_KEY.search(text)
        self._rest = started.group() if started else ""
        for sent in _KEY.findall(text[: len(text) - len(self._rest)]):
            key = sent if sent in DIRECTIONS else sent.lower()
            if key in QUIT:
                self.quit = True
            elif key in DIRECTIONS or key in BUTTONS:
                self._hold(key, now)
            elif key.isdecimal():  # not a superscript, which French keyboards have
                self._deflection = int(key) / 10 or 1.0
            elif key == "m":
                self._mode_led = not self._mode_led
            elif key == "u":
                self._plugged = not self._plugged

    def release(self) -> None:
        """Release all keys, when the output is blocked and the user does not see their effect."""
        self._held = set()

    def at(self, now: float) -> tuple[Controls, float]:
        """Return (Controls at a time, when they change without a key, or infinity)."""
        self._expire(now)
        x, y = [sum(DIRECTIONS[key][i] for key in self._held if key in DIRECTIONS) for i in (0, 1)]
        controls = Controls(
            left_stick=(x * self._deflection, y * self._deflection),
            held=frozenset(BUTTONS[key] for key in self._held if key in BUTTONS),
            mode_led=self._mode_led,
            plugged=self._plugged,
        )
        return controls, (self._released_at if self._held else math.inf)

    def _expire(self, now: float) -> None:
        if now >= self._released_at:
            self._held = set()

    def _hold(self, key: str, now: float) -> None:
        repeated = key in self._held
        if (
            key in DIRECTIONS
        ):  # the opposite direction, or the same one by another key: keep the new key
            axis = DIRECTIONS[key].index(0)
            self._held -= {key for key, vector in DIRECTIONS.items() if vector.index(0) == axis}
        self._held.add(key)
        self._released_at = now + (REPEAT_HOLD_S if repeated else FIRST_HOLD_S)
