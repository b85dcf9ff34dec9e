"""The serial port to the robot; each error is one line."""

from __future__ import annotations

import errno
import os

import serial

from kobuki_driver.errors import PortError
from kobuki_driver.io.ports import access, holder, ports
from kobuki_driver.link import port_advice

BAUD = 115200
READ_S = 0.04  # two of the robot's periods
WRITE_S = 0.05  # after which the commands that a port has not sent are old, and are dropped


class SerialPort:
    """An open port, locked against other drivers."""

    def __init__(self, path: str) -> None:
        """Open and lock the port. Raises PortError."""
        self.path = path
        if not os.path.exists(path):
            raise PortError(port_advice.absent(path, ports()))
        other = holder(path)
        if other:
            raise PortError(port_advice.taken(path, other))
        try:
            self._serial = serial.Serial(
                path, BAUD, timeout=READ_S, write_timeout=WRITE_S, exclusive=True
            )
        except (OSError, ValueError) as error:
            raise PortError(_why(path, error)) from None

    def read(self) -> bytes:
        """Return the bytes that have come, after at most READ_S. Raises PortError."""
        try:
            first = self._serial.read(1)
            return first and first + self._serial.read(self._serial.in_waiting)
        except (OSError, TypeError) as error:  # TypeError: pyserial, of a port that was closed
            raise PortError(self._gone(error)) from None

    def write(self, data: bytes) -> None:
        """Send bytes; if the port does not accept all, drop the rest. Raises PortError."""
        try:
            self._serial.write(data)
        except serial.SerialTimeoutException:
            self._drop()
        except OSError as error:
            raise PortError(self._gone(error)) from None

    def close(self) -> None:
        """Close and unlock the port."""
        try:
            self._serial.close()
        except OSError:
            pass

    def _drop(self) -> None:
        try:
            self._serial.reset_output_buffer()
        except OSError as error:
            raise PortError(self._gone(error)) from None

    def _gone(self, error: Exception) -> str:
        if os.path.exists(self.path):
            return port_advice.unusable(self.path, _reason(error))
        return port_advice.unplugged(self.path)


def _why(path: str, error: Exception) -> str:
    number = getattr(error, "errno", None)
    if number in (errno.EACCES, errno.EPERM):
        return port_advice.forbidden(path, *access(path))
    if number in (errno.EAGAIN, errno.EBUSY):
        return port_advice.taken(path, "")
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return port_advice.absent(path, ports())
    return port_advice.unusable(path, _reason(error))


def _reason(error: Exception) -> str:
    text = getattr(error, "strerror", None) or str(error)
    return " ".join(text.split())
