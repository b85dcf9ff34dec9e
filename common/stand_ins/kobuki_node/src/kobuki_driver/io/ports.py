"""The serial ports of this computer, their permissions, and the programs that use them."""

from __future__ import annotations

import grp
import os
import pwd
from pathlib import Path

from serial.tools import list_ports

from kobuki_driver.link.port_advice import Port

VENDOR, PRODUCT = 0x0403, 0x6001  # the converter of FTDI (kobuki_ftdi's 57-kobuki.rules)
SERIAL = "kobuki"  # the beginning of the converter's serial number
LINES = "/dev/tty"  # not /dev/pts, where a simulation may have its own end open


def ports() -> list[Port]:
    """Return the serial ports on USB."""
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
    """Return another program that has the port open, as "name (pid 1)", or ""."""
    device = os.path.realpath(path)
    if not device.startswith(LINES):
        return ""
    for folder in Path("/proc").glob("[0-9]*"):
        if folder.name == str(os.getpid()):
            continue
        try:
            if device in (os.readlink(fd) for fd in (folder / "fd").iterdir()):
                return f"{(folder / 'comm').read_text().strip()} (pid {folder.name})"
        except OSError:  # the process has exited, or belongs to another user
            continue
    return ""


def access(path: str) -> tuple[str, str, bool]:
    """Return the group that may use a device ("" for none), this user, and whether it is a member.

    A member without permission joined the group after the session began.
    """
    about = os.stat(path)
    user = pwd.getpwuid(os.getuid()).pw_name
    if about.st_mode & 0o060 != 0o060:
        return "", user, False
    group = grp.getgrgid(about.st_gid)
    return group.gr_name, user, user in group.gr_mem


def latency_timer_ms(path: str) -> int | None:
    """Return the latency timer [ms] of FTDI's converter; None for another converter."""
    name = Path(os.path.realpath(path)).name
    try:
        return int(Path(f"/sys/bus/usb-serial/devices/{name}/latency_timer").read_text())
    except (OSError, ValueError):
        return None
