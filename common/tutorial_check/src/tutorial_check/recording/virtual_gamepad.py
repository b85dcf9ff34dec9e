"""A virtual F710, in the process of a forked.Helper: the device is a FIFO."""

from __future__ import annotations

import contextlib
import os
import threading
import time
from typing import Callable, Tuple

from gamepad.gamepads import F710
from gamepad.io.pads import StreamPad

MODE = F710["D"]  # as its switch stands
Position = Tuple[Tuple[float, ...], Tuple[int, ...]]  # (axes, buttons)
PERIOD_S = 0.02  # how often it looks whether a driver has started to read


class VirtualGamepad:
    """Stick and LB are where they were last put."""

    def __init__(self, path: str, arranged: Callable[[Position], Position]) -> None:
        """path: of the FIFO. arranged: the Joy of a task for one of the handout's."""
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            os.unlink(path)
        self._pad = StreamPad(MODE, path)
        os.chmod(path, 0o644)
        self._arranged = arranged
        self.release()
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self) -> None:
        while True:
            self._pad.show(self._position)
            time.sleep(PERIOD_S)

    def connected(self) -> bool:
        return bool(self._pad.connected)

    def push(self, left: float, forwards: float, lb: int = 1) -> None:
        """Hold LB and put the stick there."""
        axes = (left, forwards, *(0.0 for _ in MODE.axes[2:]))
        buttons = (0, 0, 0, 0, lb, *(0 for _ in MODE.buttons[5:]))
        self._position = self._arranged((axes, buttons))

    def release(self) -> None:
        self.push(0.0, 0.0, lb=0)
