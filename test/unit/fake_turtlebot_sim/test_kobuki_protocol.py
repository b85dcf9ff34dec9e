"""The bytes between a Kobuki and its driver, worked out by hand from the protocol's appendix."""

from functools import reduce
from math import inf
from operator import xor

import pytest
from kobuki_msgs.msg import SensorState

from fake_turtlebot_sim.kobuki_protocol import commands, packets


@pytest.mark.parametrize(
    ("velocity", "values"),
    [
        ((0.3, 0.0), [300, 0, 300, 0]),
        ((0.3, 0.00005), [300, 0, 300, 0]),  # straight on
        ((0.3, 0.5), [357, 600, 300, 500]),  # the outer wheel at 357.5 mm/s
        ((0.3, -0.5), [357, -600, 300, -500]),
        ((-0.3, 0.5), [-357, -600, -300, 500]),
        ((0.0, 0.5), [57, 1, 0, 500]),  # on the spot
        ((0.0, -0.5), [-57, 1, 0, -500]),
        ((0.0005, 0.5), [57, 1, 0, 500]),  # a radius of 1 mm is one on the spot
        ((50.0, 0.0), [32767, 0, 32767, 0]),  # cut to 16 bits
        ((-50.0, 0.0), [-32768, 0, -32768, 0]),
    ],
)
def test_a_velocity_is_sent_as_speed_and_radius(velocity, values):
    assert commands.control_values(*velocity) == values


@pytest.mark.parametrize(
    ("packet", "data"),
    [
        (commands.base_control(0.0, 0.0), "aa 55 06 01 04 00 00 00 00 03"),
        (commands.base_control(0.1, 0.0), "aa 55 06 01 04 64 00 00 00 67"),
        (commands.base_control(-0.1, 0.0), "aa 55 06 01 04 9c ff 00 00 60"),
        (commands.sound(6), "aa 55 03 04 01 06 00"),
        (commands.controller(1, (100, 0.1, 2)),
         "aa 55 0f 0d 0d 01 a0 86 01 00 64 00 00 00 d0 07 00 00 9a"),
    ],
)  # fmt: skip
def test_the_bytes_of_a_command(packet, data):
    assert packet.hex(" ") == data
    assert reduce(xor, packet[2:]) == 0


def test_outputs_share_their_bits():
    outputs = commands.Outputs()
    bits = lambda packet: int.from_bytes(packet[5:7], "little")  # noqa: E731
    assert bits(outputs.led(1, 1)) == 0x02F0  # green; the supplies are on
    assert bits(outputs.led(2, 2)) == 0x0EF0  # orange: both
    assert bits(outputs.led(1, 3)) == 0x0DF0  # red
    assert bits(outputs.led(2, 0)) == 0x01F0
    assert bits(outputs.digital([True, True, False, True], [True, False, False, True])) == 0x01F9
    assert bits(outputs.digital([False] * 4, [True, False, False, False])) == 0x01F8
    assert bits(outputs.power(1, 0)) == 0x01D8
    assert bits(outputs.power(1, 1)) == 0x01F8


@pytest.mark.parametrize(
    ("encode", "arguments", "part"),
    [
        (commands.Outputs().led, (1, 4), "led1: 4: there are 0 to 3"),
        (commands.Outputs().power, (4, 1), "source 4"),
        (commands.Outputs().power, (0, 2), "state 2"),
        (commands.sound, (7,), "sound 7"),
        (commands.controller, (1, (1.0, -0.1, 0.0)), "gain"),
        (commands.controller, (1, (inf, 0.0, 0.0)), "gain"),
    ],
)
def test_a_command_that_the_kobuki_has_not_is_refused(encode, arguments, part):
    with pytest.raises(ValueError, match=part):
        encode(*arguments)


def test_the_raw_gyro_is_mounted_turned():
    part = packets.raw_gyro(257, [(0.0, 0.0, 0.0), (0.1, 0.2, -0.3)])
    assert part[:4] == bytes([13, 14, 1, 6])
    digits = [int.from_bytes(part[k : k + 2], "little", signed=True) for k in range(10, 16, 2)]
    assert digits == [1309, -654, -1964]  # sensor x = robot y, y = -x


def test_the_inputs_have_four_analog_values():
    assert packets.inputs(5, (1, 2, 3, 4095))[:12].hex(" ") == "10 10 05 00 01 00 02 00 03 00 ff 0f"


def test_the_motors_voltages_are_signed():
    state = SensorState(left_pwm=-100, right_pwm=100)
    assert packets.core(state)[-6:].hex(" ") == "9c 64 00 00 00 00"
