"""The bytes between a Kobuki and its driver, worked out by hand from the protocol's appendix."""

import random
from functools import reduce
from math import inf, nan
from operator import xor

import pytest
from kobuki_msgs.msg import ControllerInfo, DigitalOutput, ExternalPower, Led, Sound

from kobuki_protocol import commands, robot_packets
from kobuki_protocol.base_control import base_control, control_values, velocity_of
from kobuki_protocol.command_messages import CommandEncoder
from kobuki_protocol.feedback import (
    Cliff,
    Core,
    Current,
    DockInfrared,
    Feedback,
    Inertia,
    Inputs,
    RawGyro,
)
from kobuki_protocol.framing import Framer
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId
from tutorial_testing.claims import claim

pytestmark = claim(
    "The bytes for and from a Kobuki are those of its protocol; each velocity, packet and event "
    "comes back as it was sent"
)
RUNS = 10_000


@pytest.mark.parametrize(("velocity", "values"), [
    ((0.3, 0.0), [300, 0, 300, 0]),
    ((0.3, 0.00005), [300, 0, 300, 0]),  # straight on
    ((0.3, 0.5), [357, 600, 300, 500]),  # the outer wheel at 357.5 mm/s
    ((0.3, -0.5), [357, -600, 300, -500]),
    ((-0.3, 0.5), [-357, -600, -300, 500]),
    ((0.0, 0.5), [57, 1, 0, 500]),  # on the spot
    ((0.0, -0.5), [-57, 1, 0, -500]),
    ((0.0005, 0.5), [57, 1, 0, 500]),  # a radius of 1 mm means on the spot
    ((50.0, 0.0), [32767, 0, 32767, 0]),  # limited to 16 bits
    ((-50.0, 0.0), [-32768, 0, -32768, 0]),
])  # fmt: skip
def test_a_velocity_is_sent_as_speed_and_radius(velocity, values):
    assert control_values(*velocity) == values


@pytest.mark.parametrize("velocity", [(nan, 0.0), (0.0, inf), (-inf, 1.0)])
def test_what_is_no_velocity_is_refused(velocity):
    with pytest.raises(ValueError, match="is not a velocity"):
        base_control(*velocity)


def test_a_kobuki_drives_what_was_commanded():
    """Except for what the protocol rounds off: 1 mm/s, and 1 mm of the radius, or 2 mm at 1."""
    values = random.Random(60)
    for _ in range(RUNS):
        v, w = values.uniform(-0.7, 0.7), values.uniform(-3.0, 3.0)
        driven_v, driven_w = velocity_of(base_control(v, w))
        assert (driven_v, driven_w) == pytest.approx((v, w), abs=0.06)
        assert driven_v == pytest.approx(v, abs=0.0052)
    assert velocity_of(commands.BaseControl(-57, 1)) == pytest.approx((0.0, -0.4957), abs=1e-4)
    assert velocity_of(commands.BaseControl(-300, 0)) == (-0.3, 0.0)


COMMANDS = [
    (commands.BaseControl(0, 0), "aa 55 06 01 04 00 00 00 00 03"),
    (commands.BaseControl(100, 0), "aa 55 06 01 04 64 00 00 00 67"),
    (commands.BaseControl(-100, 0), "aa 55 06 01 04 9c ff 00 00 60"),
    (commands.BaseControl(357, -600), "aa 55 06 01 04 65 01 a8 fd 32"),
    (commands.Sound(0x1234, 100), "aa 55 05 03 03 34 12 64 47"),
    (commands.SoundSequence(6), "aa 55 03 04 01 06 00"),
    (commands.IdentityRequest(), "aa 55 04 09 02 0b 00 04"),
    (commands.Outputs(), "aa 55 04 0c 02 f0 00 fa"),
    (commands.SetController.of(1, (100, 0.1, 2)),
     "aa 55 0f 0d 0d 01 a0 86 01 00 64 00 00 00 d0 07 00 00 9a"),
    (commands.GetController(), "aa 55 03 0e 01 00 0c"),
]  # fmt: skip


@pytest.mark.parametrize(("command", "data"), COMMANDS)
def test_the_bytes_of_a_command(command, data):
    packet = commands.build(command)
    assert packet.hex(" ") == data
    assert reduce(xor, packet[2:]) == 0
    assert [commands.parse(payload) for payload in Framer().feed(packet)] == [[command]]


PARTS = [
    (Core(1000, 4, 2, 1, 65535, 256, -100, 100, 5, 22, 164, 3),
     "01 0f e8 03 04 02 01 ff ff 00 01 9c 64 05 16 a4 03"),
    (DockInfrared(1, 2, 32), "03 03 01 02 20"),
    (Inertia(-9000, 5730), "04 07 d8 dc 62 16 00 00 00"),
    (Cliff(1500, 0, 4095), "05 06 dc 05 00 00 ff 0f"),
    (Current(6, 7), "06 02 06 07"),
    (RawGyro(1, ((0, 0, 0), (1309, -654, -1964))),
     "0d 0e 01 06 00 00 00 00 00 00 1d 05 72 fd 54 f8"),
    (Inputs(5, (1, 2, 3, 4095)), "10 10 05 00 01 00 02 00 03 00 ff 0f 00 00 00 00 00 00"),
    (HardwareVersion(4, 0, 1), "0a 04 04 00 01 00"),
    (FirmwareVersion(0, 2, 1), "0b 04 00 02 01 00"),
    (UniqueId((1, 2, 0xFFFFFFFF)), "13 0c 01 00 00 00 02 00 00 00 ff ff ff ff"),
    (Controller(), "15 0d 00 a0 86 01 00 64 00 00 00 d0 07 00 00"),
]  # fmt: skip


@pytest.mark.parametrize(("part", "data"), PARTS)
def test_the_bytes_of_a_part(part, data):
    packet = robot_packets.build(part)
    assert packet[3:-1].hex(" ") == data
    assert robot_packets.parse(packet[3:-1]) == [part]


def test_all_random_values_come_back():
    values = random.Random(1)
    for _ in range(RUNS):
        parts = random_parts(values)
        (payload,) = Framer().feed(robot_packets.build(*parts))
        assert robot_packets.parse(payload) == parts
        command = commands.BaseControl(values.randrange(-32768, 32768), values.randrange(-99, 99))
        outputs = commands.Outputs(values.getrandbits(12))
        (payload,) = Framer().feed(commands.build(command, outputs))
        assert commands.parse(payload) == [command, outputs]


def random_parts(values):
    bits, word = values.getrandbits, lambda: values.randrange(-32768, 32768)
    core = Core(bits(16), *(bits(8) for _ in "123"), bits(16), bits(16), *(-bits(7), bits(7)),
                *(bits(8) for _ in "1234"))  # fmt: skip
    readings = tuple((word(), word(), word()) for _ in range(values.randrange(4)))
    return [
        core,
        DockInfrared(bits(8), bits(8), bits(8)),
        Inertia(word(), word()),
        Cliff(bits(12), bits(12), bits(12)),
        Current(bits(8), bits(8)),
        RawGyro(bits(8), readings),
        Inputs(bits(16), tuple(bits(12) for _ in "1234")),
        UniqueId((bits(32), bits(32), bits(32))),
        Controller(bits(1), (bits(32), bits(32), bits(32))),
    ]


def test_what_a_newer_firmware_adds_is_left_out():
    payload = bytes([1, 1, 0, 99, 2, 7, 7]) + bytes.fromhex("06 02 06 07")
    assert robot_packets.parse(payload) == [Current(6, 7)]  # a core of one byte is invalid


def test_a_part_that_does_not_come_stays_as_it_was():
    feedback = Feedback(core=Core(time_stamp=1)).updated([Current(1, 2), Controller()])
    assert feedback == Feedback(core=Core(time_stamp=1), current=Current(1, 2))


def test_the_gyro_is_mounted_turned():
    gyro = RawGyro.of(257, [(0.0, 0.0, 0.0), (0.1, 0.2, -0.3)])
    assert gyro == RawGyro(1, ((0, 0, 0), (1309, -654, -1964)))  # sensor x = robot y, y = -x
    assert gyro.rates[1] == pytest.approx((0.1, 0.2, -0.3), abs=2e-4)


def test_outputs_share_their_bits():
    outputs = commands.Outputs()
    outputs = outputs.with_led(1, 1)
    assert outputs.bits == 0x02F0  # green; the supplies are on
    outputs = outputs.with_led(2, 2)
    assert (outputs.bits, outputs.leds) == (0x0EF0, (1, 2))  # orange: both
    outputs = outputs.with_led(1, 3)
    assert outputs.bits == 0x0DF0  # red
    outputs = outputs.with_led(2, 0)
    assert (outputs.bits, outputs.leds) == (0x01F0, (3, 0))
    outputs = outputs.with_pins([True, True, False, True], [True, False, False, True])
    assert outputs.bits == 0x01F9
    outputs = outputs.with_pins([False] * 4, [True, False, False, False])
    assert outputs.bits == 0x01F8
    assert outputs.with_power(1, 0).bits == 0x01D8
    assert outputs.with_power(1, 1).bits == 0x01F8


@pytest.mark.parametrize(("make", "arguments", "part"), [
    (commands.Outputs().with_led, (1, 4), "led1: 4: must be 0 to 3"),
    (commands.Outputs().with_power, (4, 1), "source 4"),
    (commands.Outputs().with_power, (0, 2), "state 2"),
    (commands.SoundSequence.of, (7,), "sound 7"),
    (commands.SetController.of, (1, (1.0, -0.1, 0.0)), "gain"),
    (commands.SetController.of, (1, (inf, 0.0, 0.0)), "gain"),
    (commands.SetController.of, (2, (1.0, 0.1, 0.0)), "type 2"),
])  # fmt: skip
def test_a_command_that_the_kobuki_has_not_is_refused(make, arguments, part):
    with pytest.raises(ValueError, match=part):
        make(*arguments)


def test_messages_become_commands():
    encoder = CommandEncoder()
    assert encoder.command("sound", Sound(3)) == commands.SoundSequence(3)
    assert encoder.command("led2", Led(Led.GREEN)) == commands.Outputs(0x08F0)
    assert encoder.command("external_power", ExternalPower(0, 0)) == commands.Outputs(0x08E0)
    pins = DigitalOutput([True] * 4, [False, True, False, False])
    assert encoder.command("digital_output", pins) == commands.Outputs(0x08E2)
    gains = encoder.command("controller_info", ControllerInfo(1, 50.0, 0.2, 1.0))
    assert gains.wanted == Controller(1, (50_000, 200, 1_000))


def test_a_firmware_of_another_major_version_is_not_driven():
    versions = [FirmwareVersion(0, 2, 1), FirmwareVersion(3, 1, 1), FirmwareVersion(0, 0, 2)]
    assert [str(version) for version in versions] == ["1.2.0", "1.1.3", "2.0.0"]
    assert [version.is_supported for version in versions] == [True, True, False]
    assert [version.is_recommended for version in versions] == [True, False, False]


@pytest.mark.parametrize(("data", "version"), [("7b00", "1.0.0"), ("7527", "1.1.1")])
def test_the_first_firmware_wrote_its_version_in_two_bytes(data, version):
    assert str(FirmwareVersion.parse(bytes.fromhex(data))) == version
