"""Users, rights and limits of this process and of a student's programs."""

from __future__ import annotations

import contextlib
import ctypes
import os
import resource
import shlex
import subprocess
import tempfile
from pathlib import Path
from typing import Mapping

PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 1, 4, 36, 38
MOST_PIDS = 1 << 22  # of Linux
UNUSED = 1_000_000  # the first of a million uids that no system uses
FEW_IDS = 4096  # in a smaller range any uid may be in use
MOST_THREADS = 400  # of a user, in addition to those that run
# Python's threads reserve much more address space than they use.
LIMITS = {
    resource.RLIMIT_AS: 6 << 30,
    resource.RLIMIT_FSIZE: 64 << 20,
    resource.RLIMIT_CPU: 60,
    resource.RLIMIT_CORE: 0,
    resource.RLIMIT_NOFILE: 1024,
}
# Of each process of a build, in addition: a compiler of ROS programs needs less than 1 GB.
OF_BUILD = {resource.RLIMIT_AS: 2 << 30}
# For the process that reads the submission. All nine exercises take 3 s and 80 MB.
MOST_CPU_S, MOST_MB = 20, 450
OF_READER = {resource.RLIMIT_CPU: MOST_CPU_S, resource.RLIMIT_DATA: MOST_MB << 20}


def folder_until_end(prefix: str, user: int | None = None) -> tuple[str, subprocess.Popen[bytes]]:
    """Return a new folder, and a process that removes it when its input closes, or we end.

    user: another user, whose processes it ends first.
    """
    folder = tempfile.mkdtemp(prefix=prefix)
    end = shlex.join([*as_user(user), "sh", "-c", "kill -KILL -1"]) if user is not None else ":"
    # Programs that are ending may still write.
    remove = f'read -r _; {end}; for n in 1 2 3 4 5; do rm -rf -- "$1" && break; sleep 1; done'
    words = ["sh", "-c", remove, "sh", folder]
    return folder, subprocess.Popen(words, stdin=subprocess.PIPE, start_new_session=True, env={})


def prctl(option: int, value: int, more: object = 0) -> int:
    """Make the system call prctl; return 0 if it succeeds."""
    return int(ctypes.CDLL(None).prctl(option, value, more, 0, 0))


def keep_to_itself() -> None:
    """Hide this process's memory and open files from the user's other processes."""
    prctl(PR_SET_DUMPABLE, 0)


def give_up_rights() -> None:
    """Prevent this process and its children from gaining rights, as by sudo; unhide it."""
    prctl(PR_SET_NO_NEW_PRIVS, 1)
    prctl(PR_SET_DUMPABLE, 1)


def as_user(user: int | None) -> list[str]:
    """Return the words before a command that run it as a user who cannot gain rights."""
    if user is None:
        return []
    return ["setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "--no-new-privs"]


def open_to(user: int, folder: str) -> None:
    """Let a user read a folder that root owns, and add to it, but change nothing in it."""
    for path in Path(folder).rglob("*"):
        path.chmod(path.stat().st_mode | (0o555 if path.is_dir() else 0o444))
    os.chown(folder, 0, user)
    os.chmod(folder, 0o1770)


def unused_user(number: int, uid_map: Path = Path("/proc/self/uid_map")) -> int | None:
    """Return an unused uid for an examination, or None.

    uid_map: lines of first id, its id outside, count. A container made by an ordinary user has few
    ids, and the lower half of them may be in use. Some kernels map no ids.
    """
    lines = uid_map.read_text().splitlines() if uid_map.exists() else []
    ranges = [tuple(map(int, line.split())) for line in lines]
    count, first = max(((count, first) for first, _, count in ranges), default=(2 * UNUSED, 0))
    if first <= UNUSED and first + count >= 2 * UNUSED:
        return UNUSED + number % UNUSED
    return first + count // 2 + number % (count // 4) if count >= FEW_IDS else None


def limit(limits: Mapping[int, int]) -> None:
    """Set these limits for this process; keep lower ones."""
    for what, wanted in limits.items():
        with contextlib.suppress(ValueError, OSError):
            hard = resource.getrlimit(what)[1]
            value = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
            resource.setrlimit(what, (value, value))


def limit_reader() -> None:
    """Limit the CPU time and memory of this process, which reads a submission."""
    for what, most in OF_READER.items():
        hard = resource.getrlimit(what)[1]
        resource.setrlimit(what, (most if hard < 0 else min(most, hard), hard))


def unlimited() -> list[str]:
    """Return the words before a command that run it without limit_reader()'s limits."""
    hard = (resource.getrlimit(what)[1] for what in OF_READER)
    cpu, data = ("unlimited" if most < 0 else str(most) for most in hard)
    return ["prlimit", f"--cpu={cpu}:", f"--data={data}:"]


def limits_of_programs() -> dict[int, int]:
    """Return the limits of programs that run as this user. RLIMIT_NPROC also counts threads outside
    of a container, which /proc hides, so try how many may be started.
    """
    threads, starts_one_more = MOST_THREADS, ["sh", "-c", "(:); :"]
    while threads < MOST_PIDS:
        tried = ["prlimit", f"--nproc={threads}", *starts_one_more]
        if not subprocess.run(tried, check=False, stderr=subprocess.DEVNULL).returncode:
            break
        threads *= 2
    return {resource.RLIMIT_NPROC: threads + MOST_THREADS, **LIMITS}
