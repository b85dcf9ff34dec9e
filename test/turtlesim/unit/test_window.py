"""A node without tkinter, or without its screen, goes on after one line."""

import sys
from unittest import mock

import pytest
import rospy

from simulated_turtles.ros import turtlesim_node
from tutorial_testing.claims import claim


@claim("Without tkinter or a screen turtlesim runs without a window")
@pytest.mark.parametrize(("display", "lines"), [("", 0), (":no", 1)])
@pytest.mark.parametrize("hidden", [{}, {"tkinter": None}])
def test_no_screen_no_window(monkeypatch, display, lines, hidden):
    monkeypatch.setenv("DISPLAY", display)
    with mock.patch.dict(sys.modules, hidden), mock.patch.object(rospy, "logwarn") as warned:
        assert turtlesim_node.open_window() == (None, None)
    assert warned.call_count == lines
