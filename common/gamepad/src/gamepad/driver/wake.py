"""Wait for a device, a time or another thread."""

from __future__ import annotations

import os
import select
import time

from gamepad.driver.device import Device


class Wake:
    """Waits until a device can be read, until a time, or until wake(), whichever comes first."""

    def __init__(self) -> None:
        """Use it in one thread; wake() may come from any."""
        self._read_end, self._write_end = os.pipe()
        for end in (self._read_end, self._write_end):
            os.set_blocking(end, False)

    def wake(self) -> None:
        """End the wait, or else the next one."""
        try:
            os.write(self._write_end, b"!")
        except BlockingIOError:
            pass  # woken often enough

    def wait(self, until: float, device: Device | None = None) -> bool:
        """Wait until a time of time.monotonic() [s]; return whether the device can be read."""
        # Not poll(), which counts in whole milliseconds.
        timeout = max(0.0, until - time.monotonic())
        files: list[int | Device] = [self._read_end, *([device] if device else [])]
        readable, _, _ = select.select(files, (), (), timeout)
        if self._read_end in readable:
            os.read(self._read_end, 4096)
        return device in readable
