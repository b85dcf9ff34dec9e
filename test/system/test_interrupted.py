"""./tutorial test that is ended: all of it ends; what had failed is known, if that is clear."""

import os
import re
import shutil
import signal

import pytest

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

# In place of the tests. Each says that it has begun, and lasts until it is ended.
LASTING = """
import signal
from pathlib import Path

def test_it():
    Path(__file__).with_name("begun").touch()
    signal.pause()
"""
LASTING_ROSTEST = """#!/bin/sh
touch "${0%/*}/ros/begun"
exec tail -f /dev/null
"""


@pytest.fixture
def tests(clone, own_workspace, tmp_path):
    """The folder test of a copy of this suite, with one lasting test of each kind."""
    copy = tmp_path / "copy"
    shutil.copytree(clone, copy, symlinks=True)
    for kind in ("unit", "system"):
        shutil.rmtree(copy / "test" / kind)
        (copy / "test" / kind).mkdir()
        (copy / "test" / kind / "test_it.py").write_text(LASTING)
    (copy / "test" / "run_rostests").write_text(LASTING_ROSTEST)
    return copy / "test"


@pytest.mark.parametrize(("words", "kind"), [([], "unit"), (["system"], "system")])
def test_ctrl_c_in_pytest_ends_all(tests, own_workspace, words, kind):
    with Program(str(tests.parent / "tutorial"), "test", *words) as program:
        wait_for((tests / kind / "begun").exists, "test")
        program.interrupt()
        assert program.wait() == 130
        assert program.output.endswith("tutorial: test: interrupted\n")
        assert "tests: ros" not in program.output
    assert not (own_workspace / "failed").exists()


def test_a_terminal_that_is_closed_ends_all(tests, own_workspace):
    (tests / "unit" / "test_it.py").write_text("def test_it():\n    pass\n")
    with Program(str(tests.parent / "tutorial"), "test") as program:
        for kind in ("system", "ros"):
            wait_for((tests / kind / "begun").exists, f"test of {kind}")
        os.killpg(program.pid, signal.SIGHUP)
        assert program.wait() == 130
        assert program.left_behind() == []
    assert not (own_workspace / "failed").exists()


FAILS = """
from pathlib import Path

MENDED = Path(__file__).with_name("mended")

def test_it():
    assert MENDED.exists()

def test_another():
    pass
"""


@pytest.mark.usefixtures("own_workspace")
def test_again_runs_what_failed_and_no_more(tests):
    (tests / "system" / "test_it.py").write_text(FAILS)
    command = str(tests.parent / "tutorial"), "test"
    with Program(*command, "system") as program:
        assert program.wait() == 1
        next_line = "tutorial: next, for ros and system: ./tutorial test again\n"
        assert program.output.endswith(f"{next_line}tutorial: failed: system\n")
    (tests / "system" / "mended").touch()
    with Program(*command, "again") as again:
        assert again.wait() == 0, again.output
        assert re.search(r"= 1 passed\b(?!, \d)", again.output)
