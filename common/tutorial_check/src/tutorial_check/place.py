"""Isolation: bubblewrap shows a student's program its own copy and no other file of anybody.

Network: loopback only. Processes, System V shared memory: its own, which end with the check. Files:
the system and what students use of this suite, read-only; an empty /tmp, /var/tmp and /dev/shm of
limited size; no /run. Nothing there has a capability but the checker itself, where it is root.
"""

import contextlib
import ctypes
import functools
import os
import shutil
import signal
import socket
import subprocess
from dataclasses import dataclass
from pathlib import Path

SCRATCH_MB = 600  # for the copy, its build, logs and what the programs write
# Of /etc not all: root, as whom the checker may read what a program left it a link to, may read more.
ETC = "alternatives catkin group host.conf hosts ld.so.cache localtime nsswitch.conf passwd python3 ros"
SYSTEM = (
    *("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/opt/ros"),
    *(f"/etc/{name}" for name in ETC.split()),
)
SHARED_PAGES = 1 << 16  # of System V shared memory: 256 MB
NAMESPACES = ("--unshare-ipc", "--unshare-net", "--unshare-pid", "--unshare-uts")
# What the checker needs as root: to run programs as another user, and to end them.
RIGHTS = ("CHOWN", "DAC_OVERRIDE", "FOWNER", "KILL", "SETGID", "SETUID")
CLONE_NEWUSER = 0x10000000
PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 1, 4, 36, 38


@dataclass(frozen=True)
class Isolation:
    """How bubblewrap isolates on this system."""

    options: tuple = ()  # words of its command; none without isolation
    is_limited: bool = True  # whether sizes are, and no program makes user namespaces of its own
    has_sizes: bool = True  # whether it knows --size
    why: str = ""  # it does not work
    descriptors: tuple = ()  # that it inherits


@functools.lru_cache(maxsize=None)
def granted() -> Isolation:
    """Return what this system grants; without options where it grants no isolation."""
    bwrap = shutil.which("bwrap")
    if not bwrap:
        return Isolation(why="bubblewrap is not installed")
    options = [bwrap, *NAMESPACES, "--as-pid-1"]
    # Before bubblewrap 0.8 there is no --disable-userns, which root is refused, and before 0.7 no --size.
    users, descriptors = ["--unshare-user"], ()
    closed_users = [*users, "--disable-userns"]
    if os.geteuid() == 0:
        users = ["--cap-drop", "ALL"]
        users += [word for right in RIGHTS for word in ("--cap-add", f"CAP_{right}")]
        closed_users = users
        with contextlib.suppress(OSError):
            descriptors = (_closed_user_namespace(),)
            closed_users = ["--userns", str(descriptors[0]), *users]
    is_closed = closed_users != users
    variants = ((closed_users, True), (users, True), (users, False))
    for more, has_sizes in variants if is_closed else variants[1:]:
        command = [*options, *more, "--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev"]
        why = _fault([*command, *_tmpfs("/tmp", 1, has_sizes), "true"], descriptors)
        if not why:
            is_limited = has_sizes and more is closed_users
            return Isolation((*options, *more), is_limited, has_sizes, "", descriptors)
    return Isolation(why=why)


def _closed_user_namespace() -> int:
    """Return a descriptor of a user namespace with root's users, in which nobody can make another one.

    A program in a user namespace of its own could mount a tmpfs of any size. Raises OSError.
    """
    ours, theirs = socket.socketpair()
    child = os.fork()
    if child == 0:
        with contextlib.suppress(BaseException):
            if ctypes.CDLL(None).unshare(CLONE_NEWUSER) == 0:
                theirs.send(b"made")
                ours.close()
                theirs.recv(1)
                Path("/proc/sys/user/max_user_namespaces").write_text("0")
                theirs.send(b"closed")
                theirs.recv(1)
        os._exit(0)
    theirs.close()
    try:
        if not ours.recv(9):
            raise OSError("no user namespace can be made")
        for name in ("uid_map", "gid_map"):
            ranges = [line.split() for line in Path("/proc/self", name).read_text().splitlines()]
            lines = [f"{first} {first} {count}\n" for first, _, count in ranges]
            Path(f"/proc/{child}", name).write_text("".join(lines))
        ours.send(b"x")
        if not ours.recv(9):
            raise OSError("the user namespace cannot be closed")
        return os.open(f"/proc/{child}/ns/user", os.O_RDONLY)
    finally:
        ours.close()
        os.waitpid(child, 0)


def _fault(command, descriptors):
    """Return why a command fails; empty if it does not."""
    try:
        tried = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            check=False,
            timeout=60,
            pass_fds=descriptors,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    said = tried.stderr.decode(errors="replace").split()
    return " ".join(said) or f"{command[0]} fails" if tried.returncode else ""


def lacking() -> list:
    """Return what this system does not provide, a line for each thing, to be printed before a verdict."""
    isolation = granted()
    if isolation.options:
        line = "with this bubblewrap or kernel the memory that a program fills with files is not limited"
        return [] if isolation.is_limited else [line]
    if os.geteuid() == 0:
        rights = "runs as another user, but can read what everybody may, use the network"
    else:
        rights = "has your rights: it can read, change and remove your files, use the network"
    why = isolation.why
    return [f"no isolation here ({why}): a program {rights}, and leave files in /var/tmp"]


def _tmpfs(path, megabytes, limits, mode="0755"):
    return [*(("--size", str(megabytes << 20)) if limits else ()), "--perms", mode, "--tmpfs", path]


def command(folder, shown, hidden):
    """The command that starts another one apart; empty if the system grants no isolation.

    folder: where the programs write, empty at first; shown: files and folders to see, read-only;
    hidden: a folder that is not shown, though it may lie in one that is.
    """
    isolation = granted()
    if not isolation.options:
        return []
    limits = isolation.has_sizes
    mounts = {
        "/proc": ["--proc", "/proc"],
        "/dev": ["--dev", "/dev"],
        "/dev/shm": _tmpfs("/dev/shm", 64, limits, "1777"),
        "/dev/input": _tmpfs("/dev/input", 1, limits),  # for a joystick
        "/tmp": _tmpfs("/tmp", 64, limits, "1777"),
        "/var/tmp": _tmpfs("/var/tmp", 64, limits, "1777"),
        str(hidden): _tmpfs(str(hidden), 1, limits),
        str(folder): _tmpfs(str(folder), SCRATCH_MB, limits),
    }
    for path in SYSTEM:
        if os.path.islink(path):
            mounts[path] = ["--symlink", os.readlink(path), path]
        elif os.path.exists(path):
            mounts[path] = ["--ro-bind", path, path]
    shown = {str(path) for path in shown if os.path.exists(path)}
    real = set(map(os.path.realpath, shown))
    mounts.update({path: ["--ro-bind", path, path] for path in real})
    for path in shown - real:  # catkin may have written down the name of a link
        if not real & set(map(str, Path(path).parents)):
            mounts[path] = ["--ro-bind", path, path]
    for above in {above for path in mounts for above in Path(path).parents}:  # bwrap closes its own
        mounts.setdefault(str(above), ["--perms", "0755", "--dir", str(above)])
    outer_first = sorted(mounts, key=lambda path: len(Path(path).parts))
    words = [word for path in outer_first for word in mounts[path]]
    for path in ("/dev", str(hidden), "/"):
        words += ["--remount-ro", path]
    return [*isolation.options, *words, "--"]


def _set(option, value):
    ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def keep_to_itself():
    """Let no process of this user look into this one, or into its open files."""
    _set(PR_SET_DUMPABLE, 0)


def give_up_rights():
    """Have this process, and what it starts, gain no rights by any program, as sudo. Its user may look in."""
    _set(PR_SET_NO_NEW_PRIVS, 1)
    _set(PR_SET_DUMPABLE, 1)


def touch_files_as(user, group):
    """Have this process, as root, open and make files with no more rights than that user has.

    So a link that a program plants leads the checker nowhere that the program could not go itself.
    """
    libc = ctypes.CDLL(None)
    libc.setfsgid(group)
    before = libc.setfsuid(user)
    if libc.setfsuid(-1) != user:
        raise OSError(f"this system does not let root open files as user {user}")
    if before != user:
        keep_to_itself()  # which the change may have undone


@contextlib.contextmanager
def own_rights():
    """Have this process open files as itself for once: only what no student's program can change."""
    libc = ctypes.CDLL(None)
    user, group = libc.setfsuid(-1), libc.setfsgid(-1)
    touch_files_as(os.geteuid(), os.getegid())
    try:
        yield
    finally:
        touch_files_as(user, group)


def restore_rights():
    """Have this process open files as itself again."""
    touch_files_as(os.geteuid(), os.getegid())


def end_with_parent():
    """Have the kernel end this process when the one that started it ends."""
    _set(PR_SET_PDEATHSIG, signal.SIGKILL)


def adopt_orphans():
    """Have what is started below this process, and left by its parent, be a child of this one."""
    _set(PR_SET_CHILD_SUBREAPER, 1)


def limit_shared_memory():
    """Limit System V's shared memory of these namespaces, where the kernel lets this process."""
    with contextlib.suppress(OSError):
        Path("/proc/sys/kernel/shmall").write_text(str(SHARED_PAGES))
