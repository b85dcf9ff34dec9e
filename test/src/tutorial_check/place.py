"""A place apart: namespaces of its own where the system grants them.

Network: loopback only, so that two checks cannot meet and no program speaks to the outside. PIDs:
whatever is left ends with the check. Mounts: the home folder is hidden, /tmp is empty at first, the
student's workspace is read-only, /dev has no devices but those every program needs, and what is
written counts against a limit.
"""

import contextlib
import ctypes
import fcntl
import os
import shutil
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
    """Make the other mounts; whether all was granted. What is refused hides nothing.

    scratch: the folder for what is written; home: the folder to hide; kept: folders and files below
    it (or elsewhere) that are needed still, read-only.
    """
    try:
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
    """Empty folders in place of home and /tmp; in them and elsewhere the kept ones, read-only.

    Each is made aside and put there in one step, so that nothing is ever hidden without what is
    kept; and with the folder for what is written, where that lies below it.
    """
    names = {Path(each): Path(each).resolve() for each in kept if Path(each).exists()}
    scratch, sizes = side.parent.resolve(), {Path("/tmp").resolve(): "size=64m,mode=1777"}
    home = Path(home).resolve()
    if home.is_dir() and str(home) != "/":
        sizes.setdefault(home, "size=1m,mode=755")
    # The same for another's folder above what is kept, which only he and root may enter.
    for folder in {above for path in names.values() for above in path.parents}:
        if not folder.stat().st_mode & 0o001:
            sizes.setdefault(folder, "size=1m,mode=755")
    # The one goes with the other where it lies below it.
    hidden = {
        each: side / f"new_{each.name}" for each in sizes if not set(each.parents) & set(sizes)
    }
    for folder, new in hidden.items():
        new.mkdir()
        _mount("-t", "tmpfs", "-o", sizes[folder], "none", new)

    def bind(path):
        over = next((each for each in hidden if each in (path, *path.parents)), None)
        there = hidden[over] / path.relative_to(over) if over else path
        if path.is_dir():
            there.mkdir(parents=True, exist_ok=True)
        elif not there.exists():
            there.parent.mkdir(parents=True, exist_ok=True)
            there.touch()
        _mount("--rbind", path, there)
        return there

    for path in dict.fromkeys(names.values()):
        _mount("-o", "remount,bind,ro", bind(path))
    if set(scratch.parents) & set(hidden):
        bind(scratch)  # with what is made aside
    for folder, new in hidden.items():
        _mount("--rbind", new, folder)
    for name, path in names.items():
        # By a link that was hidden with the home folder: catkin may have written that name down.
        if not os.path.lexists(name):
            name.parent.mkdir(parents=True, exist_ok=True)
            name.symlink_to(path)


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


def loopback_up():
    """Have this machine speak to itself, which in a network of its own nothing else does."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        request = struct.pack("16sH14s", b"lo", 0, b"")
        flags = struct.unpack("16sH14s", fcntl.ioctl(probe, SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(probe, SIOCSIFFLAGS, struct.pack("16sH14s", b"lo", flags | IFF_UP, b""))


def end_with_parent():
    """Have the kernel end this process when the one that started it ends."""
    pr_set_pdeathsig, sigkill = 1, 9
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, sigkill)


def adopt_orphans():
    """Have what is started below this process, and left by its parent, be a child of this one."""
    pr_set_child_subreaper = 36
    ctypes.CDLL(None).prctl(pr_set_child_subreaper, 1, 0, 0, 0)


@contextlib.contextmanager
def removed(scratch, apart):
    """Remove the folder for what is written at the end: who made it may have been killed.

    apart: whether this is such a place, in which the folder is a mount, and others in it lead to
    what is not ours to remove.
    """
    scratch, mnt_detach = Path(scratch), 2
    # By this it is found also where something was mounted over it.
    parent = os.open(scratch.parent, os.O_PATH | os.O_DIRECTORY)
    try:
        yield
    finally:
        if apart:
            mount = f"/proc/self/fd/{parent}/{scratch.name}"
            ctypes.CDLL(None).umount2(mount.encode(), mnt_detach)
            with contextlib.suppress(OSError):
                os.rmdir(scratch.name, dir_fd=parent)
        else:
            shutil.rmtree(scratch, ignore_errors=True)
