"""The terminal of the virtual gamepad: single keys in, help and one line of state out."""

from __future__ import annotations

import os
import sys
import termios
import tty

from gamepad.virtual.controls import Controls

REFRESH_S = 0.5  # how soon the state is shown again below what other programs have written

_CLEAR_LINE = "\r\x1b[K"
_VDISABLE = b"\0"


class Terminal:
    """Gives keys without waiting for Enter; as a context manager it leaves the terminal as it was.

    It is the standard input. Ctrl-C stays what it is. Ctrl-Z is switched off: it would stop this
    program with a stick pushed.
    """

    def __enter__(self) -> Terminal:
        self._fd = sys.stdin.fileno()
        # Opened once more, to be written without waiting: Ctrl-S, a pager or a slow line may hold
        # the screen, and a change of the standard output would reach every program that shares it.
        self._screen = os.open(os.ttyname(self._fd), os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
        self._before = termios.tcgetattr(self._fd)
        tty.setcbreak(self._fd)
        settings = termios.tcgetattr(self._fd)
        settings[6][termios.VSUSP] = _VDISABLE
        termios.tcsetattr(self._fd, termios.TCSANOW, settings)
        return self

    def __exit__(self, *_: object) -> None:
        termios.tcsetattr(self._fd, termios.TCSANOW, self._before)
        self._write("\n")
        os.close(self._screen)

    def fileno(self) -> int:
        """For poll()."""
        return self._fd

    def read(self) -> str:
        """Return the keys that were pressed; "" if the terminal is gone."""
        try:
            return os.read(self._fd, 1024).decode(errors="replace")
        except OSError:
            return ""

    def show(self, controls: Controls) -> bool:
        """Show the controls in one line; return whether the screen takes it and is not held."""
        x, y = controls.left_stick
        words = [f"left stick {x:+.1f} {y:+.1f}", *sorted(controls.held)]
        if (x or y) and not controls.held:
            words.append("without LB: tap space, then this key at once")
        words += ["MODE LED on"] * controls.mode_led + ["unplugged"] * (not controls.plugged)
        # Back to its beginning: a line of another program replaces it, and is not glued to it.
        return self._write(_CLEAR_LINE + "  " + "  ".join(words) + "\r")

    def _write(self, text: str) -> bool:
        data = text.encode()
        try:
            return os.write(self._screen, data) == len(data)
        except OSError:
            return False
