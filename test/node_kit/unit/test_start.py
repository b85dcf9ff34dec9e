"""The line of a node that cannot start."""

import pytest

from node_kit.ros.lifecycle.start import remedy
from tutorial_testing.claims import claim


@claim("Every mistake in ...", because="one that an earlier launch left")
@pytest.mark.parametrize(
    ("error", "stored", "line"),
    [
        ("~rate: 'abc': must be a number", {"rate"}, "rosparam delete /joy_node/rate"),
        ("~dve: '/x': no such parameter", {"dve", "rate"}, "rosparam delete /joy_node/dve"),
        ("~rate: 'abc': must be a number", {"dev"}, ""),  # The command line has it.
        ("a file is missing", {"rate"}, ""),
    ],
)
def test_a_parameter_that_an_earlier_launch_has_left_is_named(error, stored, line):
    words = remedy(ValueError(error), "/joy_node", stored)
    assert words.endswith(line) and bool(words) is bool(line)
