"""What kind of machine this is: a container, Linux in Windows."""

from __future__ import annotations

import os
from pathlib import Path

MARKS = ("/.dockerenv", "/run/.containerenv")
# The namespaces of the machine itself; these numbers are fixed in Linux's include/linux/proc_ns.h.
INITIAL = {"cgroup": 0xEFFFFFFB, "pid": 0xEFFFFFFC, "uts": 0xEFFFFFFE, "ipc": 0xEFFFFFFF}


def in_container(root: str = "/") -> bool:
    """Return whether an engine's mark is there, and a namespace is not the machine's own.

    The mark alone is no proof: a virtual machine made from a container's image keeps it.
    """
    if not any(os.path.exists(root + mark) for mark in MARKS):
        return False
    folder = Path(root, "proc/self/ns")
    try:
        return any(os.readlink(folder / kind) != f"{kind}:[{n}]" for kind, n in INITIAL.items())
    except OSError:
        return True  # a kernel without one of them


def in_wsl() -> bool:
    """Return whether this is the Windows Subsystem for Linux, whose kernel has Microsoft's name."""
    return "microsoft" in os.uname().release.lower()
