"""Diagnoses of joy2twist from recorded facts that no program produces reliably."""

from types import SimpleNamespace

import pytest

from courses.handout.driving import answer_diagnoses as a
from courses.handout.driving import connection_diagnoses as c
from courses.handout.driving.joy2twist_node import Joy2TwistNode, repetition
from courses.handout.driving.joy2twist_run import Connections, Joy2TwistRun, NumberedJoys, Stream
from courses.handout.task import CMD_VEL, JOY, JoystickTask
from tutorial_check import Wrong, first_of
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_testing.claims import claim

pytestmark = claim(
    "What no program shows reliably, joy2twist or talker and listener, has its diagnosis from "
    "recorded facts, and a machine that stuttered is not blamed on the student"
)
SCRIPT = "joy2twist.py"
ANSWERS = [(0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.5) for k in range(20)]
ZERO = (0.0,) * 6
PROGRAM = """def callback(data):
    send(msg)
def send(msg):
    rospy.Publisher("/cmd_vel", Twist, queue_size=1).publish(msg)
rospy.Subscriber("/joy", Joy, callback)
"""
LOOP = """rospy.Subscriber("/joy", Joy, callback)
while not rospy.is_shutdown():
    pub.publish(Twist())
"""
NO_CALLBACK = 'rospy.Subscriber("/joy", Joy)\n'
LATCHED = "from sensor_msgs.msg import Joy\npub = rospy.Publisher('/cmd_vel', Twist, latch=True)\n"


def answers_with(*kinds):
    """All Twists, if these precede each answer."""
    return [twist for answer in ANSWERS for twist in [*kinds, answer]]


SAMPLES = tuple(((), answer) for answer in ANSWERS)
ALL_ZERO = Wrong("", "every Twist is zero")
ODD_NODES = Connections(subscribers={}, publishers={JOY: ("/a",)}, types={JOY: "T"})


def connected(publishers=("/node",), kind="geometry_msgs/Twist", topic=CMD_VEL):
    return Connections(True, {topic: publishers}, {JOY: ("/node",)}, {CMD_VEL: kind})


def node(text, connections=None, stray_zeros=0, verdict=None, **numbered):
    """A node whose program has this text, with these recorded facts."""
    facts = PythonFacts(text)
    about_files = {"facts_of": lambda *_: facts, "programs": lambda _: {SCRIPT: facts}}
    about_files["text"] = lambda *_: text
    run = Joy2TwistRun(
        SCRIPT,
        connections=connections or connected(),
        numbered=NumberedJoys(**{"samples": SAMPLES, **numbered}),
        stream=Stream(stray_zeros=stray_zeros),
    )
    recorded = Joy2TwistNode(SimpleNamespace(task=JoystickTask({}), **about_files), run)
    recorded.rule_verdict = verdict
    return recorded


@pytest.mark.parametrize(("diagnoses", "recorded", "seen", "where"), [
    (c.NOT_CONNECTED, node(PROGRAM, ODD_NODES), "PUBLISHES on /joy (T)", f"{SCRIPT}:5"),
    (a.DISPLAYED, node(PROGRAM, displayed=3), "3 of 20 were displayed", ""),
    (a.NOT_DISPLAYED, node("rospy.Publisher()\nrospy.logdebug(1)"), "level debug", ""),
    (c.TOPICS, node(PROGRAM, connected(kind="T")), "/cmd_vel carries T", f"{SCRIPT}:4"),
    (c.TOPICS, node("", connected(("/a", "/b"))), "several do: /a, /b", SCRIPT),
    (c.TOPICS, node(PROGRAM), "the Publisher is made in the callback", f"{SCRIPT}:4"),
    (c.NO_TOPIC, node(PROGRAM, connected(topic="/cmd_vel_mux/a")), "_mux/a", f"{SCRIPT}:4"),
    (a.ONCE, node(LOOP, stray_zeros=3), "zeros come between the answers", f"{SCRIPT}:3"),
])  # fmt: skip
def test_recorded_facts_have_a_diagnosis(diagnoses, recorded, seen, where):
    verdict = first_of(diagnoses, recorded)
    assert seen in verdict.seen and verdict.where == where


@pytest.mark.parametrize(("diagnoses", "recorded"), [
    (c.CONNECTED, node(NO_CALLBACK, displayed=3)),
    (c.TOPICS, node(LATCHED)),
    (a.ONCE, node(LOOP, stray_zeros=2)),  # the machine stuttered
    (a.ONCE, node(LOOP, twists=answers_with(ZERO), has_clock=True)),  # before the first Joy
    (a.ONCE, node(LOOP, twists=[ZERO], has_clock=True, verdict=ALL_ZERO)),
    (a.RIGHT_RULE, node(LOOP)),
])  # fmt: skip
def test_recorded_facts_that_are_right_have_none(diagnoses, recorded):
    assert first_of(diagnoses, recorded) is None


@pytest.mark.parametrize(("twists", "expected"), [
    ([], (1, False)),  # no second pass was recorded
    ([*answers_with(), ZERO], (1, False)),  # a late Twist from before
    (answers_with(ZERO, ZERO), (3, True)),
    (sorted(2 * ANSWERS)[1:], (2, False)),  # every second Twist is late
    ([*answers_with(), *10 * [ZERO]], (1, False)),  # zeros sent now and then
])  # fmt: skip
def test_how_often_each_twist_comes(twists, expected):
    assert repetition(ANSWERS, twists) == expected
