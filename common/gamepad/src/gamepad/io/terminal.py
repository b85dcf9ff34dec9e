"""The terminal of the virtual gamepad: reads single keys, shows help and a line of state."""

from __future__ import annotations

import os
import sys
import termios
import tty

from gamepad.virtual.controls import Controls

REFRESH_S = 0.5  # period at which the state is shown again, below the output of other programs

_CLEAR_LINE = "\r\x1b[K"
_VDISABLE = b"\0"


class KeyTerminal:
    """Reads keys from standard input without waiting for Enter, and restores the terminal at exit.

    Ctrl-C works as usual. Ctrl-Z is disabled: it would stop this program with a stick pushed.
    """

    def __enter__(self) -> KeyTerminal:
        self._fd = sys.stdin.fileno()
        # Opened again, for non-blocking writes: Ctrl-S, a pager or a slow line may block the
        # output, and a change of standard output would affect every program that shares it.
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
        """Return the pressed keys; "" if the terminal is closed."""
        try:
            return os.read(self._fd, 1024).decode(errors="replace")
        except OSError:
            return ""

    def show(self, controls: Controls) -> bool:
        """Show the controls in one line; return whether the output is not blocked."""
        x, y = controls.left_stick
        words = [f"left stick {x:+.1f} {y:+.1f}", *sorted(controls.held)]
        if (x or y) and not controls.held:
            words.append("without LB: tap space, then this key at once")
        words += ["MODE LED on"] * controls.mode_led + ["unplugged"] * (not controls.plugged)
        # Back to the start of the line, so that a line of another program replaces it.
        return self._write(_CLEAR_LINE + "  " + "  ".join(words) + "\r")

    def _write(self, text: str) -> bool:
        data = text.encode()
        try:
            return os.write(self._screen, data) == len(data)
        except OSError:
            return False
