"""Opening and reading joystick devices."""

from __future__ import annotations

import array
import errno
import fcntl
import glob
import os
import stat
from pathlib import Path

from gamepad.driver.device_choice import check_trust, choose_by_name, explain
from gamepad.errors import DeviceError
from gamepad.gamepads import trigger_axes
from gamepad.js_event import EVENT_BYTES
from node_kit.io.machine import in_container, in_wsl

# linux/joystick.h
_JSIOCGAXES = 0x80016A11  # number of axes (u8)
_JSIOCGNAME_128 = 0x80806A13  # name, at most 128 bytes
_JSIOCGAXMAP = 0x80406A32  # ABS_* of each axis (64 u8)

_READ_BYTES = 64 * EVENT_BYTES  # as many events as the kernel keeps for a reader


class JoystickDevice:
    """An open gamepad; close() it.

    path: of the device. name: reported by the device, or "". usb_id: as lsusb prints it, or "".
    triggers: numbers of the axes that are triggers, None if unknown. kernel_device: whether it is a
    joystick of the kernel, not a FIFO or a file. content: identity and modification time of a plain
    file, else None.
    """

    def __init__(self, path: str) -> None:
        """Open a device. Raises OSError, or DeviceError if it is no joystick."""
        self.path, self.name, self.usb_id = path, "", ""
        self.triggers: tuple[int, ...] | None = None
        # Non-blocking, as opening a FIFO would wait for its other end.
        self._fd = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        status = os.fstat(self._fd)
        self.kernel_device = stat.S_ISCHR(status.st_mode)
        self.content: tuple[int, ...] | None = None
        try:
            if self.kernel_device:
                self._ask()
            elif stat.S_ISREG(status.st_mode):
                self.content = (status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns)
            elif not stat.S_ISFIFO(status.st_mode):
                raise DeviceError(f"{path} is no joystick: a device such as /dev/input/js0 is.")
            if not self.kernel_device:
                check_trust(path, status, os.getuid(), os.getgid())
        except BaseException:
            self.close()
            raise

    def _ask(self) -> None:
        name, codes, count = bytearray(128), array.array("B", [0] * 64), bytearray(1)
        try:
            fcntl.ioctl(self._fd, _JSIOCGNAME_128, name)
            fcntl.ioctl(self._fd, _JSIOCGAXES, count)
            fcntl.ioctl(self._fd, _JSIOCGAXMAP, codes)
        except OSError as error:
            if error.errno not in (errno.ENOTTY, errno.EINVAL):
                raise
            raise DeviceError(
                f"{self.path} is another kind of device: a joystick is /dev/input/js0 or the like."
            ) from None
        self.name = name.split(b"\0")[0].decode(errors="replace")
        self.triggers = trigger_axes(codes[: count[0]])
        folder = Path("/sys/class/input", Path(self.path).resolve().name, "device", "id")
        ids = [folder / "vendor", folder / "product"]
        if all([path.exists() for path in ids]):  # a container may have no /sys
            self.usb_id = ":".join([path.read_text().strip() for path in ids])

    @property
    def identity(self) -> tuple[str, str]:
        """Differs between models; stays the same when the gamepad is plugged in again."""
        return self.name, self.usb_id

    def fileno(self) -> int:
        """For select()."""
        return self._fd

    def read(self) -> bytes:
        """Return the available bytes, perhaps none. Raises DeviceError if the gamepad is gone."""
        try:
            data = os.read(self._fd, _READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise DeviceError(f"Lost the joystick {self.path}: {error.strerror}.") from None
        if not data:
            raise DeviceError(f"Lost the joystick {self.path}: its other end was closed.")
        return data

    def close(self) -> None:
        """Close the device."""
        os.close(self._fd)


class Finder:
    """Opens the gamepad that the user chose, and after a loss only the same gamepad."""

    def __init__(self, dev: str, dev_name: str) -> None:
        """Take the path, or the name or a part of it, which is used unless it is empty."""
        self._dev, self._name = dev, dev_name
        self._identity: tuple[str, str] | None = None  # the first opened gamepad
        self._content: tuple[int, ...] | None = None  # the last opened plain file

    def open(self) -> JoystickDevice:
        """Open the gamepad. Raises DeviceError if it does not exist."""
        device = self._open_by_name() if self._name else _open(self._dev)
        first, problem = self._identity, None
        if first and first != device.identity:
            problem = (
                f"{device.path} is now {device.name!r} ({device.usb_id}) and not {first[0]!r} "
                f"({first[1]}): plug that in again, or restart this node to use another gamepad."
            )
        elif device.content and device.content == self._content:
            problem = f"{device.path} is a plain file, which has been read to its end."
        if problem:
            device.close()
            raise DeviceError(problem)
        self._identity, self._content = device.identity, device.content
        return device

    def _open_by_name(self) -> JoystickDevice:
        # Open all, and close all but one: a name that is read before opening may belong to a
        # gamepad that was unplugged in the meantime.
        devices, errors = {}, []
        for path in glob.glob("/dev/input/js*"):
            try:
                devices[path] = _open(path)
            except DeviceError as error:
                errors.append(str(error))
        try:
            names = {
                path: device.name
                for path, device in devices.items()
                if self._identity in (None, device.identity)
            }
            return devices.pop(choose_by_name(names, self._name))
        except DeviceError as error:
            raise DeviceError(" ".join([str(error), *errors])) from None
        finally:
            for device in devices.values():
                device.close()


def _open(path: str) -> JoystickDevice:
    try:
        return JoystickDevice(path)
    except OSError as error:
        raise DeviceError(explain(path, error.errno or 0, in_container(), in_wsl())) from None
