"""A pseudo terminal as a serial line, which a driver opens by its path or by a link."""

from __future__ import annotations

import os
import select
import tty
from contextlib import suppress

READ_BYTES = 4096


class SerialLine:
    """The robot's end of the line; bytes sent while no driver has the other end open are lost."""

    def __init__(self, link: str = "") -> None:
        """Open the line; link: path of a symlink to it, or empty. Raises ValueError, one line."""
        self._master, slave = os.openpty()
        try:
            tty.setraw(slave)  # and it stays raw
            self.path = os.ttyname(slave)
        finally:
            os.close(slave)
        os.set_blocking(self._master, False)
        self._link = link
        try:
            self._make_link()
        except (OSError, ValueError) as error:
            os.close(self._master)
            why = error.strerror if isinstance(error, OSError) else error
            raise ValueError(f"~link: {link!r}: {why}") from None

    def _make_link(self) -> None:
        if not self._link:
            return
        if os.path.islink(self._link):
            target = os.path.realpath(self._link)
            if os.path.exists(target) and target != self.path:
                raise ValueError(f"leads to {target}, which exists; end its program, or remove it")
            os.remove(self._link)  # left by a program that was killed
        os.symlink(self.path, self._link)

    @property
    def port(self) -> str:
        """Return the path for a driver: the link, if there is one."""
        return os.path.abspath(self._link) if self._link else self.path

    @property
    def descriptor(self) -> int:
        """Return the file descriptor, for select()."""
        return self._master

    @property
    def is_open(self) -> bool:
        """Return whether a driver has the other end open."""
        poll = select.poll()
        poll.register(self._master, 0)  # a hang-up is always reported
        return not poll.poll(0)

    def write(self, data: bytes) -> None:
        """Send bytes; those that do not fit, while the driver does not read, are lost."""
        if not data or not self.is_open:
            return
        with suppress(OSError):
            os.write(self._master, data)

    def read(self) -> bytes:
        """Return what the driver has sent; empty if it sent nothing."""
        try:
            return os.read(self._master, READ_BYTES)
        except OSError:  # nothing has come, or the line is closed
            return b""

    def drain(self) -> None:
        """Discard what the driver has sent so far."""
        while self.read():
            pass

    def unplug(self) -> None:
        """Close the line for good: the driver's end fails, the path and the link disappear."""
        os.close(self._master)
        with suppress(OSError):
            if self._link and os.readlink(self._link) == self.path:
                os.remove(self._link)
