"""Errors in catkin_make's output that no stored row shows."""

import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from tutorial_check.checking.build_errors import build_error

SESSION = SimpleNamespace(packages=[], source=Path("/ws/src"), is_own=lambda path: "/ws/" in path)


def test_an_error_in_a_header_of_the_system_is_blamed_on_the_line_that_includes_it():
    output = """\
In file included from /ws/src/mine/src/use.cpp:3:
/usr/include/ros/param.h:7:1: error: no match
"""
    assert build_error(SESSION, output).where == "mine/src/use.cpp:3"
    assert build_error(SESSION, output.replace("/ws", "/a")).where == "/usr/include/ros/param.h:7"


@pytest.mark.parametrize("text", ["/a", "*** [/CMakeFiles/a.dir", "undefined reference to ", "a"])
def test_an_output_of_any_text_is_read_at_once(text):
    began_s = time.process_time()
    build_error(SESSION, f"{text * 199_999}\n/a.c:1:1: error: no")
    assert time.process_time() - began_s < 20.0
