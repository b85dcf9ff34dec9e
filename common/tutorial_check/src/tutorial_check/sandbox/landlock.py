"""Landlock and seccomp restrict a program to its own files, without any privilege.

Used where bubblewrap cannot make namespaces. Sources:
https://docs.kernel.org/userspace-api/landlock.html, linux/landlock.h, linux/seccomp.h and the
kernel's tables of system calls.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import os
import platform
import socket
import struct
from pathlib import Path
from typing import Iterable, Sequence

from tutorial_check.sandbox.privileges import prctl

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
# {version: rights on files that it added}: Linux 5.13, 5.19 (rename to another folder, which
# version 1 always refuses), 6.2 (truncation), 6.10 (ioctl of devices). The rights on TCP (6.7) are
# about ports, not addresses, so they cannot distinguish loopback from the network.
ADDED = {1: (1 << 13) - 1, 2: 1 << 13, 3: 1 << 14, 5: 1 << 15}
EXECUTE, WRITE, READ, LIST, TRUNCATE, IOCTL = 1 << 0, 1 << 1, 1 << 2, 1 << 3, 1 << 14, 1 << 15
OF_FILES = EXECUTE | WRITE | READ | TRUNCATE | IOCTL
WITH_TRUNCATE, WITH_SCOPES = 3, 6  # Linux 6.12: scopes
SIGNALS = 1 << 1  # scope: only to processes of the same restriction
DEVICES = tuple(f"/dev/{name}" for name in ("null", "zero", "full", "random", "urandom"))
# {machine: (its number in linux/audit.h, socket(), other system calls that lead out)}: shmget,
# semget, msgget, mq_open, and io_uring_setup, which would open sockets past the filter.
MACHINES = {
    "x86_64": (0xC000003E, 41, (29, 64, 68, 240, 425)),
    "aarch64": (0xC00000B7, 198, (194, 190, 186, 180, 425)),
}
# For versions of Landlock that do not restrict truncation: {machine: (truncate and openat2,
# {open, openat: index of the flags argument})}. Opening a file for reading may truncate it, too.
TRUNCATING = {"x86_64": ((76, 437), {2: 1, 257: 2}), "aarch64": ((45, 437), {56: 2})}
TRUNCATES = os.O_TRUNC | os.O_ACCMODE
FAMILIES = (socket.AF_INET, socket.AF_INET6, socket.AF_NETLINK)  # not a desktop's AF_UNIX
# In namespaces a program sees no desktop. AF_VSOCK leads out of them, to the machine.
IN_NAMESPACES = (socket.AF_UNIX, *FAMILIES)
PR_SET_SECCOMP, FILTER, ALLOWED, REFUSED = 22, 2, 0x7FFF0000, 0x00050000 | 13  # with EACCES
LOAD, EQUAL, AT_LEAST, AND, RETURN = 0x20, 0x15, 0x35, 0x54, 0x06  # Source: linux/bpf_common.h.
X32 = 0x40000000  # from here on: x86_64's second set of system calls


def _call(number: int, *arguments: object) -> int:
    """Make a system call; return its result. Raises OSError."""
    result = int(ctypes.CDLL(None, use_errno=True).syscall(ctypes.c_long(number), *arguments))
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return result


@functools.lru_cache(maxsize=None)
def version() -> int:
    """Return the version of Landlock here; 0 if there is none, or on an unknown machine."""
    if platform.machine() not in MACHINES or not Path("/proc/sys/kernel/seccomp").is_dir():
        return 0
    with contextlib.suppress(OSError):
        return _call(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(1))
    return 0


def rights_of(known: int) -> int:
    """Return all rights on files of a version of Landlock."""
    return sum(rights for since, rights in ADDED.items() if since <= known)


def ruleset(readable: Iterable[str | Path], own: Iterable[str | Path]) -> int:
    """Return a descriptor for confine(). Raises OSError.

    readable: what may be read and run. own: what may also be written.
    """
    everything = rights_of(version())
    about = struct.pack("=QQQ", everything, 0, SIGNALS if version() >= WITH_SCOPES else 0)
    made = _call(CREATE_RULESET, about, ctypes.c_size_t(len(about)), ctypes.c_uint32(0))
    rows = [(path, EXECUTE | READ | LIST) for path in readable]
    rows += [(path, everything) for path in own]
    rows += [(path, (READ | WRITE | IOCTL) & everything) for path in DEVICES]
    for path, rights in (row for row in rows if os.path.exists(row[0])):
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
        fitting = rights if os.path.isdir(path) else rights & OF_FILES
        _call(ADD_RULE, made, 1, struct.pack("=Qi", fitting, place), ctypes.c_uint32(0))
        os.close(place)
    return made


def confine(descriptor: int) -> None:
    """Confine this process and its children for good, after give_up_rights(). Raises OSError."""
    _call(RESTRICT_SELF, descriptor, ctypes.c_uint32(0))
    _filter_calls(FAMILIES, MACHINES[platform.machine()][2], version() < WITH_TRUNCATE)


def confine_sockets() -> None:
    """Refuse sockets that lead out of a program's namespaces, if Linux can do that."""
    if platform.machine() in MACHINES:
        with contextlib.suppress(OSError):
            _filter_calls(IN_NAMESPACES, MACHINES[platform.machine()][2][-1:], False)


def _filter_calls(families: Sequence[int], refused_calls: Sequence[int], truncating: bool) -> None:
    """Refuse system calls. families: of allowed sockets. truncating: refuse that, too."""
    machine, open_socket, _ = MACHINES[platform.machine()]
    others = [*refused_calls]
    refused = [(RETURN, 0, 0, REFUSED)]
    # Each (code, jump if true, jump if false, value); jumps count the instructions to skip.
    steps = [(LOAD, 0, 0, 4), (EQUAL, 1, 0, machine), *refused, (LOAD, 0, 0, 0)]
    steps += [(AT_LEAST, 0, 1, X32), *refused]
    if truncating:
        paths, flags = TRUNCATING[platform.machine()]
        others += paths
        for number, argument in flags.items():
            steps += [(EQUAL, 0, 5, number), (LOAD, 0, 0, 16 + 8 * argument)]
            steps += [(AND, 0, 0, TRUNCATES), (EQUAL, 0, 1, os.O_TRUNC), *refused, (LOAD, 0, 0, 0)]
    for number in others:
        steps += [(EQUAL, 0, 1, number), *refused]
    steps += [(EQUAL, 1, 0, open_socket), (RETURN, 0, 0, ALLOWED), (LOAD, 0, 0, 16)]  # its family
    steps += [(EQUAL, len(families) - at, 0, family) for at, family in enumerate(families)]
    steps += [*refused, (RETURN, 0, 0, ALLOWED)]
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *step) for step in steps))
    program = struct.pack("HP", len(steps), ctypes.addressof(code))
    if prctl(PR_SET_SECCOMP, FILTER, ctypes.create_string_buffer(program)):
        raise OSError("this system does not filter system calls")
