"""Users, rights and limits of programs, and how surely they end."""

import contextlib
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check import box, place
from tutorial_check.box import Box, processes
from tutorial_check.forked import Helper
from tutorial_check.place import MOST_THREADS, unused_user

ENVIRONMENT = {"HOME": "/", "PATH": "/usr/bin:/bin"}
LOOK = """
import os
status = dict(line.split(":") for line in open("/proc/self/status"))
print(status["NoNewPrivs"], status["CapEff"])
try:
    os.listdir(f"/proc/{os.getppid()}/fd")
except PermissionError:
    print("closed")
"""
COUNT = """
import threading
threading.stack_size(1 << 16)  # so that memory is no limit
for count in range(100_000):
    try:
        threading.Thread(target=threading.Event().wait, daemon=True).start()
    except RuntimeError:
        break
print(count)
"""


class Keeper:
    """A box in a process of its own; first of all that process has so many threads."""

    def __init__(self, uid, threads=0, own_uid=None):
        if own_uid is not None:
            os.setgroups([])
            os.setgid(own_uid)
            os.setuid(own_uid)
        for _ in range(threads):
            threading.Thread(target=threading.Event().wait, daemon=True).start()
        place.keep_to_itself()
        place.prctl(place.PR_SET_CHILD_SUBREAPER, 1)
        self._box = Box(ENVIRONMENT, uid)

    def run(self, *words):
        """Return what a program prints."""
        program = self._box.start(words)
        self._box.wait(lambda: program.ended, 60.0)
        self._box.end(program)
        return program.output

    def children(self):
        """Return (name, state) of each child of this process."""
        ours = [(pid, state) for pid, state, parent, _ in processes() if parent == os.getpid()]
        return [(Path(f"/proc/{pid}/comm").read_text().strip(), state) for pid, state in ours]

    def left(self, program, state, trusted):
        """Return what is left of a script that leaves three programs, once these are in a state."""
        script = f"for each in 1 2 3; do ({program} &); done"
        self._box.start(["sh", "-c", script], trusted=trusted)
        child = program.split()[-2], state
        assert self._box.wait(lambda: self.children().count(child) == 3, 60.0), self.children()
        self._box.clear()
        return self.children()


@pytest.fixture
def keep():
    """keep(uid, ...): a Helper with a Keeper."""
    with contextlib.ExitStack() as stack:

        def make(*words):
            helper = Helper(lambda: Keeper(*words), {})
            stack.callback(helper.end)
            return helper

        yield make


@pytest.mark.parametrize(
    "what",
    [
        ("env true .", b"Z", False),
        ("setsid sleep 3600", b"S", False),
        ("setsid sleep 3600", b"S", True),  # as the nodes of a roslaunch of ours
        ("env -i setsid sleep 3600", b"S", True),  # with no variable that it was started with
    ],
)
def test_no_orphan_is_left(keep, stranger, what):
    assert keep(stranger).call("left", *what) == []


def test_a_program_neither_reaches_the_result_nor_gains_rights(keep, stranger):
    printed = keep(stranger).call("run", sys.executable, "-c", LOOK)
    assert printed.split() == ["1", "0" * 16, "closed"]


def test_a_user_with_many_threads_may_have_more_but_not_without_end(keep, stranger):
    busy = keep(None, MOST_THREADS + 50, stranger)
    count = int(busy.call("run", sys.executable, "-c", COUNT))
    assert MOST_THREADS <= count < 4 * MOST_THREADS


@pytest.mark.parametrize(
    ("uid_map", "lowest", "highest"),
    [
        ("         0          0 4294967295\n", 1_000_000, 1_999_999),  # a machine, or plain docker
        ("", 1_000_000, 1_999_999),  # a kernel that maps no ids
        ("0 1000 1\n1 100000 65536\n", 32_768, 65_533),  # podman of an ordinary user
        ("0 231072 65536\n", 32_768, 65_533),  # docker's userns-remap
    ],
)
def test_an_unused_uid_is_one_that_exists(tmp_path, uid_map, lowest, highest):
    file = tmp_path / "uid_map"
    file.write_text(uid_map)
    users = [unused_user(number, file) for number in (*range(20), 7_919, 65_537, 419_430_400)]
    assert lowest <= min(users) and max(users) <= highest
    assert len(set(users)) > 20
    file.write_text("0 1000 1\n1000 1000 1\n")
    assert unused_user(1, file) is None


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can read as another user")
def test_root_opens_files_with_the_rights_of_the_programs_user(tmp_path, stranger):
    secret = tmp_path / "secret"
    secret.write_text("x")
    secret.chmod(0o600)
    place.touch_files_as(stranger, stranger)
    try:
        with pytest.raises(PermissionError):
            secret.read_text()
        with place.own_rights():
            assert secret.read_text() == "x"
        with pytest.raises(PermissionError):
            secret.read_text()
    finally:
        place.restore_rights()
    assert secret.read_text() == "x"


def test_a_programs_name_may_be_any_bytes(tmp_path):
    """Linux cuts it after 15 bytes, perhaps within a letter."""
    script = tmp_path / ("a" * 14 + "ü")
    script.write_text("#!/bin/sh\nread line\nexec sleep 3600\n")
    script.chmod(0o755)
    with subprocess.Popen([str(script)], stdin=subprocess.PIPE) as process:
        try:
            assert process.pid in {pid for pid, *_ in processes()}
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("least_s", "code", "spins"),
    [(0.0, None, True), (3600.0, None, False), (0.0, 0, False)],  # the last ended by itself
)
def test_when_a_program_works_without_end(monkeypatch, least_s, code, spins):
    monkeypatch.setattr(box, "SPINNING_S", time.process_time() / 2 + least_s)
    program = box.Program(SimpleNamespace(pid=os.getpid(), poll=lambda: code), "this one")
    assert not program.spins
    program.stop(0)
    assert program.spins == spins
