"""What is said of joy2twist from recorded facts, where no program shows it reliably."""

from types import SimpleNamespace

import pytest

from courses.handout.driving import behaviour as c
from courses.handout.driving.facts import Facts, repetition
from courses.handout.driving.run import Drive
from courses.handout.task import CMD_VEL, JOY, JoystickTask
from tutorial_check.checking.rows import find
from tutorial_check.submission.python_facts import PythonFacts

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


def each(*kinds):
    """All Twists, if each answer comes with these."""
    return [twist for answer in ANSWERS for twist in [*kinds, answer]]


SAMPLES = tuple(((), answer) for answer in ANSWERS)


def conversation(text, complaint="", **recorded):
    """The Facts with a program of that text, of which this was recorded."""
    about = {
        "samples": SAMPLES, "connected": True, "publishers": {CMD_VEL: ("/node",)},
        "subscribers": {JOY: ("/node",)}, "types": {CMD_VEL: "geometry_msgs/Twist"},
    }  # fmt: skip
    about_files = {"scripts": lambda _: {SCRIPT: PythonFacts(text)}, "text": lambda *_: text}
    submission = SimpleNamespace(task=JoystickTask({}), **about_files)
    one = Facts(submission, Drive(SCRIPT, **{**about, **recorded}))
    one.complaint = complaint
    return one


@pytest.mark.parametrize(
    ("rows", "text", "recorded", "seen", "where"),
    [
        ("NOT_CONNECTED", PROGRAM, {"subscribers": {}, "publishers": {JOY: 1}, "types": {JOY: "T"}},
         "PUBLISHES on /joy (T)", f"{SCRIPT}:5"),
        ("DISPLAYED", PROGRAM, {"shown": 3}, "3 of 20 were displayed", ""),
        ("NOT_DISPLAYED", "rospy.Publisher()\nrospy.logdebug(1)", {}, "level debug", ""),
        ("TOPICS", PROGRAM, {"types": {CMD_VEL: "T"}}, "/cmd_vel carries T", f"{SCRIPT}:4"),
        ("TOPICS", "", {"publishers": {CMD_VEL: ["/a", "/b"]}}, "several do: /a, /b", SCRIPT),
        ("TOPICS", PROGRAM, {}, "the Publisher is made in the callback", f"{SCRIPT}:4"),
        ("NO_TOPIC", PROGRAM, {"publishers": {"/cmd_vel_mux/a": 1}}, "_mux/a", f"{SCRIPT}:4"),
    ],
)  # fmt: skip
def test_recorded_facts_have_a_diagnosis(rows, text, recorded, seen, where):
    wrong = find(getattr(c, rows), conversation(text, **recorded), "")
    assert seen in wrong.seen and wrong.where == where


@pytest.mark.parametrize(
    ("rows", "text", "recorded"),
    [
        ("CONNECTED", NO_CALLBACK, {"shown": 3}),
        ("TOPICS", LATCHED, {}),
        ("ONCE", LOOP, {"strays": 2}),  # the machine stuttered
        ("ONCE", LOOP, {"twists": each(ZERO), "has_clock": True}),  # before the first Joy
        ("ONCE", LOOP, {"twists": [ZERO], "has_clock": True, "complaint": "every Twist is zero"}),
        ("RIGHT_RULE", LOOP, {}),
    ],
)
def test_recorded_facts_that_are_right_have_none(rows, text, recorded):
    assert find(getattr(c, rows), conversation(text, **recorded)) is None


@pytest.mark.parametrize(
    ("twists", "expected"),
    [
        ([], (1, False)),  # there was no second pass
        ([*each(), ZERO], (1, False)),  # a late one of before
        (each(ZERO, ZERO), (3, True)),
        (sorted(2 * ANSWERS)[1:], (2, False)),  # each of the second ones late
        ([*each(), *10 * [ZERO]], (1, False)),  # by now and then
    ],
)
def test_how_often_each_twist_comes(twists, expected):
    assert repetition(ANSWERS, twists) == expected
