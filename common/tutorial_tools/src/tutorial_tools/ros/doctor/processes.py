"""Finds the nodes on this machine, including those that the master does not know.

It calls only programs that have loaded roscpp or opened a log of rospy: a call might disturb other
servers. It does not see the processes of other users.
"""

from __future__ import annotations

import contextlib
import os
import re
import socket
import struct
from pathlib import Path
from typing import NamedTuple
from urllib.parse import urlsplit

import rospkg

from node_kit.rules.answer import Answer
from tutorial_tools.doctor.facts import Stray
from tutorial_tools.ros.doctor.network import addresses, at_once, call, header, is_here

PROC = Path("/proc")
LISTENS = "0A"  # The state of a listening socket in /proc/net/tcp.
ASK_S = 5.0  # The timeout for all nodes together.


class Running(NamedTuple):
    """A node that answers on this machine."""

    uri: str
    name: str
    pid: int
    master_uri: str


def running() -> list[Running]:
    """Return the nodes of this machine, whichever master they use."""
    ports = _listening()
    uris: dict[int, list[str]] = {}
    for process in PROC.glob("[0-9]*"):
        pid = int(process.name)
        with contextlib.suppress(OSError):  # it has ended, or is another user's
            sockets = [ports[link] for link in _descriptors(process) if link in ports]
            if sockets and pid != os.getpid() and _is_of_ros(process):
                # The port for calls first, as the one for messages warns of a call. roscpp opens
                # it second, rospy first.
                uris[pid] = sockets[::-1] if _is_of_roscpp(process) else sockets
    answers = at_once(lambda pid: _ask(pid, uris[pid]), uris, ASK_S)
    return [node for _, node in sorted(answers.items()) if node]


def strays(nodes: list[Running], master_uri: str, known: set[str]) -> list[Stray]:
    """Return those of the nodes that still run and that the master does not know.

    known: the URIs of the nodes that it knew a moment ago.
    """
    lost, ports = [], {urlsplit(uri).port for uri in known}
    for node in nodes:
        if node.name == "/rosout" or urlsplit(node.uri).port in ports:
            continue  # rosout comes and goes with its roscore
        own = "" if is_same(node.master_uri, master_uri) else node.master_uri.rstrip("/")
        _, registered = call(master_uri, "lookupNode", node.name)
        is_known = (
            isinstance(registered, str) and urlsplit(registered).port == urlsplit(node.uri).port
        )
        if not is_known and call(node.uri, "getPid")[0] is Answer.WELL:
            lost.append(Stray(node.name, node.pid, own))
    return lost


def is_same(uri: str, other: str) -> bool:
    """Return whether two URIs lead to the same master."""
    with contextlib.suppress(ValueError):
        first, second = urlsplit(uri), urlsplit(other)
        if first.port != second.port:
            return False
        mine, theirs = addresses(first.hostname or ""), addresses(second.hostname or "")
        local = bool(mine and theirs) and all(map(is_here, [*mine, *theirs]))
        return first.hostname == second.hostname or local or bool({*mine} & {*theirs})
    return False


def _listening() -> dict[str, str]:
    """Return {link of a descriptor: URI} for the listening ports of this machine."""
    uris = {}
    for table in ("tcp", "tcp6"):
        with contextlib.suppress(OSError):
            for line in (PROC / "net" / table).read_text().splitlines()[1:]:
                _, local, _, state, *rest = line.split()
                number, port = local.split(":")
                host = "[::1]"
                if table == "tcp":
                    host = socket.inet_ntoa(struct.pack("=I", int(number, 16)))
                host = "127.0.0.1" if host == "0.0.0.0" else host
                if state == LISTENS:
                    uris[f"socket:[{rest[5]}]"] = f"http://{host}:{int(port, 16)}/"
    return uris


def _descriptors(process: Path) -> list[str]:
    """Return the targets of a process's descriptors, in order."""
    links = []
    for path in sorted((process / "fd").iterdir(), key=lambda path: int(path.name)):
        with contextlib.suppress(OSError):  # closed meanwhile
            links.append(os.readlink(path))
    return links


def _is_of_ros(process: Path) -> bool:
    log = re.compile(re.escape(rospkg.get_log_dir()) + r".*\.log(\.\d+)?( \(deleted\))?")
    if any(log.fullmatch(link) for link in _descriptors(process)):
        return True
    return _is_of_roscpp(process)


def _is_of_roscpp(process: Path) -> bool:
    return b"/libroscpp.so" in (process / "maps").read_bytes()


def _ask(pid: int, uris: list[str]) -> Running | None:
    """Return the node of a process, which may listen on several ports."""
    for uri in uris:
        answer, topics = call(uri, "getPublications")  # A master and roslaunch have no such method.
        if answer is Answer.WELL:
            _, name = call(uri, "getName")  # Only rospy has these two.
            _, master_uri = call(uri, "getMasterUri")
            if not name and topics:
                name = header(uri, topics[-1][0]).get("callerid")
            return Running(uri, name or _program(pid), pid, master_uri or _master_uri(pid))
    return None


def _program(pid: int) -> str:
    words = (PROC / str(pid) / "cmdline").read_bytes().decode(errors="replace").split("\0")
    names = [word[len("__name:=") :] for word in words if word.startswith("__name:=")]
    return f"/{names[0]}" if names else words[0]


def _master_uri(pid: int) -> str:
    text = (PROC / str(pid) / "environ").read_bytes().decode(errors="replace")
    uris = re.findall("(?:^|\0)ROS_MASTER_URI=([^\0]+)", text)
    return uris[0] if uris else "http://localhost:11311"
