"""Which input drives: what each publishes when, which is active then, what goes through."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.mux.arbitration import IDLE, TOGETHER_S, Arbiter, Publisher, Verdict
from fake_turtlebot_sim.mux.parameters import Input
from node_kit.arming import SETTLING_S

SAFETY = Input("safety", "input/safety", 0.2, 10)
TELEOP = Input("teleop", "input/teleop", 1.0, 7)
NAVI = Input("navi", "input/navi", 1.0, 5)
INPUTS = (NAVI, SAFETY, TELEOP)  # their order means nothing

FAR = Publisher(is_remote=True)
THROUGH, DROPPED = Verdict.OBEYED, Verdict.OUTRANKED
STOP = "stop"  # a zero of the mux's own is due

# Title: lines of (time [s], input, forward velocity, what becomes of it, active input).
STORIES = {
    "one input drives, falls silent, and the robot is stopped once": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.5, "navi", 0.1, THROUGH, "navi"),
        (1.4, None, None, None, "navi"),
        (1.5, None, None, STOP, IDLE),
        (1.6, None, None, None, IDLE),
    ],
    "an input that fell silent while it was outranked is not fallen back to": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.5, "teleop", 0.2, THROUGH, "teleop"),
        (1.0, "teleop", 0.2, THROUGH, "teleop"),
        (1.9, None, None, None, "teleop"),
        (2.0, None, None, STOP, IDLE),
    ],
    "after the last fall-back the stop of the robot still comes": [
        (0.0, "safety", -0.1, THROUGH, "safety"),
        (0.1, "navi", 0.1, DROPPED, "safety"),
        (0.2, None, None, None, "navi"),
        (1.1, None, None, STOP, IDLE),
    ],
    "a command that is not finite neither goes through nor keeps an input active": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.9, "navi", nan, Verdict.REJECTED, "navi"),
        (1.0, "navi", inf, Verdict.REJECTED, IDLE),
        (1.0, None, None, STOP, IDLE),
        (1.1, "teleop", -inf, Verdict.REJECTED, IDLE),
        (1.2, "navi", 0.1, THROUGH, "navi"),
    ],
}


@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES)
def test_who_drives(story):
    arbiter = Arbiter(INPUTS)
    for now, speaker, speed, outcome, active in story:
        if speaker:
            velocity = (speed, 0.0, 0.0, 0.0, 0.0, 0.0)
            assert arbiter.command(speaker, velocity, now) is outcome, now
        else:
            assert arbiter.must_stop(now) is (outcome is STOP), now
        assert arbiter.active(now) == active, now


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_each_of_the_six_numbers_must_be_finite(place, bad):
    velocity = [0.0] * 6
    velocity[place] = bad
    assert Arbiter(INPUTS).command("navi", velocity, 0.0) is Verdict.REJECTED


def test_nobody_is_noticed_late():
    arbiter = Arbiter(INPUTS)
    assert arbiter.lull(0.0) == 0.2  # nobody speaks: but safety may begin now
    arbiter.command("navi", (0.1,), 0.0)
    assert arbiter.lull(0.5) == 0.2
    assert arbiter.lull(0.875) == 0.125


TIMES = st.floats(0.0, 2.0, exclude_min=True)
SPEEDS = st.sampled_from([0.0, 0.1, -0.1])
NAMES = st.sampled_from([one.name for one in INPUTS])


class Running:
    """An Arbiter that is looked at in time, as the node does; what goes through, and when."""

    def __init__(self, inputs=(TELEOP,)):
        self.arbiter, self.through, self.verdicts, self._now = Arbiter(inputs), [], [], 0.0

    def until(self, now):
        while self._now < now:
            self._now = min(now, self._now + max(1e-9, self.arbiter.lull(self._now)))
            self.through += [(v[0], self._now) for v, _ in self.arbiter.waited(self._now)]
            self.arbiter.must_stop(self._now)

    def send(self, speed, now, name="teleop", sender=FAR):
        self.until(now)
        self.verdicts.append(self.arbiter.command(name, (speed,), now, sender))
        if self.verdicts[-1] is THROUGH:
            self.through.append((speed, now))


@given(st.lists(st.tuples(TIMES, NAMES, SPEEDS, st.integers(0, 9))))
def test_silence_of_all_leaves_the_robot_standing(events):
    running, now = Running(INPUTS), 0.0
    for pause_s, name, speed, sender in events:
        now += pause_s
        running.send(speed, now, name, Publisher(str(sender), is_remote=True))
    running.until(now + TOGETHER_S)
    assert running.arbiter.must_stop(now + 2.0) is bool(
        running.through
        and running.through[-1][0] != 0.0
        and running.arbiter.active(now + TOGETHER_S) != IDLE
    )
    assert not running.arbiter.must_stop(now + 2.0)


def key(delay_s, times=30, rate=30.0):
    """Times [s] at which a held key sends: at once, after the delay, then repeated."""
    return [0.0] + [delay_s + k / rate for k in range(times)]


# When an ordinary program sends, and never a zero.
PROGRAMS = {
    "1 Hz": [float(k) for k in range(20)],
    "2 Hz": [k / 2 for k in range(40)],
    "10 Hz": [k / 10 for k in range(100)],
    "10 Hz, and a pause": [k / 10 + 3.0 * (k > 50) for k in range(100)],
    "10 Hz, a busy machine": [k / 10 + 0.7 * (k > 50) for k in range(100)],
    "taps each 0.8 s": [0.8 * k for k in range(20)],
    **{f"a key held, first repeat after {s} s": key(s) for s in (0.25, 0.5, 0.66)},
    "a key tapped, then held": [0.0, 0.8] + [5.0 + s for s in key(0.66)],
}


@pytest.mark.parametrize("times", PROGRAMS.values(), ids=PROGRAMS)
def test_a_program_is_obeyed_whose_network_is_whole(times):
    running = Running()
    for number, now in enumerate(times, start=1):
        running.send(float(number), now)
    running.until(times[-1] + 2 * TOGETHER_S)
    assert [speed for speed, _ in running.through] == list(range(1, len(times) + 1))
    assert all(s - times[int(n) - 1] <= TOGETHER_S + 1e-9 for n, s in running.through)


# What one sender publishes when: lines of (time [s], speed, the Verdict).
WAITS, LATE = Verdict.WAITS, Verdict.LATE
LATE_STORIES = {
    "a network is restored: of what came meanwhile nothing moves the robot, the next does": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, WAITS),
        (5.0, 0.3, LATE),
        (5.001, 0.3, LATE),
        (5.2, 0.3, LATE),  # this one may be of now
        (5.3, 0.4, THROUGH),
    ],
    "a zero among the late commands goes through and frees none of them": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, WAITS),
        (5.0, 0.0, THROUGH),
        (5.0, 0.3, LATE),
        (5.001, 0.0, THROUGH),
        (5.002, 0.3, LATE),
    ],
    "a zero is the first of the late commands": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.0, THROUGH),
        (5.0, 0.3, LATE),
    ],
    "the first of them comes before the others": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, WAITS),
        (5.1, 0.3, THROUGH),
        (5.101, 0.3, LATE),
        (5.2, 0.3, LATE),
    ],
    "after a zero there is nothing that could be late": [
        (0.0, 0.2, THROUGH),
        (0.1, 0.0, THROUGH),
        (5.0, 0.2, THROUGH),
        (5.0, 0.3, THROUGH),
    ],
}


@pytest.mark.parametrize("story", LATE_STORIES.values(), ids=LATE_STORIES)
def test_late_commands(story):
    running = Running()
    for now, speed, verdict in story:
        running.send(speed, now)
        assert running.verdicts[-1] is verdict, now


STICK_STORIES = {
    "a stick that is held does not drive on after an outage": [
        (0.0, 0.2, THROUGH),
        (0.49, 0.2, THROUGH),
        (1.2, 0.2, LATE),
        (1.4, 0.3, LATE),
        (9.0, 0.3, LATE),
    ],
    "a zero among the late commands frees none of them": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, LATE),
        (5.0, 0.0, THROUGH),
        (5.001, 0.3, LATE),
    ],
    "a rest of half a second, a zero and silence, sets it free": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, LATE),
        (5.1, 0.0, THROUGH),
        (5.5, 0.2, LATE),
        (5.6, 0.0, THROUGH),
        (5.8, 0.0, THROUGH),
        (6.2, 0.2, THROUGH),
        (6.3, 0.3, THROUGH),
    ],
}


@pytest.mark.parametrize("story", STICK_STORIES.values(), ids=STICK_STORIES)
def test_late_commands_of_a_stick(story):
    running = Running()
    for now, speed, verdict in story:
        running.send(speed, now, sender=Publisher("joy2twist", is_stick=True))
        assert running.verdicts[-1] is verdict, now


@given(
    st.floats(0.51, 100.0),
    st.lists(st.tuples(st.floats(0.0, 0.9 * TOGETHER_S), SPEEDS), min_size=1, max_size=10),
)
def test_not_one_command_of_a_late_burst_moves(silence_s, burst):
    """Whatever is in the burst, as long as less than TOGETHER_S lies between two commands."""
    running, now = Running(), silence_s
    running.send(0.2, 0.0)
    running.send(0.3, now)
    for pause_s, speed in burst:
        now += pause_s
        running.send(speed, now)
    running.until(silence_s + SETTLING_S)
    assert not any(speed for speed, _ in running.through[1:])


def test_what_comes_from_this_host_is_never_late():
    """The safety controller sends what it must, when it must, and falls silent."""
    arbiter = Arbiter([SAFETY])
    for now in (0.0, 5.0, 5.001, 5.002):
        assert arbiter.command("safety", (-0.1,), now, Publisher("/safety")) is THROUGH


def test_what_one_sender_left_is_not_held_against_the_next():
    """Who ends a program in the middle of a motion and starts it anew drives at once."""
    arbiter = Arbiter([TELEOP])
    assert (
        arbiter.command("teleop", (0.2,), 0.0, Publisher("/rostopic_1", is_remote=True)) is THROUGH
    )
    assert (
        arbiter.command("teleop", (0.2,), 5.0, Publisher("/rostopic_2", is_remote=True)) is THROUGH
    )
    assert arbiter.command("teleop", (0.2,), 5.1, Publisher("/rostopic_1", is_remote=True)) is WAITS
    assert arbiter.active(9.0) == IDLE  # what waits, or is late, keeps nobody active


def test_what_waits_is_outranked_like_any_other():
    arbiter = Arbiter(INPUTS)
    for now in (0.0, 5.0):
        arbiter.command("navi", (0.2,), now, FAR)
    arbiter.command("teleop", (0.1,), 5.01)
    assert list(arbiter.waited(5.01)) == []
    assert list(arbiter.waited(5.02)) == []
    assert arbiter.active(5.02) == "teleop"
