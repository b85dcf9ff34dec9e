"""Programs are ended for certain, also those that nobody waits for; the dead are no crowd."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tutorial_check import place
from tutorial_check.box import Box, _processes
from tutorial_check.forked import Helper

ENVIRONMENT = {"HOME": "/", "PATH": "/usr/bin:/bin"}


class Keeper:
    """A box in a process of its own, whose children are seen by themselves."""

    def __init__(self, uid):
        place.adopt_orphans()
        self._box = Box(ENVIRONMENT, uid)

    def children(self):
        """(name, state) of each child of this process."""
        ours = [(pid, state) for pid, state, parent, _ in _processes() if parent == os.getpid()]
        return [(Path(f"/proc/{pid}/comm").read_text().strip(), state) for pid, state in ours]

    def left(self, program, state, trusted):
        """Who is left of a script that left three programs alone, after these came to a state."""
        script = f"for each in 1 2 3; do ({program} &); done"
        self._box.start(["sh", "-c", script], trusted=trusted)
        child = program.split()[-2], state
        assert self._box.wait(lambda: self.children().count(child) == 3, 60.0), self.children()
        self._box.clear()
        return self.children()


@pytest.mark.parametrize(
    "what",
    [
        ("env true .", b"Z", False),
        ("setsid sleep 3600", b"S", False),
        ("setsid sleep 3600", b"S", True),  # as the nodes of a roslaunch of ours
        ("env -i setsid sleep 3600", b"S", True),  # with no variable that it was started with
    ],
)
def test_of_orphans_none_is_left(stranger, what):
    helper = Helper(lambda: Keeper(stranger), {})
    try:
        assert helper.call("left", *what) == []
    finally:
        helper.end()


CROWD = """
import sys
from tutorial_check import box
from tutorial_check.model import Wrong

box.MOST_PROCESSES = 5
one = box.Box({"HOME": "/", "PATH": "/usr/bin:/bin"}, alone=True)
one.start(["sh", "-c", f"for each in 1 2 3 4 5 6 7 8; do ({sys.argv[1]} &); done; exec sleep 3600"])
one.wait(lambda: one.patience.crowd() > 5, 60.0)
try:
    one.wait(lambda: one.patience.crowd() <= 5, 60.0)
    print("few")
except Wrong as wrong:
    print(wrong.seen)
one.clear()
"""


@pytest.mark.skipif(not place.granted().options, reason="no isolation: no crowd can be counted")
@pytest.mark.parametrize(("program", "seen"), [("true", "few"), ("sleep 3600", "it starts itself")])
def test_only_the_living_are_a_crowd(program, seen):
    all_of_it = ["--bind", "/", "/", "--proc", "/proc", "--dev", "/dev"]
    done = subprocess.run(
        [*place.granted().options, *all_of_it, sys.executable, "-c", CROWD, program],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        pass_fds=place.granted().descriptors,
    )
    assert done.stdout.startswith(seen), done


def test_a_programs_name_may_be_any_bytes(tmp_path):
    """Linux cuts it after 15 bytes, perhaps within a letter."""
    script = tmp_path / ("a" * 14 + "ü")
    script.write_text("#!/bin/sh\nread line\nexec sleep 3600\n")
    script.chmod(0o755)
    process = subprocess.Popen([str(script)], stdin=subprocess.PIPE)
    try:
        assert process.pid in {pid for pid, *_ in _processes()}
    finally:
        process.kill()
        process.wait()
