"""A place apart: namespaces of its own where the system grants them.

Network: loopback only, so that two checks cannot meet and no program speaks to the outside. PIDs:
whatever is left ends with the check. Mounts: the home folder is hidden, /tmp is empty at first, the
student's workspace is read-only, /dev has no devices but those every program needs, and what is
written counts against a limit.
"""

import ctypes
import fcntl
import os
import socket
import struct
import subprocess
from pathlib import Path

SCRATCH_MB = 600  # for the copy, its build, logs and what the programs write
INSIDE = "TUTORIAL_CHECK_INSIDE"
DEVICES = ("null", "zero", "full", "random", "urandom", "tty")
SIOCGIFFLAGS, SIOCSIFFLAGS, IFF_UP = 0x8913, 0x8914, 1


def wrapper():
    """The command that starts another one in such a place; empty if the system grants none."""
    command = ["unshare", "--net", "--pid", "--mount", "--fork", "--kill-child", "--mount-proc"]
    if os.geteuid() != 0:
        command += ["--user", "--map-root-user"]
    try:
        tried = subprocess.run(
            [*command, "true"],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            check=False,
            timeout=60,
        )
    except (OSError, subprocess.TimeoutExpired):
        return []
    return command if tried.returncode == 0 else []


def is_inside():
    """Whether this process was started by that command."""
    return INSIDE in os.environ


def limit(scratch):
    """Have what is written in a folder count against the limit; whether that was granted."""
    try:
        _mount("-t", "tmpfs", "-o", f"size={SCRATCH_MB}m,mode=755", "none", scratch)
    except (OSError, subprocess.SubprocessError):
        return False
    return True


def furnish(scratch, home, kept):
    """Make the other mounts and the loopback; whether all was granted.

    scratch: the folder for what is written; home: the folder to hide; kept: those below it (or
    elsewhere) that are needed still, read-only.
    """
    try:
        _loopback_up()
        side = Path(scratch) / "mounts"
        side.mkdir()
        _hide(home, kept, side)
        _devices(side)
    except (OSError, subprocess.SubprocessError):
        return False
    return True


def _mount(*words):
    subprocess.run(["mount", *map(str, words)], check=True, capture_output=True, timeout=60)


def _hide(home, kept, side):
    """An empty folder in place of home; in it and elsewhere the kept ones, read-only."""
    names = {Path(each): Path(each).resolve() for each in kept if Path(each).is_dir()}
    kept = list(dict.fromkeys(names.values()))
    home = Path(home).resolve()
    for number, folder in enumerate(kept):
        (side / str(number)).mkdir()
        _mount("--rbind", folder, side / str(number))
    _own_tmp(side)
    if home.is_dir() and str(home) != "/":
        _mount("-t", "tmpfs", "-o", "size=1m,mode=755", "none", home)
    for number, folder in enumerate(kept):
        if not folder.is_dir():
            folder.mkdir(parents=True)
        _mount("--rbind", side / str(number), folder)
        _mount("-o", "remount,bind,ro", folder)
    for name, folder in names.items():
        # By a link that was hidden with the home folder: catkin may have written that name down.
        if not os.path.lexists(name):
            name.parent.mkdir(parents=True, exist_ok=True)
            name.symlink_to(folder)


def _own_tmp(side):
    """A /tmp of its own, where no other student's file is in the way; with side, if that is in it."""
    tmp, scratch, new = Path("/tmp").resolve(), side.parent.resolve(), side / "tmp"
    new.mkdir()
    _mount("-t", "tmpfs", "-o", "size=64m,mode=1777", "none", new)
    if tmp in scratch.parents:
        (new / scratch.relative_to(tmp)).mkdir(parents=True)
        _mount("--rbind", scratch, new / scratch.relative_to(tmp))
    _mount("--rbind", new, tmp)


def _devices(side):
    """A /dev of its own, in which a joystick can be put."""
    new = side / "dev"
    new.mkdir()
    _mount("-t", "tmpfs", "-o", "size=64m,mode=755", "none", new)
    for name in DEVICES:
        (new / name).touch()
        _mount("--bind", f"/dev/{name}", new / name)
    (new / "shm").mkdir(mode=0o1777)
    os.chmod(new / "shm", 0o1777)
    (new / "fd").symlink_to("/proc/self/fd")
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        (new / name).symlink_to(f"/proc/self/fd/{number}")
    (new / "input").mkdir()
    _mount("--rbind", new, "/dev")


def _loopback_up():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        request = struct.pack("16sH14s", b"lo", 0, b"")
        flags = struct.unpack("16sH14s", fcntl.ioctl(probe, SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(probe, SIOCSIFFLAGS, struct.pack("16sH14s", b"lo", flags | IFF_UP, b""))


def end_with_parent():
    """Have the kernel end this process when the one that started it ends."""
    pr_set_pdeathsig, sigkill = 1, 9
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, sigkill)
