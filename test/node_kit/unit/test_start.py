"""The line of a node that cannot start, and a callback during its shutdown."""

import contextlib

import pytest

from node_kit.ros.lifecycle import start
from node_kit.ros.lifecycle.start import remedy
from tutorial_testing.claims import claim


@claim("Every mistake in ...", because="one that an earlier launch left")
@pytest.mark.parametrize(("error", "stored", "line"), [
    ("~rate: 'abc': must be a number", {"rate"}, "rosparam delete /joy_node/rate"),
    ("~dve: '/x': no such parameter", {"dve", "rate"}, "rosparam delete /joy_node/dve"),
    ("~rate: 'abc': must be a number", {"dev"}, ""),  # given on the command line
    ("a file is missing", {"rate"}, ""),
])  # fmt: skip
def test_a_parameter_that_an_earlier_launch_has_left_is_named(error, stored, line):
    words = remedy(ValueError(error), "/joy_node", stored)
    assert words.endswith(line) and bool(words) is bool(line)


@pytest.mark.parametrize("ends", [True, False])
def test_a_callback_whose_topic_is_closed_is_an_error_but_at_the_end(monkeypatch, ends):
    monkeypatch.setattr(start, "is_ending", lambda: ends)

    @start.as_callback
    def publish():
        raise start.rospy.ROSException

    with contextlib.nullcontext() if ends else pytest.raises(start.rospy.ROSException):
        publish()
