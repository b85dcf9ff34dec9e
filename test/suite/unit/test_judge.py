"""What the judge of the live hunt reports for a stream of events."""

import pytest

from tutorial_faults.live.judge import BEGINS, ENDS, HANDS, WHEELS, Event, Trial, velocity
from tutorial_testing.claims import claim
from tutorial_testing.hands import DRIVE, RELEASED

pytestmark = claim("The hunt sees a base that drives as soon as it is restarted")
DRIVES, RESTS = velocity(0.3, 0.0), velocity(0.0, 0.0)


def odometry(begin_s, end_s, seen):
    """Return what a base reports, at 50 Hz."""
    return [Event(k / 50, WHEELS, seen) for k in range(round(begin_s * 50), round(end_s * 50))]


@pytest.mark.parametrize(
    ("about", "fault", "hands", "back", "letters"),
    [
        ("it stands", "kill:base", [], RESTS, ""),
        ("it drives as soon as it is back", "kill:base", [], DRIVES, "b"),
        ("it was ended in another way", "end:base", [], DRIVES, "b"),
        ("all was released", "kill:base", [(1.5, RELEASED), (2.0, DRIVE)], DRIVES, ""),
        ("it was not ended", "stop:base", [], DRIVES, ""),
    ],
)
def test_a_base_that_was_restarted_under_a_held_stick_waits(about, fault, hands, back, letters):
    stream = [Event(at_s, HANDS, shows) for at_s, shows in [(0.0, DRIVE), *hands]]
    stream += [Event(1.0, BEGINS, fault), Event(1.5, ENDS, fault)]
    stream += odometry(0.0, 1.0, DRIVES) + odometry(2.5, 3.5, back)
    assert "".join(violation.invariant for violation in Trial(stream).violations) == letters, about


@pytest.mark.parametrize(("sees_truth", "gap_s", "late"), [
    (False, 0.12, False), (False, 0.18, True), (True, 0.04, False), (True, 0.1, True),
])  # fmt: skip
def test_a_gap_in_what_wheels_do_may_be_the_machine(sees_truth, gap_s, late):
    stream = odometry(0.0, 1.0, DRIVES) + odometry(1.0 + gap_s, 2.0, RESTS)
    assert Trial(stream, sees_truth).was_late == late


@pytest.mark.parametrize(
    ("about", "fault", "rests_s", "then", "letters"),
    [
        ("the firmware stops the wheels", "kill:base", 1.6, RESTS, ""),
        ("nothing does", "kill:base", 2.0, RESTS, "d"),
        ("they drive on under a held stick", "kill:base", 1.6, DRIVES, "b"),
        ("the cable is in again", "unplug:cable", 1.6, DRIVES, ""),
        ("the cable is out, and nothing stops them", "unplug:cable", 2.0, RESTS, "d"),
    ],
)
def test_wheels_that_are_seen_without_their_base_are_judged_too(
    about, fault, rests_s, then, letters
):
    stream = [Event(0.0, HANDS, DRIVE), Event(1.0, BEGINS, fault), Event(2.5, ENDS, fault)]
    stream += odometry(0.0, rests_s, DRIVES) + odometry(rests_s, 3.0, RESTS)
    stream += odometry(3.0, 3.5, then)
    trial = Trial(stream, sees_truth=True)
    assert "".join(violation.invariant for violation in trial.violations) == letters, about
