"""What a program may use."""

import contextlib
import os
import resource

MOST_PIDS = 1 << 22  # that Linux has
MOST_THREADS = 400  # of a user of nobody's; of another one, beside those that he has anyway
# What a program may use. The address space is what Python's threads reserve, not what they use.
LIMITS = {
    resource.RLIMIT_AS: 6 << 30,
    resource.RLIMIT_FSIZE: 64 << 20,
    resource.RLIMIT_CPU: 60,
    resource.RLIMIT_CORE: 0,
    resource.RLIMIT_NOFILE: 1024,
}


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
