"""draw_square: it drives to the corners of a square in a simulated field."""

import runpy
from types import SimpleNamespace
from unittest import mock

import pytest
import rospkg
import rospy

from simulated_turtles.field import START, Field
from simulated_turtles.ros.turtlesim_node import PERIOD_S
from tutorial_testing.claims import claim

SCRIPT = f"{rospkg.RosPack().get_path('turtlesim')}/scripts/draw_square"


@claim("draw_square returns to its start, and logs each goal and that it is reached")
def test_four_sides_return_to_the_start():
    field = Field(lambda: (0, 0, 0), 0.0)
    square, corners, lines, now_s = runpy.run_path(SCRIPT)["square"](), [], [], 0.0
    turtle, twist = field.turtles["turtle1"], next(square)

    def log(line):
        lines.append(line)
        if line.startswith("New goal ["):
            corners.append(turtle.pose[:2])

    with mock.patch.object(rospy, "loginfo", log):
        while len(corners) < 9:
            now_s += PERIOD_S
            assert now_s < 60.0
            velocity = {"ahead": twist.linear.x, "left": 0.0, "turn": twist.angular.z}
            field.call("turtle1/command", velocity, now_s)
            field.step(now_s)
            names = ("x", "y", "theta", "linear_velocity", "angular_velocity")
            twist = square.send(SimpleNamespace(**dict(zip(names, turtle.pose))))
    x, y = START[:2]
    for place, corner in zip(corners[1::2], [(2, 0), (2, 2), (0, 2), (0, 0)]):
        assert place == pytest.approx((x + corner[0], y + corner[1]), abs=0.4)
    assert lines[1::2] == ["Reached goal"] * 8  # after each goal but the last
