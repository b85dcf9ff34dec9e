"""What this process and a student's programs may do: users, rights, limits."""

from __future__ import annotations

import contextlib
import ctypes
import os
import resource
import subprocess
import tempfile
from pathlib import Path
from typing import Iterator

PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 1, 4, 36, 38
MOST_PIDS = 1 << 22  # that Linux has
UNUSED = 1_000_000  # from here on, and as many again, are uids that no system uses
FEW_IDS = 4096  # in a smaller range any uid may be in use
MOST_THREADS = 400  # an unused uid; another uid may have these in addition to its own
# The address space is what Python's threads reserve, not what they use.
LIMITS = {
    resource.RLIMIT_AS: 6 << 30,
    resource.RLIMIT_FSIZE: 64 << 20,
    resource.RLIMIT_CPU: 60,
    resource.RLIMIT_CORE: 0,
    resource.RLIMIT_NOFILE: 1024,
}


def folder_until_end(prefix: str) -> tuple[str, subprocess.Popen[bytes]]:
    """Return a new folder, and a process that removes it once its input is closed, as when we end."""
    folder = tempfile.mkdtemp(prefix=prefix)
    # Programs that end at the same time may still write.
    remove = 'read -r _; for try in 1 2 3 4 5; do rm -rf -- "$1" && break; sleep 1; done'
    words = ["sh", "-c", remove, "sh", folder]
    return folder, subprocess.Popen(words, stdin=subprocess.PIPE, start_new_session=True, env={})


def prctl(option: int, value: int, more: object = 0) -> int:
    """Make the system call of this name; return 0 if it succeeds."""
    return int(ctypes.CDLL(None).prctl(option, value, more, 0, 0))


def keep_to_itself() -> None:
    """Let no process of this user look into this one, or into its open files."""
    prctl(PR_SET_DUMPABLE, 0)


def give_up_rights() -> None:
    """Let this process, and what it starts, gain no rights, as by sudo. Its user may look into it."""
    prctl(PR_SET_NO_NEW_PRIVS, 1)
    prctl(PR_SET_DUMPABLE, 1)


def touch_files_as(user: int, group: int) -> None:
    """Let this process, as root, open and make files with no more rights than that user has.

    So a link that a program plants leads the checker nowhere that the program could not go itself.
    """
    libc = ctypes.CDLL(None)
    libc.setfsgid(group)
    before = libc.setfsuid(user)
    if libc.setfsuid(-1) != user:
        raise OSError(f"this system does not let root open files as user {user}")
    if before != user:
        keep_to_itself()  # which the change may have undone


def restore_rights() -> None:
    touch_files_as(os.geteuid(), os.getegid())


@contextlib.contextmanager
def own_rights() -> Iterator[None]:
    """Let this process open files as itself for a moment: only files that no student's program can change."""
    libc = ctypes.CDLL(None)
    user, group = libc.setfsuid(-1), libc.setfsgid(-1)
    restore_rights()
    try:
        yield
    finally:
        touch_files_as(user, group)


def unused_user(number: int, uid_map: Path = Path("/proc/self/uid_map")) -> int | None:
    """Return an unused uid for an examination, or None.

    uid_map: lines of first id, its id outside, count. In a container that an ordinary user made, few
    ids exist, and the lower half of them may be in use. Some kernels map no ids.
    """
    lines = uid_map.read_text().splitlines() if uid_map.exists() else []
    ranges = [[int(word) for word in line.split()] for line in lines]
    first, _, count = max(ranges, key=lambda each: each[2], default=(0, 0, 2 * UNUSED))
    if first <= UNUSED and first + count >= 2 * UNUSED:
        return UNUSED + number % UNUSED
    return first + count // 2 + number % (count // 4) if count >= FEW_IDS else None


def limits_of_programs(uid: int | None) -> dict[int, int]:
    """Return the limits of programs that run under an unused uid, or under this process's (None)."""
    threads = MOST_THREADS if uid is not None else _threads_of_this_user() + MOST_THREADS
    return {resource.RLIMIT_NPROC: threads, **LIMITS}


def limit(limits: dict[int, int]) -> None:
    """Set these limits for this process, or keep those that are lower."""
    for what, wanted in limits.items():
        with contextlib.suppress(ValueError, OSError):
            hard = resource.getrlimit(what)[1]
            value = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
            resource.setrlimit(what, (value, value))


def _threads_of_this_user() -> int:
    """Return an upper bound, also of threads outside of a container: /proc hides them, RLIMIT_NPROC counts them."""
    threads, starts_one_more = MOST_THREADS, ["sh", "-c", "(:); :"]
    while threads < MOST_PIDS:
        tried = ["prlimit", f"--nproc={threads}", *starts_one_more]
        if not subprocess.run(tried, check=False, stderr=subprocess.DEVNULL).returncode:
            break
        threads *= 2
    return threads
