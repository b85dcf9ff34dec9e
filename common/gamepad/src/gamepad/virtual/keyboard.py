"""Drives a gamepad with the keys of a terminal (pure).

A terminal reports only that a key is pressed and, while it is held, pressed again; it repeats only
the key pressed last. So a key counts as held until the terminal has been silent for
longer than its repetition takes, and all keys are released together then.
"""

from __future__ import annotations

import math
import re

from gamepad.virtual.controls import Controls

# Before it repeats a key, a terminal waits: X server 0.66 s, GNOME 0.5 s, console 0.25 s.
FIRST_HOLD_S = 0.75
# Repetitions come 11 (console) to 33 (GNOME) times a second; a late one is allowed.
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

# What the keys send. Directions as (x, y) with left and up positive.
DIRECTIONS = {
    "w": (0, 1), "\x1b[A": (0, 1), "\x1bOA": (0, 1),
    "s": (0, -1), "\x1b[B": (0, -1), "\x1bOB": (0, -1),
    "a": (1, 0), "\x1b[D": (1, 0), "\x1bOD": (1, 0),
    "d": (-1, 0), "\x1b[C": (-1, 0), "\x1bOC": (-1, 0),
}  # fmt: skip
BUTTONS = {" ": "LB", "t": "RB"}
QUIT = ("q", "\x03", "\x04")
# One key: a sequence, as of F4 or Ctrl with an arrow, or a character. Sequences are those of
# ECMA-48, and of the function keys of the Linux console.
_KEY = re.compile(r"\x1b(?:\[\[.|\[[0-?]*[ -/]*[@-~]|O.)|.", re.DOTALL)
_STARTED_KEY = re.compile(r"\x1b(?:\[\[|\[[0-?]*[ -/]*|O)?\Z")


class Keyboard:
    """Keys and times in, Controls out. Times in seconds, of one clock that never jumps."""

    def __init__(self) -> None:
        self._rest = ""  # the begin of a sequence that a slow line has cut
        self._held: set[str] = set()  # keys of directions and buttons
        self._released_at = -math.inf
        self._deflection = 1.0
        self._mode_led = False
        self._plugged = True
        self.quit = False

    def press(self, text: str, now: float) -> None:
        """Take in what the terminal sent at a time."""
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
            elif key.isdecimal():  # and no superscript, a key of French keyboards
                self._deflection = int(key) / 10 or 1.0
            elif key == "m":
                self._mode_led = not self._mode_led
            elif key == "u":
                self._plugged = not self._plugged

    def release(self) -> None:
        """Release all keys, as their terminal is held or their effect is not seen."""
        self._held = set()

    def at(self, now: float) -> tuple[Controls, float]:
        """Return (Controls at a time, the time at which they change by themselves or infinity)."""
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
        if key in DIRECTIONS:  # the other way, or the same way by another key: only the new one
            axis = DIRECTIONS[key].index(0)
            self._held -= {other for other, way in DIRECTIONS.items() if way.index(0) == axis}
        self._held.add(key)
        self._released_at = now + (REPEAT_HOLD_S if repeated else FIRST_HOLD_S)
