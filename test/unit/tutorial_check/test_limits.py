"""Limits of programs: beside what their user runs anyway, which may be much."""

import os
import sys
import threading

import pytest

from tutorial_check.box import Box
from tutorial_check.forked import Helper
from tutorial_check.limits import MOST_THREADS, user

NOBODYS = 2_000_000 + os.getpid()  # a user who has no processes yet, whatever runs beside this


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
def busy():
    helper = Helper(BusyUser, {})
    yield helper
    helper.end()


def test_a_program_of_one_with_many_threads_may_have_threads(busy):
    text = "import threading; threading.Thread(target=print, args=['here']).start()"
    assert busy.call("run", text) == "here\n"


def test_and_not_without_end(busy):
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
    assert MOST_THREADS <= int(busy.call("run", text)) < 4 * MOST_THREADS


@pytest.mark.parametrize(
    ("uid_map", "lowest", "highest"),
    [
        ("         0          0 4294967295\n", 1_000_000, 1_999_999),  # a machine, or plain docker
        ("", 1_000_000, 1_999_999),  # a kernel that maps no ids
        ("0 1000 1\n1 100000 65536\n", 32_768, 65_533),  # podman of somebody who is not root
        ("0 231072 65536\n", 32_768, 65_533),  # docker's userns-remap
    ],
)
def test_a_user_of_nobodys_is_one_that_exists(uid_map, lowest, highest):
    users = [user(number, uid_map) for number in (*range(20), 7_919, 65_537, 419_430_400)]
    assert lowest <= min(users) and max(users) <= highest
    assert len(set(users)) > 20


@pytest.mark.parametrize("uid_map", ["0 1000 1\n", "0 1000 1\n1000 1000 1\n"])
def test_where_only_root_is_mapped_there_is_none(uid_map):
    """As in a place apart of somebody who is not root."""
    assert user(1, uid_map) is None
