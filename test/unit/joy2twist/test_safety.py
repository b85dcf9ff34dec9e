"""When to send a velocity, when zero and when nothing. Times in seconds, as they would pass."""

import pytest

from joy_to_twist.parameters import load
from joy_to_twist.safety import ARMED, BAD_MESSAGE, DRIVING, NOT_ARMED, WAITING, Safety
from node_kit.arming import ZERO
from tutorial_testing.over_time import over_time

FORWARD = (0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
BACKWARD = (-0.5, 0.0, 0.0, 0.0, 0.0, 0.0)
DEAD_MAN = {"enable_button": 4}
LIMITS = {"max_linear_acceleration": 1.0, "output_rate": 10.0}  # 0.1 m/s in each period


def safety(**given):
    return Safety(load(given), wake=lambda: None)


class TestWithoutDeadMan:
    def test_every_message_is_answered_by_one_velocity(self):
        machine = safety()
        assert machine.state == WAITING
        for i in range(100):
            assert machine.drive(FORWARD, False, i * 0.02) == FORWARD
            assert over_time(machine, i * 0.02, i * 0.02 + 0.02) == []
        assert machine.state == DRIVING

    def test_a_bad_message_is_answered_by_one_zero(self):
        machine = safety()
        machine.drive(FORWARD, False, 0.0)
        assert machine.reject(0.02) == ZERO
        assert machine.state == BAD_MESSAGE
        assert over_time(machine, 0.02, 0.4) == []
        assert machine.drive(FORWARD, False, 0.4) == FORWARD


class TestWatchdog:
    def test_silence_gives_zero_five_times_and_then_nothing(self):
        machine = safety()
        machine.drive(FORWARD, False, 0.0)
        assert machine.due == 0.5
        assert over_time(machine, 0.0, 10.0) == [
            (t, ZERO) for t in (0.5, 0.55, 0.6, 0.65, 0.7)
        ]  # fmt: skip
        assert machine.state == "stopped: no message for 0.5 s"
        assert machine.due == float("inf")

    def test_a_robot_that_stands_is_not_told_to_stop(self):
        machine = safety()
        machine.drive(ZERO, True, 0.0)
        assert over_time(machine, 0.0, 10.0) == []

    def test_one_that_drives_backward_is(self):
        machine = safety(stop_messages=1)
        machine.drive(BACKWARD, False, 0.0)
        assert over_time(machine, 0.0, 10.0) == [(0.5, ZERO)]

    def test_every_message_starts_the_time_anew(self):
        machine = safety(joy_timeout=0.3)
        machine.drive(FORWARD, False, 0.0)
        machine.drive(FORWARD, False, 0.25)
        assert over_time(machine, 0.25, 10.0)[0] == (0.55, ZERO)

    def test_a_bad_message_does_not(self):
        machine = safety()
        machine.drive(FORWARD, False, 0.0)
        machine.reject(0.4)
        over_time(machine, 0.4, 0.6)
        assert machine.state == "stopped: no message for 0.5 s"

    def test_zero_turns_it_off(self):
        machine = safety(joy_timeout=0)
        machine.drive(FORWARD, False, 0.0)
        assert machine.due == float("inf")
        assert over_time(machine, 0.0, 100.0, step=1.0) == []

    def test_a_publisher_that_left_is_silence(self):
        machine = safety(joy_timeout=0, stop_messages=1)
        assert machine.lost("left", 0.0) is None  # none was there yet
        machine.drive(FORWARD, False, 1.0)
        assert machine.lost("left", 1.1) == ZERO
        assert machine.lost("left", 1.2) is None
        assert machine.state == "stopped: left"

    def test_the_next_message_drives_again(self):
        machine = safety()
        machine.drive(FORWARD, False, 0.0)
        assert machine.tick(0.5) == ZERO
        assert machine.drive(FORWARD, False, 0.51) == FORWARD
        assert over_time(machine, 0.51, 1.0) == []  # the repeated zeros are off


class TestDeadMan:
    def test_release_gives_zero_a_few_times_and_then_silence(self):
        machine = safety(**DEAD_MAN, stop_messages=3, output_rate=10)
        machine.drive(FORWARD, False, 0.0)
        assert machine.drive(None, True, 0.02) == ZERO
        assert machine.state == ARMED
        sent = []
        for i in range(2, 100):
            sent += over_time(machine, i * 0.02, i * 0.02 + 0.02)
            assert machine.drive(None, True, i * 0.02 + 0.02) is None
        assert sent == [(0.12, ZERO), (0.22, ZERO)]

    def test_every_release_stops_anew(self):
        machine = safety(**DEAD_MAN, stop_messages=2)
        for start in (0.0, 1.0, 1.2):
            assert machine.drive(FORWARD, False, start) == FORWARD
            assert machine.drive(None, False, start + 0.01) == ZERO
            assert over_time(machine, start + 0.01, start + 0.1) == [
                (pytest.approx(start + 0.06), ZERO)
            ]

    def test_driving_again_ends_the_zeros(self):
        machine = safety(**DEAD_MAN)
        machine.drive(FORWARD, False, 0.0)
        machine.drive(None, True, 0.02)
        assert machine.drive(FORWARD, False, 0.03) == FORWARD
        assert over_time(machine, 0.03, 0.5) == []

    def test_the_first_message_with_it_released_gives_zero_too(self):
        machine = safety(**DEAD_MAN)
        assert machine.drive(None, True, 0.0) == ZERO

    def test_a_bad_message_gives_the_same_zeros(self):
        machine = safety(**DEAD_MAN)
        machine.drive(FORWARD, False, 0.0)
        assert machine.reject(0.02) == ZERO
        assert machine.reject(0.03) is None
        assert len(over_time(machine, 0.03, 0.5)) == 4


class TestArming:
    def test_nothing_moves_before_dead_man_and_sticks_were_released(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True, stop_messages=1)
        assert machine.drive(FORWARD, False, 0.0) == ZERO
        assert machine.state == NOT_ARMED
        assert machine.drive(None, False, 0.2) is None  # the stick is not released
        assert machine.drive(None, True, 0.3) is None
        assert machine.state == ARMED
        assert machine.drive(FORWARD, False, 0.4) == FORWARD

    def test_without_a_dead_man_the_sticks_are_enough(self):
        machine = safety(arm_on_neutral=True)
        assert machine.drive(FORWARD, False, 0.0) == ZERO
        assert machine.drive(FORWARD, False, 0.1) == ZERO
        assert machine.drive(ZERO, True, 0.2) == ZERO
        assert machine.drive(FORWARD, False, 0.3) == FORWARD

    @pytest.mark.parametrize("leaves", [True, False])
    def test_silence_disarms(self, leaves):
        machine = safety(arm_on_neutral=True)
        machine.drive(ZERO, True, 0.0)
        machine.drive(FORWARD, False, 0.1)
        assert (machine.lost("left", 0.6) if leaves else machine.tick(0.6)) == ZERO
        assert machine.drive(FORWARD, False, 0.61) == ZERO
        machine.drive(ZERO, True, 0.62)
        assert machine.drive(FORWARD, False, 0.63) == FORWARD

    def test_another_sender_must_be_seen_released_itself(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True, stop_messages=1)
        machine.drive(None, True, 0.0, "ada")
        assert machine.drive(FORWARD, False, 0.1, "bob") is None  # the robot stands already
        assert machine.state == NOT_ARMED
        assert machine.drive(FORWARD, False, 0.2, "bob") is None
        assert machine.drive(None, True, 0.3, "bob") is None
        assert machine.drive(FORWARD, False, 0.4, "bob") == FORWARD

    def test_another_sender_stops_the_robot_that_the_first_one_drives(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True)
        machine.drive(None, True, 0.0, "ada")
        assert machine.drive(FORWARD, False, 0.1, "ada") == FORWARD
        assert machine.drive(FORWARD, False, 0.15, "bob") == ZERO
        assert machine.drive(FORWARD, False, 0.2, "ada") is None
        assert machine.state == NOT_ARMED

    def test_two_that_send_in_turn_are_named_now_and_then(self):
        warnings = []
        machine = Safety(load({**DEAD_MAN, "arm_on_neutral": True}), lambda: None, warnings.append)
        for i in range(200):
            machine.drive(None, True, i * 0.02, "ada" if i % 2 else "bob")
        assert len(warnings) == 1
        assert "Two joystick nodes" in warnings[0]

    def test_two_senders_that_look_alike_are_two(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True)
        ada, bob = ["joystick"], ["joystick"]
        machine.drive(None, True, 0.0, ada)
        assert machine.drive(FORWARD, False, 0.1, bob) is None

    def test_without_arming_every_sender_drives(self):
        machine = safety()
        assert machine.drive(FORWARD, False, 0.0, "ada") == FORWARD
        assert machine.drive(FORWARD, False, 0.1, "bob") == FORWARD

    def test_what_is_released_frees_a_robot_that_was_lost(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True)
        for velocity, neutral, now, released in (
            (None, True, 0.0, True),
            (FORWARD, False, 0.1, False),
            (None, False, 0.3, False),
            (None, True, 0.4, True),
        ):
            machine.drive(velocity, neutral, now)
            assert machine.released is released, now
        machine.reject(0.45)
        assert not machine.released
        machine.drive(None, True, 0.5)
        machine.lost("left", 0.6)
        assert not machine.released

    def test_without_arming_a_stop_frees_a_robot_that_was_lost(self):
        machine = safety(**DEAD_MAN)
        machine.drive(FORWARD, False, 0.0)
        assert not machine.released
        machine.drive(BACKWARD, False, 0.05)
        assert not machine.released
        machine.drive(None, False, 0.1)
        assert machine.released


class TestLateMessages:
    """The time has passed, but nobody called tick(): this node was suspended, or very busy."""

    @pytest.mark.parametrize("late", [0.6, 100.1])
    def test_with_arming_a_late_message_does_not_drive(self, late):
        machine = safety(**DEAD_MAN, arm_on_neutral=True, stop_messages=1)
        machine.drive(None, True, 0.0)
        assert machine.drive(FORWARD, False, 0.1) == FORWARD
        assert machine.drive(FORWARD, False, late) == ZERO
        assert machine.drive(FORWARD, False, late + 0.02) is None
        machine.drive(None, True, late + 0.04)
        assert machine.drive(FORWARD, False, late + 0.06) == FORWARD

    def test_without_arming_a_stop_comes_first(self):
        machine = safety()
        machine.drive(FORWARD, False, 0.1)
        assert machine.drive(FORWARD, False, 100.1) == ZERO
        assert machine.drive(FORWARD, False, 100.12) == FORWARD

    def test_a_robot_that_stands_needs_no_stop_before(self):
        machine = safety()
        machine.drive(ZERO, True, 0.1)
        assert machine.drive(FORWARD, False, 100.1) == FORWARD

    def test_a_message_just_in_time_drives(self):
        machine = safety(**DEAD_MAN, arm_on_neutral=True)
        machine.drive(None, True, 0.0)
        machine.drive(FORWARD, False, 0.1)
        assert machine.drive(FORWARD, False, 0.599) == FORWARD

    def test_without_a_timeout_nothing_is_late(self):
        machine = safety(joy_timeout=0)
        machine.drive(FORWARD, False, 0.0)
        assert machine.drive(FORWARD, False, 1000.0) == FORWARD


class TestAccelerationLimits:
    def speeds(self, sent):
        return [(t, round(velocity[0], 6)) for t, velocity in sent]

    def hold(self, machine, velocity, start, end):
        """A message every 0.05 s. What drive() and tick() send."""
        sent = []
        for i in range(round((end - start) / 0.05)):
            now = start + i * 0.05
            answer = machine.drive(velocity, False, now)
            sent += [] if answer is None else [(round(now, 6), answer)]
            sent += over_time(machine, now, now + 0.05 - 1e-6)
        return self.speeds(sent)

    def test_speed_comes_at_a_steady_rate_and_goes_with_the_stick(self):
        machine = safety(**LIMITS)
        assert self.hold(machine, (0.25, 0, 0, 0, 0, 0), 0.0, 0.4) == [
            (0.0, 0.1), (0.1, 0.2), (0.2, 0.25), (0.3, 0.25),
        ]  # fmt: skip
        # Released: soft, and at zero it is one velocity for every message again.
        assert self.hold(machine, ZERO, 0.4, 0.8) == [
            (0.4, 0.15), (0.5, 0.05), (0.6, 0.0), (0.65, 0.0), (0.7, 0.0), (0.75, 0.0),
        ]  # fmt: skip

    def test_an_angular_limit_alone_lets_it_drive_forward_at_once(self):
        machine = safety(max_angular_acceleration=2.0, output_rate=10.0)
        assert machine.drive((0.5, 0, 0, 0, 0, 1.0), False, 0.0) == (0.5, 0, 0, 0, 0, 0.2)
        assert machine.tick(0.1) == (0.5, 0, 0, 0, 0, pytest.approx(0.4))

    def test_backward_is_as_gradual_and_goes_with_the_stick(self):
        machine = safety(max_linear_acceleration=0.5, output_rate=10.0)
        assert self.hold(machine, (-0.1, 0, 0, 0, 0, 0), 0.0, 0.4) == [
            (0.0, -0.05), (0.1, -0.1), (0.2, -0.1), (0.3, -0.1),
        ]  # fmt: skip
        assert self.hold(machine, ZERO, 0.4, 0.7) == [
            (0.4, -0.05), (0.5, 0.0), (0.55, 0.0), (0.6, 0.0), (0.65, 0.0),
        ]  # fmt: skip

    def test_a_small_angular_limit_alone_counts(self):
        machine = safety(max_angular_acceleration=0.5, output_rate=10.0)
        turn = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        assert machine.drive(turn, False, 0.0)[5] == pytest.approx(0.05)

    def test_each_part_has_a_limit_of_its_own(self):
        machine = safety(**LIMITS, max_angular_acceleration=2.0)
        machine.drive((0.5, 0, 0, 0, 0, 1.0), False, 0.0)
        assert machine.tick(0.1) == pytest.approx((0.2, 0, 0, 0, 0, 0.4))

    def test_dead_man_stops_hard(self):
        machine = safety(**DEAD_MAN, **LIMITS, stop_messages=2)
        self.hold(machine, FORWARD, 0.0, 1.0)
        assert machine.drive(None, False, 1.0) == ZERO
        assert over_time(machine, 1.0, 2.0) == [(1.1, ZERO)]

    def test_silence_stops_hard(self):
        machine = safety(**LIMITS, stop_messages=1)
        machine.drive(FORWARD, False, 0.0)
        sent = self.speeds(over_time(machine, 0.0, 2.0))
        assert sent == [(0.1, 0.2), (0.2, 0.3), (0.3, 0.4), (0.4, 0.5), (0.5, 0.0)]

    def test_silence_while_passing_through_zero_stops_for_good(self):
        machine = safety(**LIMITS, stop_messages=1)
        machine.drive((0.1, 0, 0, 0, 0, 0), False, 0.0)
        machine.drive((-0.5, 0, 0, 0, 0, 0), False, 0.05)
        assert self.speeds(over_time(machine, 0.05, 0.15)) == [(0.1, 0.0)]
        assert machine.lost("left", 0.15) == ZERO
        assert over_time(machine, 0.15, 2.0) == []

    def test_a_bad_message_stops_hard_and_ends_the_ramp(self):
        machine = safety(**LIMITS)
        machine.drive(FORWARD, False, 0.0)
        assert machine.reject(0.05) == ZERO
        assert over_time(machine, 0.05, 0.4) == []


def test_wake_is_called_when_something_becomes_due_sooner():
    woken = []
    machine = Safety(load(DEAD_MAN), wake=lambda: woken.append(machine.due))
    machine.drive(FORWARD, False, 0.0)
    assert len(woken) == 1  # the watch over the silence
    machine.drive(FORWARD, False, 0.1)
    assert len(woken) == 1
    machine.drive(None, True, 0.2)
    assert woken[1:] == [pytest.approx(0.25)]
