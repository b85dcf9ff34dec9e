"""A child process that reads a file that someone damaged, or made to do harm."""

import os
import resource
import signal
import sys
import tempfile
import traceback

MOST_S, MOST_MB = 5.0, 200.0  # [s of processor time], [MB with Python and ROS]
BARE_MB = 70.0  # what they need before a file is read


def end_of(main):
    """Run main in a child; its exit code is 0, or 1 with one line on stderr. Return that."""
    with tempfile.TemporaryFile("w+") as said:
        with open("/proc/self/statm", encoding="ascii") as file:
            before_mb = int(file.read().split()[1]) * resource.getpagesize() / 1e6
        child = os.fork()
        if not child:
            _be(main, said.fileno())
        _, status, used = os.wait4(child, 0)
        said.seek(0)
        text = said.read()
    assert not os.WIFSIGNALED(status), signal.strsignal(os.WTERMSIG(status))
    code, lines = os.WEXITSTATUS(status), text.splitlines()
    # rosbag itself may warn about what it can still read.
    assert code == 0 or (code, len(lines)) == (1, 1), f"{code}: {text[-2000:]}"
    spent_mb = BARE_MB + max(0.0, used.ru_maxrss * 1024 / 1e6 - before_mb)
    assert spent_mb <= MOST_MB, f"{spent_mb} MB: {text}"
    return text


def _be(main, said):
    """Be the child: run main and exit, whatever comes."""
    code = 70
    try:
        os.dup2(said, 2)
        resource.setrlimit(resource.RLIMIT_CPU, (int(MOST_S), int(MOST_S) + 1))
        sys.stderr = open(2, "w", closefd=False)  # noqa: SIM115
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115
        code = main()
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)
