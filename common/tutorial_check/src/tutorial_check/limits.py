"""What a program may use."""

import contextlib
import os
import resource

MOST_PIDS = 1 << 22  # that Linux has
NOBODYS = 1_000_000  # from here on, as far again, users are nobody's
FEW_IDS = 4096  # of fewer any may be somebody's
MOST_THREADS = 400  # of a user of nobody's; of another one, beside those that he has anyway
# What a program may use. The address space is what Python's threads reserve, not what they use.
LIMITS = {
    resource.RLIMIT_AS: 6 << 30,
    resource.RLIMIT_FSIZE: 64 << 20,
    resource.RLIMIT_CPU: 60,
    resource.RLIMIT_CORE: 0,
    resource.RLIMIT_NOFILE: 1024,
}


def user(number, uid_map):
    """The id of a user of nobody's, by the number of an examination; None if there is none.

    uid_map: /proc/self/uid_map, as lines of first id, its id outside, count. Where somebody who is
    not root has made a container, few ids exist, and the lower half of them may be somebody's.
    """
    ranges = [[int(word) for word in line.split()] for line in uid_map.splitlines()]
    first, _, count = max(ranges, key=lambda each: each[2], default=(0, 0, 2 * NOBODYS))
    if first <= NOBODYS and first + count >= 2 * NOBODYS:
        return NOBODYS + number % NOBODYS
    return first + count // 2 + number % (count // 4) if count >= FEW_IDS else None


def of_programs(uid):
    """{limit: value} of programs that run as a user of nobody's, or as this process's (uid None)."""
    threads = _room_for(MOST_THREADS) if uid is None else MOST_THREADS
    return {resource.RLIMIT_NPROC: threads, **LIMITS}


def put(limits):
    """Have them hold for this process, for good; or those that hold already, where they are lower."""
    for what, wanted in limits.items():
        with contextlib.suppress(ValueError, OSError):
            hard = resource.getrlimit(what)[1]
            limit = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
            resource.setrlimit(what, (limit, limit))


def _room_for(threads):
    """RLIMIT_NPROC with which this process's user may have so many threads beside those of now.

    Not counted in /proc: from within a container a desktop around it cannot be seen, and counts. So
    it is tried out with which limit one more can be started, and doubled where none can.
    """
    limit, hard = threads, resource.getrlimit(resource.RLIMIT_NPROC)[1]
    highest = MOST_PIDS if hard == resource.RLIM_INFINITY else hard
    while limit < highest and not _can_fork(limit, hard):
        limit *= 2
    return limit + threads


def _can_fork(limit, hard):
    pid = os.fork()
    if pid == 0:
        try:
            resource.setrlimit(resource.RLIMIT_NPROC, (limit, hard))
            if os.fork() > 0:
                os.wait()
            os._exit(0)
        finally:
            os._exit(1)
    return os.waitpid(pid, 0)[1] == 0
