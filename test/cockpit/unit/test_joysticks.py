"""What is published for the driven robot, and what is known of others' joysticks."""

from math import inf
from types import SimpleNamespace

import pytest
import rospy
from sensor_msgs.msg import Joy

from cockpit_server.graph import JOY, Graph
from cockpit_server.ros import joysticks
from cockpit_server.ros.joysticks import LONGEST_JOY, Joysticks, shown
from tutorial_testing.claims import claim
from tutorial_testing.session_room import DRIVE, Graphs, Topics, look, page, serialised

pytestmark = claim(
    "A hand that is still drives for as long as it is held; the cockpit publishes for the driven "
    "robot alone"
)
GRAPH = Graph(subscribers={"/ada/joy": {"/joy2twist"}}, types={"/ada/joy": JOY})


@pytest.fixture
def ours(monkeypatch):
    """(Joysticks of the robot ada, their Topics)."""
    monkeypatch.setattr(joysticks, "later_once", lambda action: action())
    topics = Topics()
    return Joysticks(topics, Graphs(GRAPH), "/cockpit"), topics


def test_a_hand_that_is_still_trembles_and_only_the_driven_robot_has_a_publisher(ours, monkeypatch):
    sent, ended = [], []
    publish, end = lambda joy: sent.append(tuple(joy.axes)), lambda: ended.append(len(sent))
    publisher = SimpleNamespace(publish=publish, end=end)
    monkeypatch.setattr(joysticks, "PromptPublisher", lambda *_: publisher)
    monkeypatch.setattr(joysticks.rospy.Time, "now", rospy.Time)
    ours, _ = ours
    ours.advertise("ada")
    for _ in range(8):
        ours.send("ada", *DRIVE)
    ours.advertise(None)
    ours.send("ada", *DRIVE)
    assert (len(sent), len(set(sent)), ended) == (8, 2, [8])


def test_joystick_is_shown_finite_and_up_to_a_length():
    joy = Joy(axes=[0.123456, inf], buttons=[1, 0])
    assert shown(serialised(joy)) == {"axes": [0.1235, 0.0], "buttons": [1, 0]}
    assert shown(b"none") is None
    assert shown(serialised(Joy(buttons=[0] * LONGEST_JOY))) is None


def test_other_joystick_is_a_rival_whatever_is_in_its_message(ours, monkeypatch):
    ours, topics = ours
    viewer = page(look="ada", floor=True)
    look(ours, viewer)
    topics.hear("/ada/joy", Joy())
    assert [len(look(ours, viewer)[0]) for _ in range(2)] == [1, 0]  # a message is sent once
    monkeypatch.setattr(joysticks, "shown", lambda data: [].pop())
    with pytest.raises(IndexError):
        topics.hear("/ada/joy", b"")
    assert ours.rival("ada", 0.0) == "/other"
    assert ours.rival("ada", inf) == ""
