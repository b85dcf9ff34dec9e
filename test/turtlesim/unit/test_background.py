"""The background's parameters are read as roscpp reads whole numbers."""

import math
from unittest import mock

import pytest
import rospy

from simulated_turtles.ros.turtlesim_node import background
from tutorial_testing.claims import claim


@claim("turtlesim's background is read as roscpp reads whole numbers")
@pytest.mark.parametrize(
    ("value", "red"),
    [
        (150, 150),
        (10.7, 11),
        (10.5, 11),
        (10.4, 10),
        (-0.2, 255),
        (300, 44),
        (True, 69),
        ("150", 69),
        (None, 69),
        (math.nan, 0),
        (1e10, 0),
    ],
)
def test_numbers_are_rounded_and_the_rest_is_the_default(value, red):
    given = {"~background_r": value}
    with mock.patch.object(rospy, "get_param", given.get):
        assert background() == (red, 86, 255)
