"""A child process that reads a damaged or malicious file."""

import os
import resource
import signal
import sys
import tempfile
import traceback

# Processor time [s], four times what the slowest file needs; memory beyond the test's own.
MOST_S, MOST_MORE_KB = 20.0, 130_000


def end_of(main):
    """Run main in a child; its exit code is 0, or 1 with one line on stderr."""
    with tempfile.TemporaryFile("w+") as said:
        child = os.fork()
        if not child:
            _be(main, said.fileno())
        _, status = os.waitpid(child, 0)
        said.seek(0)
        text = said.read()
    assert not os.WIFSIGNALED(status), signal.strsignal(os.WTERMSIG(status))
    code, lines = os.WEXITSTATUS(status), text.splitlines()
    # rosbag itself may warn about what it can still read.
    assert code == 0 or (code, len(lines)) == (1, 1), f"{code}: {text[-2000:]}"


def _be(main, said):
    """Run main as the child, and exit in any case."""
    code, before_kb = 70, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    try:
        os.dup2(said, 2)
        resource.setrlimit(resource.RLIMIT_CPU, (int(MOST_S), int(MOST_S) + 1))
        sys.stderr = open(2, "w", closefd=False)  # noqa: SIM115
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115
        code = main()
        more_kb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before_kb
        assert more_kb <= MOST_MORE_KB, f"{more_kb} kB\n{code}"
    except BaseException:
        code = 70
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)
