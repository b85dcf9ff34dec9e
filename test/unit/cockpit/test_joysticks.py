"""What is published for the driven robot."""

from types import SimpleNamespace

import rospy

from cockpit_server.driving import joysticks
from tutorial_testing.session_room import DRIVE


def test_a_hand_that_is_still_trembles_and_only_the_driven_robot_has_a_publisher(monkeypatch):
    sent, ended = [], []
    publisher = SimpleNamespace(
        publish=lambda joy: sent.append(tuple(joy.axes)), end=lambda: ended.append(len(sent))
    )
    monkeypatch.setattr(joysticks, "PromptPublisher", lambda *_: publisher)
    monkeypatch.setattr(joysticks.rospy.Time, "now", rospy.Time)
    ours = joysticks.Joysticks()
    ours.keep("ada")
    for _ in range(8):
        ours.send("ada", *DRIVE)
    ours.keep(None)
    ours.send("ada", *DRIVE)
    assert (len(sent), len(set(sent)), ended) == (8, 2, [8])
