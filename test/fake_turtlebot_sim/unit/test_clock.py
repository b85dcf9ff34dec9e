"""Time never decreases, and periods never drift."""

from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.clock import MotionClock, PhaseLock
from tutorial_testing.claims import claim

pytestmark = claim("Simulated time may pause, jump and be set back")


def test_a_clock_set_back_stops_motion_for_that_instant_only():
    clock = MotionClock(1000)
    assert [clock.update(reading) for reading in (1010, 500, 520, 1020)] == [10, 10, 30, 530]


def test_time_before_the_first_clock_message_is_no_time():
    clock = MotionClock(0)
    assert [clock.update(reading) for reading in (0, 1_600_000_000, 1_600_000_020)] == [0, 0, 20]


def test_a_clock_set_back_not_as_far_as_the_start_does_so_too():
    lock = PhaseLock(20, 100)
    lock.complete(100)
    lock.complete(500)
    assert lock.complete(300) == 0
    assert lock.deadline_ns == 320


def test_the_same_instant_twice_is_no_clock_set_back():
    lock = PhaseLock(20, 100)
    lock.complete(127)
    assert lock.deadline_ns == 140
    assert lock.complete(127) == 0
    assert lock.deadline_ns == 160  # and not a period after 127


@claim("Odometry, transform and wheels ...", because="the periods")
@given(st.lists(st.integers(0, 1000), min_size=1))
def test_however_late_the_next_deadline_is_ahead_and_in_phase(lateness):
    lock = PhaseLock(20, 100)
    for late_ns in lateness:
        now_ns = lock.deadline_ns + late_ns
        assert lock.complete(now_ns) == late_ns // 20
        assert now_ns < lock.deadline_ns <= now_ns + 20
        assert lock.deadline_ns % 20 == 0
