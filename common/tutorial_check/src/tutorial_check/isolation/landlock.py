"""Landlock and seccomp: without any privilege a program keeps to its own files.

For where bubblewrap cannot make namespaces. Of https://docs.kernel.org/userspace-api/landlock.html,
linux/landlock.h, linux/seccomp.h and the kernel's tables of system calls.
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
from typing import Iterable

from tutorial_check.isolation.privileges import prctl

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446
# Version 3 (Linux 6.2) also guards against truncation, version 6 (Linux 6.12) against signals.
OLDEST, WITH_SCOPES = 3, 6
EVERYTHING = (1 << 15) - 1  # rights of OLDEST
EXECUTE, WRITE, READ, LIST, TRUNCATE = 1 << 0, 1 << 1, 1 << 2, 1 << 3, 1 << 14
OF_FILES = EXECUTE | WRITE | READ | TRUNCATE
SIGNALS = 1 << 1  # scope: only to those of the same restriction
DEVICES = tuple(f"/dev/{name}" for name in ("null", "zero", "full", "random", "urandom"))
# {machine: (its number in linux/audit.h, socket, other system calls that lead out)}. Those are
# shmget, semget, msgget, mq_open, and io_uring_setup, which would open sockets past the filter.
MACHINES = {
    "x86_64": (0xC000003E, 41, (29, 64, 68, 240, 425)),
    "aarch64": (0xC00000B7, 198, (194, 190, 186, 180, 425)),
}
FAMILIES = (socket.AF_INET, socket.AF_INET6, socket.AF_NETLINK)  # and not a desktop's
PR_SET_SECCOMP, FILTER, ALLOWED, REFUSED = 22, 2, 0x7FFF0000, 0x00050000 | 13  # by EACCES
X32 = 0x40000000  # and above: system calls of x86_64 with numbers of their own


def _call(number: int, *arguments: object) -> int:
    """Return what a system call returns. Raises OSError."""
    found = int(ctypes.CDLL(None, use_errno=True).syscall(ctypes.c_long(number), *arguments))
    if found < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return found


@functools.lru_cache(maxsize=None)
def version() -> int:
    """Return the version of Landlock on this system; 0 without it, or if it does not suffice."""
    if platform.machine() not in MACHINES or not Path("/proc/sys/kernel/seccomp").is_dir():
        return 0
    found = 0
    with contextlib.suppress(OSError):
        found = _call(CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(1))
    return found if found >= OLDEST else 0


def ruleset(shown: Iterable[str | Path], own: Iterable[str | Path]) -> int:
    """Return a descriptor for confine(). shown: read and run; own: also written. Raises OSError."""
    about = struct.pack("=QQQ", EVERYTHING, 0, SIGNALS if version() >= WITH_SCOPES else 0)
    made = _call(CREATE_RULESET, about, ctypes.c_size_t(len(about)), ctypes.c_uint32(0))
    rows = [(path, EXECUTE | READ | LIST) for path in shown]
    rows += [(path, EVERYTHING) for path in own] + [(path, READ | WRITE) for path in DEVICES]
    for path, rights in (row for row in rows if os.path.exists(row[0])):
        place = os.open(path, os.O_PATH | os.O_CLOEXEC)
        fitting = rights if os.path.isdir(path) else rights & OF_FILES
        _call(ADD_RULE, made, 1, struct.pack("=Qi", fitting, place), ctypes.c_uint32(0))
        os.close(place)
    return made


def confine(descriptor: int) -> None:
    """Confine this process and its children for good, once rights are given up. Raises OSError."""
    _call(RESTRICT_SELF, descriptor, ctypes.c_uint32(0))
    machine, open_socket, others = MACHINES[platform.machine()]
    # The codes stand in linux/bpf_common.h.
    load, equal, at_least, end = 0x20, 0x15, 0x35, 0x06
    # Each (code, steps forward if so, if not, value); the steps count the instructions in between.
    steps = [(load, 0, 0, 4), (equal, 1, 0, machine), (end, 0, 0, REFUSED), (load, 0, 0, 0)]
    steps += [(at_least, 0, 1, X32), (end, 0, 0, REFUSED)]
    for number in others:
        steps += [(equal, 0, 1, number), (end, 0, 0, REFUSED)]
    steps += [(equal, 1, 0, open_socket), (end, 0, 0, ALLOWED), (load, 0, 0, 16)]  # its family
    steps += [(equal, len(FAMILIES) - at, 0, family) for at, family in enumerate(FAMILIES)]
    steps += [(end, 0, 0, REFUSED), (end, 0, 0, ALLOWED)]
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *step) for step in steps))
    program = struct.pack("HP", len(steps), ctypes.addressof(code))
    if prctl(PR_SET_SECCOMP, FILTER, ctypes.create_string_buffer(program)):
        raise OSError("this system does not filter system calls")
