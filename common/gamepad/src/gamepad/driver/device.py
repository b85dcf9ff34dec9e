"""Opening and reading joystick devices."""

import array
import errno
import fcntl
import glob
import os
import stat
from pathlib import Path

from gamepad.driver.container import in_container
from gamepad.driver.device_choice import DeviceError, choose_by_name, explain
from gamepad.gamepads import trigger_axes
from gamepad.js_event import EVENT_BYTES

JOYSTICKS = "/dev/input/js*"

# linux/joystick.h
_JSIOCGAXES = 0x80016A11  # number of axes (u8)
_JSIOCGNAME_128 = 0x80806A13  # name, at most 128 bytes
_JSIOCGAXMAP = 0x80406A32  # ABS_* of each axis (64 u8)

_READ_BYTES = 64 * EVENT_BYTES  # as many events as the kernel keeps for a reader


class Device:
    """An open gamepad; close() it.

    path: where it was found. name: what it calls itself, "" if it cannot be asked. usb_id: as lsusb
    writes it, or "". triggers: numbers of the axes that are triggers, None if unknown.
    kernel_device: whether it is a joystick of the kernel, and not a FIFO or a file.
    """

    def __init__(self, path):
        """Open it. Raises OSError, or DeviceError if it is no joystick."""
        self.path = path
        self.name, self.usb_id, self.triggers = "", "", None
        # Not blocking: opening a FIFO would wait for its other end.
        self._fd = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        self._status = os.fstat(self._fd)
        mode = self._status.st_mode
        self.kernel_device = stat.S_ISCHR(mode)
        try:
            if self.kernel_device:
                self._ask()
            elif not (stat.S_ISFIFO(mode) or stat.S_ISREG(mode)):
                raise DeviceError(f"{path} is no joystick: a device such as /dev/input/js0 is.")
        except BaseException:
            self.close()
            raise

    def _ask(self):
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
        number = os.path.basename(os.path.realpath(self.path))
        folder = Path("/sys/class/input", number, "device", "id")
        ids = [folder / "vendor", folder / "product"]
        if all([path.exists() for path in ids]):  # a container may have no /sys
            self.usb_id = ":".join([path.read_text().strip() for path in ids])

    @property
    def identity(self):
        """What tells this gamepad from another model; the same after it was plugged in again."""
        return self.name, self.usb_id

    @property
    def recording(self):
        """What tells a plain file from another and from itself after a change; else None."""
        s = self._status
        return (s.st_dev, s.st_ino, s.st_size, s.st_mtime_ns) if stat.S_ISREG(s.st_mode) else None

    def fileno(self):
        """For select()."""
        return self._fd

    def read(self):
        """Return the bytes that are there, maybe none. DeviceError if the gamepad is gone."""
        try:
            data = os.read(self._fd, _READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise DeviceError(f"Lost the joystick {self.path}: {error.strerror}.") from None
        if not data:
            raise DeviceError(f"Lost the joystick {self.path}: its other end was closed.")
        return data

    def close(self):
        """Let go of it."""
        os.close(self._fd)


class Finder:
    """Opens the gamepad that the user asked for, and after a loss that one and no other."""

    def __init__(self, dev, dev_name):
        """dev: path. dev_name: name or part of a name, by which it is looked for if not empty."""
        self._name = dev_name
        self.pattern = JOYSTICKS if dev_name else glob.escape(dev)  # where it will appear
        self._dev = dev
        self._identity = None  # of the gamepad that was opened first
        self._recording = None  # what was opened last, if it was a plain file

    def open(self):
        """Open it; returns a Device. Raises DeviceError if it is not there."""
        device = self._open_by_name() if self._name else self._open(self._dev)
        if self._identity not in (None, device.identity):
            device.close()
            raise DeviceError(
                f"{device.path} is now {device.name!r} ({device.usb_id}) and not "
                f"{self._identity[0]!r} ({self._identity[1]}): plug that in again, or restart "
                "this node to use another gamepad."
            )
        if device.recording and device.recording == self._recording:
            device.close()
            raise DeviceError(f"{device.path} is a plain file, which has been read to its end.")
        self._identity, self._recording = device.identity, device.recording
        return device

    def _open(self, path):
        try:
            return Device(path)
        except OSError as error:
            wsl = "microsoft" in os.uname().release.lower()
            raise DeviceError(explain(path, error.errno, in_container(), wsl)) from None

    def _open_by_name(self):
        # All are opened, and then all but one closed: a name read before opening might be that of
        # a gamepad that has left meanwhile.
        devices, errors = {}, []
        for path in glob.glob(JOYSTICKS):
            try:
                devices[path] = self._open(path)
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
