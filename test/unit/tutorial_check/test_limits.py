"""Limits of programs: beside what their user runs anyway, which may be much."""

import os
import sys
import threading

import pytest

from tutorial_check.box import Box
from tutorial_check.forked import Helper
from tutorial_check.limits import MOST_THREADS

NOBODYS = 1_999_999  # a user who has no processes yet


class BusyUser:
    """Somebody who is not root and has more threads than a program of the check may have."""

    def __init__(self):
        if os.geteuid() == 0:
            os.setgroups([])
            os.setgid(NOBODYS)
            os.setuid(NOBODYS)
        for _ in range(MOST_THREADS + 50):
            threading.Thread(target=threading.Event().wait, daemon=True).start()

    def run(self, text):
        """What a program prints, as a program of a student's."""
        box = Box({"HOME": "/"})
        program = box.start([sys.executable, "-c", text])
        box.wait(lambda: program.ended, 60.0)
        box.end(program)
        return program.output


@pytest.fixture
def user():
    helper = Helper(BusyUser, {})
    yield helper
    helper.end()


def test_a_program_of_one_with_many_threads_may_have_threads(user):
    text = "import threading; threading.Thread(target=print, args=['here']).start()"
    assert user.call("run", text) == "here\n"


def test_and_not_without_end(user):
    text = (
        "import threading\n"
        "threading.stack_size(1 << 16)\n"  # so that memory is no limit
        "for count in range(100_000):\n"
        "    try:\n"
        "        threading.Thread(target=threading.Event().wait, daemon=True).start()\n"
        "    except RuntimeError:\n"
        "        break\n"
        "print(count)\n"
    )
    assert MOST_THREADS <= int(user.call("run", text)) < 4 * MOST_THREADS
