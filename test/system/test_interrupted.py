"""./tutorial test that is ended: all of it ends, and nothing is written down as failed."""

import os
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
    yield copy / "test"
    assert not (own_workspace / "failed").exists()


@pytest.mark.parametrize(
    ("words", "kind"), [([], "unit"), (["unit"], "unit"), (["system"], "system")]
)
def test_ctrl_c_in_pytest_ends_all(tests, words, kind):
    with Program(str(tests.parent / "tutorial"), "test", *words) as program:
        wait_for((tests / kind / "begun").exists, "test")
        program.interrupt()
        assert program.wait() == 130
        assert program.output.endswith("tutorial: test: interrupted\n")
        assert "tests: ros" not in program.output


def test_a_terminal_that_is_closed_ends_all(tests):
    (tests / "unit" / "test_it.py").write_text("def test_it():\n    pass\n")
    with Program(str(tests.parent / "tutorial"), "test") as program:
        for kind in ("system", "ros"):
            wait_for((tests / kind / "begun").exists, f"test of {kind}")
        os.killpg(program.pid, signal.SIGHUP)
        assert program.wait() == 130
        assert program.left_behind() == []
