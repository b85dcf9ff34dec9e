"""The programs of lesson 7, with scans of a simulated and of a real robot."""

import runpy
from math import inf, nan
from types import SimpleNamespace

import pytest
import rospy
from sensor_msgs.msg import LaserScan

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

SCRIPTS = REPOSITORY / "beginner_tutorials" / "scripts"


@claim("Programs of the lesson on worlds take inf and nan for nothing measured")
@pytest.mark.parametrize(
    ("program", "kind"), [("stop_before_wall", "StopBeforeWall"), ("wander", "Wander")]
)
@pytest.mark.parametrize(
    ("ranges", "speed"),
    [
        ([2.0, inf], 0.3), ([nan, 2.0], 0.3), ([2.0, nan], 0.3), ([nan, nan], 0.3),
        ([nan, 0.5], 0.0), ([0.5, nan], 0.0), ([inf, 0.5], 0.0), ([2.0, -inf], 0.0),
    ],
)  # fmt: skip
def test_what_is_not_measured_may_be_inf_or_nan(monkeypatch, program, kind, ranges, speed):
    sent = []
    publisher = SimpleNamespace(publish=sent.append)
    monkeypatch.setattr(rospy, "Publisher", lambda *_, **__: publisher)
    monkeypatch.setattr(rospy, "Subscriber", lambda *_, **__: None)
    monkeypatch.setattr(rospy, "get_param", lambda _, default: default)
    monkeypatch.setattr(rospy.Time, "now", lambda: rospy.Time(100))
    runpy.run_path(str(SCRIPTS / f"{program}.py"))[kind]().on_scan(LaserScan(ranges=ranges))
    assert [twist.linear.x for twist in sent] == [speed]
