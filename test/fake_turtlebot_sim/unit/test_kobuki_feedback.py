"""A Kobuki's reports, worked out by hand from its protocol."""

import struct
from math import pi

import pytest

from fake_turtlebot_sim.simulator import kobuki_feedback as kobuki
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.sensors import Sensed
from fake_turtlebot_sim.simulator.simulated_robot import CommandResult, SimulatedRobot
from kobuki_protocol import messages, robot_packets
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("Encoders, bits, voltage and motor power are those of a Kobuki")
SECOND = 1_000_000_000
TICKS_PER_M = 11724.4  # 11.7244 ticks/mm


def robot(cmd_vel_timeout=60.0):
    return SimulatedRobot(SimulatorParameters(cmd_vel_timeout=cmd_vel_timeout))


def packet(one, now_ns=0, pressed=(False, False, False)):
    one.advance(now_ns)
    return messages.sensor_state(kobuki.sensors(now_ns, one, pressed), None)


@pytest.mark.parametrize(("velocity", "seconds", "left_m", "right_m", "voltage"), [
    ((0.7, 0.0), 10, 7.0, 7.0, (100, 100)),  # 82071 ticks: beyond 16 bits
    ((-0.35, 0.0), 1, -0.35, -0.35, (-50, -50)),  # backwards through zero
    ((0.0, pi), 2, -0.23 * pi, 0.23 * pi, (-52, 52)),
    ((0.0, 0.0), 1, 0.0, 0.0, (0, 0)),
])  # fmt: skip
def test_the_encoders_count_ticks_in_16_bits(velocity, seconds, left_m, right_m, voltage):
    one = robot()
    one.command(velocity, 0)
    state = packet(one, seconds * SECOND)
    for ticks, way_m in ((state.left_encoder, left_m), (state.right_encoder, right_m)):
        assert 0 <= ticks < 65536
        assert abs((ticks - way_m * TICKS_PER_M + 32768) % 65536 - 32768) <= 1.5
    assert (state.left_pwm, state.right_pwm) == voltage
    assert all((current > 0) == any(velocity) for current in state.current)


@pytest.mark.parametrize("reset", [SimulatedRobot.reset_odometry, SimulatedRobot.reset])
def test_the_encoders_go_on_where_the_odometry_is_reset(reset):
    one = robot()
    one.command((0.5, 1.0), 0)
    before = packet(one, SECOND).left_encoder
    reset(one)
    assert (one.state()[5:7], packet(one, SECOND).left_encoder) == ((0.0, 0.0), before)


def test_the_time_stamp_wraps_at_16_bits():
    one = robot()
    assert [packet(one, ms * 1_000_000).time_stamp for ms in (65535, 65536)] == [65535, 0]


def test_bits_are_those_of_the_protocol(monkeypatch):
    one = robot()
    sensed = Sensed((True, False, False), (False, True, True), (False, True))
    monkeypatch.setattr(one, "sensed", lambda: sensed)
    state = packet(one, pressed=(True, False, True))
    assert state.bumper == state.BUMPER_LEFT
    assert state.cliff == state.CLIFF_CENTRE | state.CLIFF_RIGHT
    assert state.wheel_drop == state.WHEEL_DROP_RIGHT
    assert state.buttons == state.BUTTON0 | state.BUTTON2
    right, center, left = state.bottom
    assert right == center < left  # the farther the ground, the less
    assert (state.charger, state.battery) == (state.DISCHARGING, 164)


def test_the_stream_has_the_parts_of_a_real_packet():
    """77 bytes of payload, as in the example of kobuki_driver's appendix."""
    one = robot()
    one.command((0.5, 1.0), 0)
    state = packet(one, 100_000_000)
    sensed = kobuki.sensors(100_000_000, one, [False] * 3)
    feedback = kobuki.with_gyro(sensed, pi / 2, -1.0, (0.5, 1.0))
    data = robot_packets.build(*feedback.parts())
    assert (len(data), data[:3]) == (81, b"\xaa\x55\x4d")
    parts, rest = {}, data[3:-1]
    while rest:
        parts[rest[0]] = rest[2 : 2 + rest[1]]
        rest = rest[2 + rest[1] :]
    lengths = {1: 15, 3: 3, 4: 7, 5: 6, 6: 2, 13: 14, 16: 16}
    assert {number: len(part) for number, part in parts.items()} == lengths
    head, tail = struct.unpack("<H3B2H", parts[1][:9]), struct.unpack("<2b4B", parts[1][9:])
    assert head == (100, 0, 0, 0, state.left_encoder, state.right_encoder)
    assert tail == (state.left_pwm, state.right_pwm, 0, 0, 164, 0)
    assert struct.unpack("<2h", parts[4][:4]) == (9000, -5730)  # [0.01 deg, 0.01 deg/s]
    assert parts[5] == struct.pack("<3H", 1500, 1500, 1500)
    frame, count, *digits = struct.unpack("<2B6h", parts[13])
    assert (frame, count) == (10, 6)
    assert digits == [0, 0, 3274, 0, 0, 6548]  # Two readings [0.00875 deg/s].


def test_without_power_a_robot_stands_and_with_it_waits_for_a_new_command():
    one = robot()
    one.command((0.5, 0.0), 0)
    one.switch_motors(False, SECOND)
    assert one.command((0.5, 0.0), 2 * SECOND) is CommandResult.POWERLESS
    one.advance(3 * SECOND)
    assert (one.state().x, one.is_moving) == (0.5, False)
    one.switch_motors(True, 4 * SECOND)
    one.advance(5 * SECOND)
    assert one.state().x == 0.5
    assert one.command((0.5, 0.0), 5 * SECOND) is CommandResult.ACCEPTED
    one.advance(6 * SECOND)
    assert one.state().x == 1.0


def test_the_page_has_the_stop_of_this_robot_and_that_of_a_kobuki():
    """kobuki_node stops 0.62 to 0.70 s after the last command, measured on a serial line."""
    one = robot(SimulatorParameters().cmd_vel_timeout)
    one.command((0.7, 0.0), 0)
    one.advance(2 * SECOND)
    page = " ".join((REPOSITORY / "fake_turtlebot_sim/README.md").read_text().split())
    assert f"exactly 0.6 s after the last command: {one.state().x:.3f} m at 0.7 m/s" in page
    assert f"stops after 0.62 to 0.70 s: up to {0.70 * 0.7:.2f} m" in page
