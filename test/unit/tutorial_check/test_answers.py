"""One Twist for each Joy, and at once."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises.answers import (
    check_awake,
    check_clock,
    check_once,
    check_strays,
    repetition,
)
from tutorial_check.exercises.ending import _late_zero as late_zero
from tutorial_check.model import Wrong
from tutorial_check.python_facts import read_python

ANSWERS = [(0.1 * k, 0.0, 0.0, 0.0, 0.0, 0.5) for k in range(20)]
ZERO = (0.0,) * 6
PROGRAM = """
def callback(data):
    publish(msg)
    send(msg)
def send(msg):
    pub.publish(msg)
    rospy.sleep(0.5)
def shutdown(self):
    pub.publish(Twist())
rospy.Subscriber("/joy", Joy, callback)
"""


def each(*kinds):
    """All Twists, if each answer comes with these."""
    return [twist for answer in ANSWERS for twist in [*kinds, answer]]


def seen(twists, **more):
    """What a Drive saw."""
    samples = [((), answer) for answer in ANSWERS]
    about = {"script": "joy2twist.py", "samples": samples, "twists": twists, "has_clock": False}
    return SimpleNamespace(**{**about, **more})


@pytest.mark.parametrize(
    "twists, expected",
    [
        ([], (1, False)),  # there was no second pass
        (each(), (1, False)),
        ([*each(), ZERO], (1, False)),  # a late one of before
        (each(ZERO), (2, True)),
        (each(ZERO, ZERO), (3, True)),
        ([twist for answer in ANSWERS for twist in (answer, ZERO)], (2, True)),
        (sorted(2 * ANSWERS), (2, False)),
        (sorted(2 * ANSWERS)[1:], (2, False)),  # each of the second ones late
        (sorted(3 * ANSWERS), (3, False)),
        ([*each(), *10 * [ZERO]], (1, False)),  # by now and then
    ],
)
def test_repetition(twists, expected):
    assert repetition(ANSWERS, twists) == expected


def test_two_that_differ_are_wrong_at_the_second_publish():
    with pytest.raises(Wrong, match="2 Twists for each Joy, and they differ") as caught:
        check_once(seen(each(ZERO)), read_python(PROGRAM))
    assert caught.value.where == "joy2twist.py:6"


def test_two_that_are_alike_are_worth_a_note_at_the_second_subscriber():
    facts = read_python(2 * 'rospy.Subscriber("/joy", Joy, lambda data: publish(data))\n')
    note = check_once(seen(sorted(2 * ANSWERS)), facts)
    assert (note.seen, note.where) == ("2 Twists for each Joy", "joy2twist.py:2")


def test_a_clock_of_its_own_may_send_as_many_as_it_likes():
    assert check_once(seen(each(ZERO), has_clock=True), read_python(PROGRAM)) is None


def test_a_sleep_is_told_with_its_line():
    facts = read_python(PROGRAM)
    sleeper = seen([], naps=True, waits=[0.5] * 3, sleep_lines=facts.called_back["sleep"])
    with pytest.raises(Wrong, match="the callback sleeps") as caught:
        check_awake(sleeper)
    assert caught.value.where == "joy2twist.py:7"


def test_what_callbacks_call():
    assert read_python(PROGRAM).called_back == {
        "publish": [3, 6],
        "send": [4],
        "sleep": [7],
    }
    bound = 'rospy.Subscriber("/joy", Joy, callback=self.heard)\ndef heard(self, data): sleep(1)\n'
    assert read_python(bound).called_back == {"sleep": [2]}


LOOP = """
def callback(data):
    pub.publish(msg)
rospy.Subscriber("/joy", Joy, callback)
pub.publish(Twist())
while not rospy.is_shutdown():
    pub.publish(Twist())
"""


@pytest.mark.parametrize(
    ("twists", "more", "complaint"),
    [
        (each(), {"strays": 3}, ""),
        (each(ZERO), {"strays": 0, "has_clock": True}, "every Twist is zero"),
    ],
)
def test_zeros_between_the_answers(twists, more, complaint):
    with pytest.raises(Wrong, match="zeros come between") as caught:
        check_strays(seen(twists, **more), read_python(LOOP), complaint)
    assert caught.value.where == "joy2twist.py:7"


@pytest.mark.parametrize(
    ("twists", "more", "complaint"),
    [
        (each(), {"strays": 2}, ""),  # of a machine that stuttered
        (each(ZERO), {"strays": 0, "has_clock": True}, ""),  # nothing is odd: before the first Joy
        (each(ZERO), {"strays": 0, "has_clock": False}, "the sign is wrong"),
        ([ZERO], {"strays": 0, "has_clock": True}, "every Twist is zero"),
    ],
)
def test_no_zeros_between(twists, more, complaint):
    check_strays(seen(twists, **more), read_python(LOOP), complaint)


def test_a_clock_that_goes_on_with_the_last_velocity():
    loop = LOOP.replace("publish(Twist())", "publish(msg)")
    with pytest.raises(Wrong, match="by a clock of its own") as caught:
        check_clock(seen(each(), repeats=True), read_python(loop))
    assert caught.value.where == "joy2twist.py:7"
    check_clock(seen(each(), repeats=False), read_python(loop))


@pytest.mark.parametrize(("first", "line"), [("sleep(2)", 4), ("self.pub.publish(Twist())", 0)])
def test_the_sleep_before_the_zero(first, line):
    then = "self.pub.publish(Twist())" if line else "sleep(2)"
    text = f"rospy.on_shutdown(self.stop)\n\ndef stop(self):\n    {first}\n    {then}\n"
    assert late_zero(read_python(text)) == line
