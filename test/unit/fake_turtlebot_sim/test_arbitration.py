"""Which input drives: what each publishes when, which is active then, what goes through."""

from math import inf, nan

import pytest

from fake_turtlebot_sim.mux.arbitration import IDLE, TOGETHER_S, Arbiter, Publisher, Verdict
from fake_turtlebot_sim.mux.parameters import Input

INPUTS = (Input("navi", "navi", 1.0, 5), Input("safety", "safety", 0.2, 10),
          Input("teleop", "teleop", 1.0, 7))  # their order means nothing  # fmt: skip
HERE, FAR = Publisher("/here"), Publisher("/far", is_remote=True)
STICK = Publisher("joy2twist", is_stick=True)
THROUGH, DROPPED, REJECTED = Verdict.OBEYED, Verdict.OUTRANKED, Verdict.REJECTED
WAITS, LATE = Verdict.WAITS, Verdict.LATE
STOP = "stop"  # a zero of the mux's own is due

# Title: lines of (time [s], input, forward velocity, what becomes of it, active input).
STORIES = {
    "one input drives, falls silent, and the robot is stopped once": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (1.4, "navi", 0.1, THROUGH, "navi"),
        (2.3, None, None, None, "navi"),
        (2.4, None, None, STOP, IDLE),
        (2.5, None, None, None, IDLE),
    ],
    "after the last fall-back the stop of the robot still comes": [
        (0.0, "safety", -0.1, THROUGH, "safety"),
        (0.1, "navi", 0.1, DROPPED, "safety"),
        (0.2, None, None, None, "navi"),
        (1.1, None, None, STOP, IDLE),
    ],
    "a command that is not finite neither goes through nor keeps an input active": [
        (0.0, "navi", 0.1, THROUGH, "navi"),
        (0.9, "navi", nan, REJECTED, "navi"),
        (1.0, "navi", inf, REJECTED, IDLE),
        (1.0, None, None, STOP, IDLE),
        (1.1, "navi", 0.1, THROUGH, "navi"),
    ],
}


@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES)
def test_the_highest_input_that_is_not_silent_drives(story):
    arbiter = Arbiter(INPUTS)
    for now, speaker, speed, outcome, active in story:
        if speaker:
            assert arbiter.command(speaker, (speed, 0.0), now) is outcome, now
        else:
            assert arbiter.must_stop(now) is (outcome is STOP), now
        assert arbiter.active(now) == active, now


class Running:
    """An Arbiter that is looked at in time, as the node does; what goes through, and when."""

    def __init__(self):
        self.arbiter, self.through, self._now = Arbiter(INPUTS), [], 0.0

    def until(self, now):
        while self._now < now:
            self._now = min(now, self._now + max(1e-9, self.arbiter.lull(self._now)))
            self.through += [(v[0], self._now) for v, _ in self.arbiter.waited(self._now)]

    def send(self, speed, now, sender=FAR):
        self.until(now)
        verdict = self.arbiter.command("teleop", (speed,), now, sender)
        if verdict is THROUGH:
            self.through.append((speed, now))
        return verdict


def key(delay_s):
    """Times [s] at which a held key sends: at once, after the delay, then repeated."""
    return [0.0] + [delay_s + k / 30 for k in range(30)]


# When an ordinary program sends, and never a zero.
PROGRAMS = {
    "1 Hz": [float(k) for k in range(20)],
    "2 Hz": [k / 2 for k in range(40)],
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
LATE_STORIES = {
    "a network is restored: of what came meanwhile nothing moves the robot, the next does": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, WAITS),
        (5.001, 0.0, THROUGH),  # a zero goes through and frees none
        (5.002, 0.3, LATE),
        (5.2, 0.3, LATE),  # this one may be of now
        (5.3, 0.4, THROUGH),
    ],
    "the first of them comes before the others": [
        (0.0, 0.2, THROUGH),
        (5.0, 0.2, WAITS),
        (5.1, 0.3, THROUGH),
        (5.101, 0.3, LATE),
    ],
    "after a zero there is nothing that could be late": [
        (0.0, 0.2, THROUGH),
        (0.1, 0.0, THROUGH),
        (5.0, 0.2, THROUGH),
        (5.0, 0.3, THROUGH),
    ],
}
STICK_STORIES = {
    "a stick that is held does not drive on after an outage": [
        (0.0, 0.2, THROUGH),
        (0.49, 0.2, THROUGH),
        (1.2, 0.2, LATE),
        (9.0, 0.3, LATE),
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
SENDERS = [(FAR, LATE_STORIES[one]) for one in LATE_STORIES]
SENDERS += [(STICK, STICK_STORIES[one]) for one in STICK_STORIES]
# The safety controller sends what it must, when it must, and falls silent.
SENDERS += [(HERE, [(now, 0.1, THROUGH) for now in (0.0, 5.0, 5.001, 5.002)])]


@pytest.mark.parametrize(
    ("sender", "story"), SENDERS, ids=[*LATE_STORIES, *STICK_STORIES, "of this host none is late"]
)
def test_late_commands_move_nothing(sender, story):
    running = Running()
    for now, speed, verdict in story:
        assert running.send(speed, now, sender) is verdict, now


def test_what_one_sender_left_is_not_held_against_the_next():
    """Who ends a program in the middle of a motion and starts it anew drives at once."""
    running, anew = Running(), Publisher("/rostopic_2", is_remote=True)
    assert running.send(0.2, 0.0) is running.send(0.2, 5.0, anew) is THROUGH
    assert running.arbiter.command("teleop", (0.2,), 5.1, FAR) is WAITS
    assert running.arbiter.active(9.0) == IDLE  # what waits, or is late, keeps nobody active
