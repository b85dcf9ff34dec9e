"""Programs that the mux obeys; TestMux in test_stateful.py covers arbitrary commands."""

import pytest

from fake_turtlebot_sim.mux.arbitration import IDLE, TOGETHER_S, Arbiter, PublishingNode, Ruling
from fake_turtlebot_sim.mux.parameters import Input
from tutorial_testing.claims import claim

INPUTS = (Input("navi", "navi", 1.0, 5), Input("safety", "safety", 0.2, 10),
          Input("teleop", "teleop", 1.0, 7))  # their order has no meaning  # fmt: skip
HERE, FAR = PublishingNode("/here"), PublishingNode("/far", is_remote=True)


@claim(
    "The highest input that is not silent drives; silence of all gives one zero; what comes during "
    "a suspension is never obeyed"
)
def test_the_highest_input_that_is_not_silent_drives():
    arbiter = Arbiter(INPUTS)
    assert arbiter.active(0.0) == IDLE and not arbiter.must_stop(0.0)
    for name, now in (("navi", 0.0), ("safety", 0.1), ("teleop", 0.2)):
        arbiter.command(name, (0.1,), now)
    active = [arbiter.active(now) for now in (0.25, 0.35, 1.15, 1.25)]
    assert active == ["safety", "teleop", "teleop", IDLE]


class Running:
    """An Arbiter asked in time, as the node does; through: the commands that pass, with times."""

    def __init__(self):
        self.arbiter, self.through, self._now = Arbiter(INPUTS), [], 0.0

    def until(self, now):
        while self._now < now:
            self._now = min(now, self._now + max(1e-9, self.arbiter.lull(self._now)))
            self.through += [(v[0], self._now) for v, _ in self.arbiter.waited(self._now)]

    def send(self, speed, now, sender=FAR):
        self.until(now)
        ruling = self.arbiter.command("teleop", (speed,), now, sender)
        if ruling is Ruling.OBEYED:
            self.through.append((speed, now))
        return ruling


def key(delay_s):
    """Return the times [s] at which a held key sends: at once, after the delay, then repeated."""
    return [0.0] + [delay_s + k / 30 for k in range(30)]


# Times at which ordinary programs send; they never send a zero.
PROGRAMS = {
    "1 Hz": [float(k) for k in range(20)],
    "10 Hz, a busy machine": [k / 10 + 0.7 * (k > 50) for k in range(100)],
    **{f"a key held, first repeat after {s} s": key(s) for s in (0.25, 0.5, 0.66)},
    "a key tapped, then held": [0.0, 0.8] + [5.0 + s for s in key(0.66)],
}


@claim("Ordinary programs of any rhythm are obeyed")
@pytest.mark.parametrize("times", PROGRAMS.values(), ids=PROGRAMS)
def test_a_program_is_obeyed_whose_network_is_whole(times):
    running = Running()
    for number, now in enumerate(times, start=1):
        running.send(float(number), now)
    running.until(times[-1] + 2 * TOGETHER_S)
    assert [speed for speed, _ in running.through] == list(range(1, len(times) + 1))
    assert all(s - times[int(n) - 1] <= TOGETHER_S + 1e-9 for n, s in running.through)


def test_of_two_that_waited_only_the_higher_drives():
    arbiter = Arbiter(INPUTS)
    for now, ruling in ((0.0, Ruling.OBEYED), (5.0, Ruling.WAITS)):
        for name, speed in (("navi", 0.2), ("teleop", 0.3), ("safety", 0.1)):
            assert arbiter.command(name, (speed,), now, FAR) is ruling
    assert [*arbiter.waited(5.0 + TOGETHER_S)] == [((0.1,), FAR)]


def test_of_this_host_none_is_late():
    """The safety controller sends only when it must, then falls silent."""
    running = Running()
    for now in (0.0, 5.0, 5.001, 5.002):
        assert running.send(0.1, now, HERE) is Ruling.OBEYED


def test_what_one_sender_left_is_not_held_against_the_next():
    """A program that exits during a motion and restarts drives at once."""
    running, restarted = Running(), PublishingNode("/rostopic_2", is_remote=True)
    assert running.send(0.2, 0.0) is running.send(0.2, 5.0, restarted) is Ruling.OBEYED
    assert running.arbiter.command("teleop", (0.2,), 5.1, FAR) is Ruling.WAITS
    assert running.arbiter.active(9.0) == IDLE  # late and waiting commands keep no input active
