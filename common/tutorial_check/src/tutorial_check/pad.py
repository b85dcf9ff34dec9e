"""A virtual F710, in the process of a forked.Helper: the device is a FIFO."""

from __future__ import annotations

import contextlib
import os
import threading
import time

from gamepad.gamepads import F710
from gamepad.virtual.pads import StreamPad

PERIOD_S = 0.02  # how often it looks whether a driver has begun to read


class Pad:
    """Stick and LB are where they were last put."""

    def __init__(self, path: str, mode: str) -> None:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            os.unlink(path)
        self._pad = StreamPad(F710[mode], path)
        os.chmod(path, 0o666)
        self._buttons = len(F710[mode].buttons)
        self._axes = len(F710[mode].axes)
        self._position = self._at(0.0, 0.0, 0)
        threading.Thread(target=self._serve, daemon=True).start()

    def _at(
        self, left: float, forwards: float, lb: int
    ) -> tuple[tuple[float, ...], tuple[int, ...]]:
        buttons = [0] * self._buttons
        buttons[4] = lb
        return (left, forwards, *(0.0,) * (self._axes - 2)), tuple(buttons)

    def _serve(self) -> None:
        while True:
            self._pad.show(self._position)
            time.sleep(PERIOD_S)

    def connected(self) -> bool:
        return bool(self._pad.connected)

    def push(self, left: float, forwards: float) -> None:
        """Hold LB and put the stick there."""
        self._position = self._at(left, forwards, 1)

    def release(self) -> None:
        self._position = self._at(0.0, 0.0, 0)
