"""A line for each problem of a serial port: what is wrong, and what to do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

RULE = "rosrun kobuki_node create_udev_rules"
WAITING = "waiting for it"


@dataclass(frozen=True)
class Port:
    """A serial port of this computer."""

    path: str
    is_kobuki: bool = False  # by the serial number of its converter
    description: str = ""


def absent(path: str, ports: Sequence[Port]) -> str:
    """Return the line for a missing port; ports: those that exist."""
    start = f"there is no {path}; {WAITING}. "
    kobukis = [port.path for port in ports if port.is_kobuki]
    if kobukis:
        return (
            f"{start}A Kobuki is at {kobukis[0]}: give serialport:={kobukis[0]}, or run once: "
            f"{RULE} (which makes /dev/kobuki)"
        )
    todo = "Plug in the robot's USB cable, or give another port with serialport:="
    others = ", ".join(_named(port) for port in ports)
    return f"{start}{todo}; there are: {others}" if others else f"{start}{todo}; there are none"


def _named(port: Port) -> str:
    return f"{port.path} ({port.description})" if port.description else port.path


def forbidden(path: str, group: str, user: str, is_member: bool) -> str:
    """Return the line for a port without permission.

    group: may use the port; "" for none. is_member: user belongs to it, but not in this session.
    """
    start = f"no permission for {path}; {WAITING}. "
    if not group:
        return f"{start}Run once: {RULE}"
    if is_member:
        return f"{start}{user} joined the group {group} after this session began: log in again"
    return f"{start}Run once: sudo usermod -aG {group} {user}; then log out and in again"


def taken(path: str, holder: str) -> str:
    """Return the line for a port that another program has; holder: "name (pid 1)", or ""."""
    who = holder or "another program"
    return f"{who} has {path} open; {WAITING}. End it: two drivers would command one robot"


def unusable(path: str, reason: str) -> str:
    """Return the line for a path that is not a serial port, or fails."""
    return f"{path} is not a working serial port ({reason}); {WAITING}. Give one with serialport:="


def silent(path: str) -> str:
    """Return the line for a port from which nothing comes."""
    return f"nothing comes from {path}: is the Kobuki switched on? {WAITING.capitalize()}"


def foreign(path: str, count: int, ports: Sequence[Port]) -> str:
    """Return the line for a port from which count bytes came, but no packet of a Kobuki."""
    kobukis = [port.path for port in ports if port.is_kobuki and port.path != path]
    todo = f"a Kobuki is at {kobukis[0]}" if kobukis else "is another device plugged in there?"
    return (
        f"{count} bytes came from {path}, but no packet of a Kobuki: {todo} "
        f"{WAITING.capitalize()}; another port: serialport:="
    )


def lost(path: str) -> str:
    """Return the line for a robot whose packets no longer come."""
    return (
        f"the Kobuki at {path} sends nothing any more: switched off, or a loose cable? "
        f"Or this computer is busy. {WAITING.capitalize()}; then it obeys the next command"
    )


def unplugged(path: str) -> str:
    """Return the line for a port that has just disappeared."""
    return (
        f"{path} is gone: was the cable unplugged? {WAITING.capitalize()}; then the robot obeys "
        "the next command"
    )


def damaged(path: str, count: int) -> str:
    """Return the line for damaged packets."""
    return (
        f"{count} packets from {path} were damaged; the others are used. Check the cable, try it "
        "without a USB hub; ./tutorial doctor shows the latency timer"
    )


def online(path: str) -> str:
    """Return the line for a robot whose packets come."""
    return (
        f"the Kobuki at {path} is online. Just switched on? Leave it still for 3 s and send "
        "nothing: its gyro starts, and the heading is wrong if it moves"
    )
