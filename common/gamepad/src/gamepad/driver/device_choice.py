"""Which gamepad to open, and what to report if there is none."""

from __future__ import annotations

import errno
import os
from typing import Mapping

from gamepad.errors import DeviceError

NO_GAMEPAD = (
    "No gamepad? rosrun gamepad virtual_joystick makes one; so does virtual:=true, for a launch "
    "file of this suite."
)


def check_trust(path: str, status: os.stat_result, user: int, group: int) -> None:
    """Raise DeviceError if others than a user and root may write to a FIFO or a file.

    The user's own group may write: Ubuntu's umask 002 allows that for every new file.
    """
    others = 0o002 if status.st_gid in {group, 0} else 0o022
    if status.st_uid not in {user, 0} or status.st_mode & others:
        why = "belongs to another user, or others can write to it and drive the robot"
        raise DeviceError(f"{path} {why}: choose another path, or: chmod go-w {path}")


def choose_by_name(names: Mapping[str, str], wanted: str) -> str:
    """Return the path of the gamepad whose name is, or else contains, the wanted name.

    names: by path. Raises DeviceError if no gamepad matches, or several contain the name.
    """
    paths = sorted(names)
    exact = [path for path in paths if names[path] == wanted]
    if exact:
        return exact[0]
    part = [path for path in paths if wanted in names[path]]
    if len(part) == 1:
        return part[0]
    there = ", ".join([f"{names[path]!r} ({path})" for path in part or paths]) or "none at all"
    if part:
        raise DeviceError(
            f"~dev_name {wanted!r} matches several gamepads, write more of it: {there}."
        )
    raise DeviceError(f"No gamepad is named {wanted!r}; there are: {there}. Plug it in.")


def explain(path: str, error_number: int, container: bool, wsl: bool) -> str:
    """Return one line on why a device cannot be opened, and what to do.

    error_number: errno. container, wsl: whether this runs in a container or in WSL.
    """
    if error_number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        if not path.startswith("/dev/"):
            return f"No joystick at {path} yet: waiting for it."
        if wsl:
            help_line = "in WSL, attach it from Windows first: usbipd attach --wsl --busid ID"
        elif container:
            help_line = f"this is a container, start it with --device {path}"
        else:
            help_line = "plug it in (ls /dev/input/js* lists joysticks)"
        return f"No joystick at {path}: {help_line}. {NO_GAMEPAD}"
    if error_number == errno.EACCES:
        return (
            f"No permission to read {path}: join the group of the device "
            "(sudo usermod -aG input $USER) and log in again."
        )
    if error_number == errno.EPERM and container:
        return f"This container may not open {path}: start it with --device {path}."
    return f"Cannot open {path}: {os.strerror(error_number)}."
