"""What is found out about the line to a Kobuki, and said once; what it is asked."""

import pytest

from kobuki_driver.link import port_advice
from kobuki_driver.link.port_advice import Port
from kobuki_driver.link.watch import Finding, Watch
from kobuki_driver.robot.introduction import Introduction
from kobuki_protocol.commands import GetController, Request
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId

KOBUKI = Port("/dev/ttyUSB1", is_kobuki=True, description="iClebo Kobuki")
ARDUINO = Port("/dev/ttyACM0", description="Arduino Uno")


def test_packets_make_it_online_and_a_tenth_of_a_second_without_them_offline():
    watch = Watch(0.0)
    assert watch.take(81, 1, 0, 0.02) == [Finding.ONLINE]
    assert watch.take(81, 1, 0, 0.04) == []
    assert watch.take(0, 0, 0, 0.14) == []
    assert watch.take(0, 0, 0, 0.15) == [Finding.LOST]
    assert watch.take(0, 0, 0, 5.0) == []
    assert watch.take(81, 1, 0, 5.1) == [Finding.ONLINE]


def test_a_driver_that_was_late_itself_does_not_lose_the_robot():
    watch = Watch(0.0)
    watch.take(81, 1, 0, 0.02)
    assert watch.take(4000, 40, 0, 3.0) == []
    assert watch.is_online


@pytest.mark.parametrize(("count", "finding"), [(0, Finding.SILENT), (7, Finding.FOREIGN)])
def test_no_packet_for_a_second_is_reported_once(count, finding):
    watch = Watch(0.0)
    assert watch.take(count, 0, 0, 0.99) == []
    assert watch.take(count, 0, 0, 1.0) == [finding]
    assert watch.take(count, 0, 0, 2.0) == []
    assert not watch.was_online
    assert watch.take(81, 1, 0, 3.0) == [Finding.ONLINE]


def test_damaged_packets_are_reported_once_and_not_the_first_one():
    watch = Watch(0.0)
    watch.take(81, 1, 1, 0.02)
    assert watch.take(81, 1, 4, 0.04) == []
    assert watch.take(81, 1, 5, 0.06) == [Finding.DAMAGED]
    assert watch.take(81, 1, 50, 0.08) == []


@pytest.mark.parametrize(
    ("line", "parts"),
    [
        (port_advice.absent("/dev/kobuki", [ARDUINO, KOBUKI]),
         ["no /dev/kobuki", "serialport:=/dev/ttyUSB1", "rosrun kobuki_node create_udev_rules"]),
        (port_advice.absent("/dev/kobuki", [ARDUINO]), ["/dev/ttyACM0 (Arduino Uno)", "cable"]),
        (port_advice.absent("/dev/kobuki", []), ["here is none"]),
        (port_advice.forbidden("/dev/kobuki", "dialout", "ada", False),
         ["no permission", "sudo usermod -aG dialout ada"]),
        (port_advice.forbidden("/dev/kobuki", "dialout", "ada", True), ["log in again"]),
        (port_advice.forbidden("/dev/kobuki", "", "ada", False), ["create_udev_rules"]),
        (port_advice.taken("/dev/kobuki", "screen (pid 7)"), ["screen (pid 7)", "End it"]),
        (port_advice.silent("/dev/kobuki"), ["is the Kobuki switched on?"]),
        (port_advice.foreign("/dev/ttyACM0", 99, [ARDUINO, KOBUKI]),
         ["99 bytes", "a Kobuki is at /dev/ttyUSB1"]),
        (port_advice.foreign("/dev/ttyACM0", 99, [ARDUINO]), ["another device"]),
        (port_advice.lost("/dev/kobuki"), ["switched off", "busy", "obeys the next command"]),
        (port_advice.unplugged("/dev/kobuki"), ["unplugged", "obeys the next command"]),
        (port_advice.damaged("/dev/kobuki", 5), ["cable", "hub", "latency timer"]),
        (port_advice.online("/dev/kobuki"), ["online", "still for 3 s"]),
    ],
)  # fmt: skip
def test_each_line_says_what_to_do(line, parts):
    assert "\n" not in line
    for part in parts:
        assert part in line
    if "online" not in line and "damaged" not in line:
        assert "aiting for it" in line


ANSWERS = [HardwareVersion(4, 0, 1), FirmwareVersion(0, 2, 1), UniqueId((1, 2, 3))]


def test_a_robot_is_asked_until_it_has_answered():
    introduction = Introduction()
    introduction.begin(10.0)
    assert introduction.questions(10.0) == [Request(), GetController()]
    assert introduction.questions(10.05) == []
    assert introduction.questions(10.11) == [Request(), GetController()]
    assert introduction.take([*ANSWERS, None]) == ANSWERS
    assert introduction.questions(10.22) == [GetController()]
    introduction.take([Controller()])
    assert introduction.questions(99.0) == []
    introduction.begin(100.0)  # it was lost, and is back
    assert introduction.questions(100.0) == [Request(), GetController()]


def test_a_robot_that_does_not_answer_is_asked_less_often():
    introduction = Introduction()
    introduction.begin(0.0)
    times = [0.02 * k for k in range(1000)]
    assert len([now for now in times if introduction.questions(now)]) <= 25


@pytest.mark.parametrize(
    ("firmware", "drives", "part"),
    [
        (FirmwareVersion(0, 2, 1), True, None),
        (FirmwareVersion(3, 1, 1), True, "1.1.4 or newer is recommended"),
        (FirmwareVersion(0, 0, 2), False, "firmware 2.0.0: this driver knows 1.x"),
        (FirmwareVersion(0, 9, 0), False, "update the robot's"),
    ],
)
def test_another_major_version_is_not_driven(firmware, drives, part):
    introduction = Introduction()
    introduction.begin(0.0)
    assert not introduction.may_drive(0.5)  # it may be any
    introduction.take([firmware])
    assert introduction.may_drive(0.5) is drives
    assert (part or "") in introduction.objection()
    assert bool(introduction.objection()) is bool(part)


def test_one_that_does_not_say_its_version_is_driven_after_two_seconds():
    introduction = Introduction()
    introduction.begin(0.0)
    assert introduction.may_drive(2.0)
