"""The firmware's side of the serial line: literal bytes in, packets out."""

import pytest

from fake_turtlebot_sim.serial_kobuki.firmware import BOOT_NS, Equipment, Firmware
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from fake_turtlebot_sim.simulator.world import World
from kobuki_protocol import feedback, robot_packets
from kobuki_protocol.framing import Framer
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId
from tutorial_testing.claims import claim

pytestmark = claim(
    "serial_kobuki is a Kobuki's firmware on a pseudo terminal: commands, sensors, answers and "
    "timeout"
)
MS = 1_000_000  # [ns]
STRAIGHT_ON = bytes.fromhex("aa 55 06 01 04 64 00 00 00 67")  # 100 mm/s
ON_THE_SPOT = bytes.fromhex("aa 55 06 01 04 39 00 01 00 3b")  # 57 mm/s of each wheel, to the left
ARC = bytes.fromhex("aa 55 06 01 04 65 01 58 02 3d")  # 357 mm/s on a radius of 600 mm
REQUEST = bytes.fromhex("aa 55 04 09 02 0b 00 04")  # hardware, firmware and unique id
GET_GAINS = bytes.fromhex("aa 55 03 0e 01 00 0c")
SET_GAINS = bytes.fromhex("aa 55 0f 0d 0d 01 a0 86 01 00 64 00 00 00 d0 07 00 00 9a")
OUTPUTS = bytes.fromhex("aa 55 04 0c 02 d1 0e d5")  # pin 0, 5 V off, LED 1 green, LED 2 orange
SOUND = bytes.fromhex("aa 55 03 04 01 06 00")


def kobuki(equipment=Equipment(), **given):  # noqa: B008
    return Firmware(
        SimulatedRobot(SimulatorParameters(**{"cmd_vel_timeout": 0.6, **given})), equipment
    )


def sent(firmware, now_ns):
    """Return the parts of the packet sent at a time."""
    (payload,) = Framer().feed(firmware.feedback(now_ns))
    return robot_packets.parse(payload)


def core(firmware, now_ns):
    return sent(firmware, now_ns)[0]


def test_a_robot_at_rest_sends_these_bytes():
    assert kobuki().feedback(20 * MS).hex(" ") == (
        "aa 55 4d"
        " 01 0f 14 00 00 00 00 00 00 00 00 00 00 00 00 a4 00"
        " 03 03 00 00 00 04 07 00 00 00 00 00 00 00"
        " 05 06 dc 05 dc 05 dc 05 06 02 00 00"
        " 0d 0e 02 06 00 00 00 00 00 00 00 00 00 00 00 00"
        " 10 10 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 29"
    )


@pytest.mark.parametrize(("command", "velocity"), [
    (STRAIGHT_ON, (0.1, 0.0)),
    (ON_THE_SPOT, (0.0, 57 / 115)),
    (ARC, (0.6 * 357 / 715, 357 / 715)),
])  # fmt: skip
def test_a_base_control_drives_until_its_timeout(command, velocity):
    firmware = kobuki()
    firmware.receive(command, 100 * MS)
    firmware.robot.advance(700 * MS - 1)
    assert firmware.robot.target == pytest.approx(velocity)
    assert firmware.robot.advance(700 * MS)
    assert firmware.robot.target == (0.0, 0.0)


def test_the_encoders_count_ticks_of_their_wheels_and_wrap():
    firmware = kobuki(cmd_vel_timeout=0)
    firmware.receive(STRAIGHT_ON, 0)
    assert core(firmware, 1000 * MS).left_encoder == 1172  # 0.1 m by 85.29 um a tick
    firmware.receive(ON_THE_SPOT, 1000 * MS)
    left, right = 1172 - 668, 1172 + 668  # 57 mm in each direction
    turned = core(firmware, 2000 * MS)
    assert (turned.left_encoder, turned.right_encoder) == (left, right)
    assert core(firmware, 4000 * MS).left_encoder == 65536 + 1172 - 3 * 668 - 1


def test_the_gyro_has_the_heading_since_the_start_in_hundredths_of_a_degree():
    firmware = kobuki(cmd_vel_timeout=0)
    firmware.receive(ON_THE_SPOT, 0)
    _, _, inertia, _, _, gyro, _ = sent(firmware, 1000 * MS)
    assert (inertia.angle, inertia.rate) == (2840, 2840)  # 57 / 115 rad
    assert gyro.frame == 100
    assert [z for *_, z in gyro.readings] == [1622, 3245]  # middle and end of the period
    assert sent(firmware, 10_000 * MS)[2].angle == 28399 - 36000


def test_time_stamps_are_milliseconds_and_wrap():
    firmware = kobuki()
    assert core(firmware, 65_535 * MS).time_stamp == 65535
    assert core(firmware, 65_556 * MS).time_stamp == 20


def test_versions_number_and_gains_come_on_request_and_once():
    firmware = kobuki()
    assert firmware.receive(REQUEST + GET_GAINS, 0) == []
    answers = sent(firmware, 20 * MS)[7:]
    versions = [HardwareVersion(4, 0, 1), FirmwareVersion(0, 2, 1), UniqueId((1, 2, 3))]
    assert answers == [*versions, Controller()]
    assert sent(firmware, 40 * MS)[7:] == []


def test_gains_are_taken_and_given_back():
    firmware = kobuki()
    assert firmware.receive(SET_GAINS, 0) == ["gains: own, P 100, I 0.1, D 2"]
    firmware.receive(GET_GAINS, 0)
    assert sent(firmware, 20 * MS)[7:] == [Controller(1, (100_000, 100, 2_000))]


def test_firmware_before_1_2_takes_no_gains():
    firmware = kobuki(Equipment(firmware=FirmwareVersion(4, 1, 1)))
    assert firmware.receive(SET_GAINS, 0) == ["gains: firmware 1.1.4 does not accept any"]


def test_outputs_and_sounds_are_reported_when_they_change():
    firmware = kobuki()
    assert firmware.receive(OUTPUTS, 0) == [
        "digital output 0: on", "power 5 V: off", "LED 1: green", "LED 2: orange",
    ]  # fmt: skip
    assert firmware.receive(OUTPUTS, 0) == []
    assert firmware.receive(SOUND, 0) == ["sound: cleaning end"]


def test_a_command_is_obeyed_once_its_last_byte_is_there():
    firmware = kobuki()
    firmware.receive(STRAIGHT_ON[:-1], 0)
    assert firmware.robot.target == (0.0, 0.0)
    firmware.receive(STRAIGHT_ON[-1:], 0)
    assert firmware.robot.target == (0.1, 0.0)


def test_a_damaged_command_is_not_obeyed_and_the_next_one_is():
    firmware = kobuki()
    damaged = STRAIGHT_ON.replace(b"\x64", b"\x65")
    firmware.receive(damaged, 0)
    assert (firmware.robot.target, firmware.damaged) == ((0.0, 0.0), 1)
    firmware.receive(damaged + STRAIGHT_ON, 0)
    assert firmware.robot.target == (0.1, 0.0)


def test_switched_off_and_on_it_stands_is_silent_for_a_while_and_counts_from_zero():
    firmware = kobuki(cmd_vel_timeout=0)
    firmware.receive(ON_THE_SPOT + OUTPUTS, 0)
    firmware.robot.advance(1000 * MS)
    firmware.switch(True, 1000 * MS)
    assert firmware.robot.target == (0.0, 0.0)
    ready_ns = 1000 * MS + BOOT_NS
    assert firmware.feedback(ready_ns - 1) == b""
    assert firmware.receive(STRAIGHT_ON, ready_ns - 1) == []
    parts = sent(firmware, ready_ns)
    assert (parts[0].time_stamp, parts[0].left_encoder, parts[0].right_encoder) == (0, 0, 0)
    assert parts[2].angle == 0
    assert firmware.receive(OUTPUTS, ready_ns)  # all outputs were reset


def test_switched_off_it_stays_off():
    firmware = kobuki()
    firmware.switch(False, 0)
    assert firmware.feedback(10 * BOOT_NS) == b""


def test_buttons_charger_and_battery_are_in_the_core_packet():
    firmware = kobuki(Equipment(battery=131, charger=22))
    firmware.press(1, True)
    firmware.press(7, True)  # no such button
    now = core(firmware, 0)
    assert (now.buttons, now.battery, now.charger) == (2, 131, 22)
    firmware.press(1, False)
    assert core(firmware, 0).buttons == 0


@pytest.mark.parametrize(("y", "bits"), [(0.0, 2), (0.15, 4), (-0.15, 1)])
def test_a_bumper_is_pressed_where_a_post_is(y, bits):
    world = World(posts=((0.5, y, 0.01),), start=(0.0, 0.0, 0.0))
    firmware = kobuki(cmd_vel_timeout=0, world=world)
    firmware.receive(STRAIGHT_ON, 0)
    assert core(firmware, 1000 * MS).bumper == 0
    assert core(firmware, 6000 * MS).bumper == bits


def test_over_an_edge_cliff_sensors_and_a_wheel_say_so():
    cliff = ((0.5, -1.0), (2.0, -1.0), (2.0, 1.0), (0.5, 1.0))
    firmware = kobuki(cmd_vel_timeout=0, world=World(cliffs=(cliff,), start=(0.0, 0.0, 0.0)))
    firmware.receive(STRAIGHT_ON, 0)
    parts = sent(firmware, 3600 * MS)
    assert (parts[0].cliff, parts[0].wheel_drop) == (2, 0)
    assert parts[3] == feedback.Cliff(1500, 0, 1500)
    assert core(firmware, 10_000 * MS).wheel_drop == 3
