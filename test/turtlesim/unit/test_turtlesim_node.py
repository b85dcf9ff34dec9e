"""The background's parameters are read as roscpp reads whole numbers; a node without a screen."""

import math
import sys
from unittest import mock

import pytest
import rospy

from simulated_turtles.ros import turtlesim_node
from tutorial_testing.claims import claim


@claim("turtlesim's background is read as roscpp reads whole numbers")
@pytest.mark.parametrize(
    ("value", "red"),
    [(150, 150), (10.7, 11), (10.5, 11), (10.4, 10), (-0.2, 255), (300, 44), (True, 69),
     ("150", 69), (None, 69), (math.nan, 0), (1e10, 0)],
)  # fmt: skip
def test_numbers_are_rounded_and_the_rest_is_the_default(value, red):
    given = {"~background_r": value}
    with mock.patch.object(rospy, "get_param", given.get):
        assert turtlesim_node.background() == (red, 86, 255)


@claim("Without tkinter or a screen turtlesim runs without a window")
@pytest.mark.parametrize(("display", "lines"), [("", 0), (":no", 1)])
@pytest.mark.parametrize("hidden", [{}, {"tkinter": None}])
def test_no_screen_no_window(monkeypatch, display, lines, hidden):
    monkeypatch.setenv("DISPLAY", display)
    with mock.patch.dict(sys.modules, hidden), mock.patch.object(rospy, "logwarn") as warned:
        assert turtlesim_node.open_window() == (None, None)
    assert warned.call_count == lines
