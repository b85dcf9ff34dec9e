"""What this computer knows of its serial ports, and who may and does use them."""

from __future__ import annotations

import grp
import os
import pwd
from pathlib import Path

from serial.tools import list_ports

from kobuki_driver.link.port_advice import Port

VENDOR, PRODUCT = 0x0403, 0x6001  # the converter of FTDI (kobuki_ftdi's 57-kobuki.rules)
SERIAL = "kobuki"  # how the converter's number begins
LINES = "/dev/tty"  # and not /dev/pts: a simulation may hold its own end


def ports() -> list[Port]:
    """Return the USB ports with a serial line."""
    return [
        Port(
            port.device,
            (port.vid, port.pid) == (VENDOR, PRODUCT)
            and (port.serial_number or "").lower().startswith(SERIAL),
            port.product or port.description or "",
        )
        for port in sorted(list_ports.comports())
        if port.vid is not None
    ]


def holder(path: str) -> str:
    """Return another program that has the port open, as "name (pid 1)", or "" if none is seen."""
    device = os.path.realpath(path)
    if not device.startswith(LINES):
        return ""
    for folder in Path("/proc").glob("[0-9]*"):
        if folder.name == str(os.getpid()):
            continue
        try:
            if device in (os.readlink(fd) for fd in (folder / "fd").iterdir()):
                return f"{(folder / 'comm').read_text().strip()} (pid {folder.name})"
        except OSError:  # it has ended, or belongs to another user
            continue
    return ""


def access(path: str) -> tuple[str, str, bool]:
    """Return the group that may use a device ("" if none may), this user, and if it is a member.

    A member that has no permission began its session before it became one.
    """
    about = os.stat(path)
    user = pwd.getpwuid(os.getuid()).pw_name
    if about.st_mode & 0o060 != 0o060:
        return "", user, False
    group = grp.getgrgid(about.st_gid)
    return group.gr_name, user, user in group.gr_mem


def latency_timer_ms(path: str) -> int | None:
    """Return how long FTDI's converter waits for more bytes [ms]; None if it is another one."""
    name = Path(os.path.realpath(path)).name
    try:
        return int(Path(f"/sys/bus/usb-serial/devices/{name}/latency_timer").read_text())
    except (OSError, ValueError):
        return None
