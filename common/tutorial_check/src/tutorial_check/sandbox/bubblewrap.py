"""Isolation by bubblewrap: a student's program sees its own copy and nobody else's files.

Network: loopback only. Processes and System V shared memory: its own, which end with the check.
Files: the system and what students use of this suite, read-only; an empty /tmp, /var/tmp and
/dev/shm of limited size; no /run. Capabilities: none, and no way to gain one.
"""

from __future__ import annotations

import contextlib
import functools
import os
import shutil
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path
from subprocess import DEVNULL, PIPE
from typing import Any, Iterable, Sequence

from tutorial_check.sandbox import landlock
from tutorial_check.sandbox.environment import SYSTEM

SCRATCH_MB = 600  # for the copy, its build, logs and files that programs write
NAMESPACES = ("--unshare-ipc", "--unshare-net", "--unshare-pid", "--unshare-uts", "--as-pid-1")
# Of root's capabilities, only those to become another user.
AS_ROOT = ("--cap-drop", "ALL", "--cap-add", "CAP_SETGID", "--cap-add", "CAP_SETUID")
SIZES_MB = {"/dev/shm": 64, "/tmp": 64, "/var/tmp": 64, "/dev/input": 1}  # the last for a joystick
# Replaces --perms before a command. Arguments: folders, --, the command.
OPEN = 'while [ "$1" != -- ]; do chmod 1777 "$1"; shift; done; shift; exec "$@"'
OPENED = ("sh", "-c", OPEN, "sh")
_one_at_a_time = threading.Lock()


@dataclass(frozen=True)
class Isolation:
    """How bubblewrap isolates on this system."""

    options: tuple[str, ...] = ()  # words of its command; none if it cannot isolate
    is_limited: bool = False  # programs cannot fill the memory with files
    has_sizes: bool = True  # it knows --size, since 0.7
    has_perms: bool = True  # it knows --perms, since 0.5
    why: str = ""  # it cannot isolate
    descriptors: tuple[int, ...] = ()  # that it inherits


def granted() -> Isolation:
    """Return the isolation that this system grants; if none, it has no options."""
    with _one_at_a_time:  # So a second thread uses the first one's descriptors.
        return _granted()


@functools.lru_cache(maxsize=None)
def _granted() -> Isolation:
    bwrap = shutil.which("bwrap")
    if not bwrap:
        return Isolation(why="bubblewrap is not installed")
    descriptors: tuple[int, ...] = ()
    # bubblewrap has --disable-userns since 0.8, but refuses it to root.
    users: tuple[str, ...] = ("--unshare-user",)
    closed = (*users, "--disable-userns")
    if os.geteuid() == 0:
        users = closed = AS_ROOT
        with contextlib.suppress(OSError):
            descriptors = (_closed_user_namespace(),)
            closed = ("--userns", str(descriptors[0]), *users)
    why = ""
    ways = ((closed, True, True), (users, True, True), (users, False, True), (users, False, False))
    for more, has_sizes, has_perms in dict.fromkeys(ways):
        options = (bwrap, *NAMESPACES, *more)
        is_limited = has_sizes and closed != users and more == closed
        isolation = Isolation(options, is_limited, has_sizes, has_perms, "", descriptors)
        everything = ["--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev"]
        why = _fault([*options, *everything, *_tmpfs("/tmp", 1, isolation), "true"], descriptors)
        if not why:
            return isolation
    return Isolation(why=why)


def _closed_user_namespace() -> int:
    """Return a descriptor of a user namespace with root's users, where nobody can make another.

    A program in its own user namespace could mount a tmpfs of any size. Raises OSError.
    """
    words = ["unshare", "--user", "sh", "-c", "echo; read -r _"]
    with subprocess.Popen(words, stdin=PIPE, stdout=PIPE, stderr=DEVNULL) as made:
        assert made.stdin and made.stdout
        if not made.stdout.readline():
            raise OSError("no user namespace can be made")
        for name in ("uid_map", "gid_map"):
            ranges = [line.split() for line in Path("/proc/self", name).read_text().splitlines()]
            lines = [f"{first} {first} {count}\n" for first, _, count in ranges]
            Path(f"/proc/{made.pid}", name).write_text("".join(lines))
        close = "echo 0 >/proc/sys/user/max_user_namespaces"
        why = _fault(["nsenter", "--user", f"--target={made.pid}", "sh", "-c", close])
        if why:
            raise OSError(why)
        return os.open(f"/proc/{made.pid}/ns/user", os.O_RDONLY)


def _fault(command: Sequence[str], descriptors: tuple[int, ...] = ()) -> str:
    """Return why a command fails; empty if it does not."""
    about: dict[str, Any] = {"stdin": DEVNULL, "stderr": PIPE, "stdout": DEVNULL, "timeout": 60}
    try:
        tried = subprocess.run(command, check=False, pass_fds=descriptors, **about)
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    words = tried.stderr.decode(errors="replace").split()
    return (" ".join(words) or f"{command[0]} fails") if tried.returncode else ""


def lacking() -> list[str]:
    """Return lines on what this system does not provide, to print before a verdict."""
    isolation = granted()
    if isolation.options and isolation.is_limited:
        return []
    if isolation.options:
        return ["this bubblewrap or kernel does not limit the memory that programs fill with files"]
    why = isolation.why.partition(". ")[0].rstrip(".")
    if landlock.version():
        return [f"{instead()} ({why}): a program keeps to its copy, but can use the network"]
    if os.geteuid() == 0:
        rights = "runs as another user, but can read what everybody may, use the network"
    else:
        rights = "has your rights: it can read, change and remove your files, use the network"
    return [f"no isolation here ({why}): a program {rights}, and leave files in /var/tmp"]


def instead() -> str:
    """Return what replaces bubblewrap on this system; empty if bubblewrap isolates."""
    if granted().options:
        return ""
    return "isolated by Landlock alone" if landlock.version() else "not isolated"


def _tmpfs(path: str, megabytes: int, isolation: Isolation) -> list[str]:
    size = ["--size", str(megabytes << 20)] if isolation.has_sizes else []
    return [*size, *(["--perms", "1777"] if isolation.has_perms else []), "--tmpfs", path]


def command(folder: str | Path, readable: Iterable[str | Path], hidden: str | Path) -> list[str]:
    """Return the words before a command that isolate it; empty if bubblewrap cannot.

    folder: writable, and empty at first. readable: visible, read-only. hidden: invisible.
    """
    isolation = granted()
    if not isolation.options:
        return []
    mounts = {"/proc": ["--proc", "/proc"], "/dev": ["--dev", "/dev"]}
    for path, size_mb in {**SIZES_MB, str(hidden): 1, str(folder): SCRATCH_MB}.items():
        mounts[path] = _tmpfs(path, size_mb, isolation)
    for path in SYSTEM:
        if os.path.islink(path):
            mounts[path] = ["--symlink", os.readlink(path), path]
        elif os.path.exists(path):
            mounts[path] = ["--ro-bind", path, path]
    given = {str(path) for path in readable if os.path.exists(path)}
    real = set(map(os.path.realpath, given))
    # catkin may have stored the path of a link.
    links = {path for path in given - real if not real & set(map(str, Path(path).parents))}
    mounts.update({path: ["--ro-bind", path, path] for path in real | links})
    perms = ["--perms", "0755"] if isolation.has_perms else []  # older ones always use these
    for above in {above for path in mounts for above in Path(path).parents}:  # bwrap's are closed
        mounts.setdefault(str(above), [*perms, "--dir", str(above)])
    outer_first = sorted(mounts, key=lambda path: len(Path(path).parts))
    words = [word for path in outer_first for word in mounts[path]]
    for path in ("/dev", str(hidden), "/"):
        words += ["--remount-ro", path]
    opened = () if isolation.has_perms else (*OPENED, *SIZES_MB, str(folder), "--")
    return [*isolation.options, *words, "--", *opened]
