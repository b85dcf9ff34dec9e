"""A virtual F710, in a Helper's process; its device is a FIFO."""

from __future__ import annotations

import contextlib
import os
import threading
import time
from typing import Callable, Tuple

from gamepad.gamepads import F710
from gamepad.io.pads import StreamPad

MODE = F710["D"]  # position of its switch
Position = Tuple[Tuple[float, ...], Tuple[int, ...]]  # (axes, buttons)
PERIOD_S = 0.02  # between two looks whether a driver reads


class VirtualGamepad:
    """A gamepad whose stick and LB stay where they were last put."""

    def __init__(self, path: str, arranged: Callable[[Position], Position]) -> None:
        """path: of the FIFO. arranged: returns the task's Joy for one of the handout's."""
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
        """Hold LB, and push the stick to a position."""
        axes = (left, forwards, *(0.0 for _ in MODE.axes[2:]))
        buttons = (0, 0, 0, 0, lb, *(0 for _ in MODE.buttons[5:]))
        self._position = self._arranged((axes, buttons))

    def release(self) -> None:
        self.push(0.0, 0.0, lb=0)
