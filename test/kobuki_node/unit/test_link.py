"""What the driver learns about the line to a Kobuki, and reports once; its requests."""

import pytest

from kobuki_driver.link import port_advice
from kobuki_driver.link.link_monitor import LinkEvent, LinkMonitor
from kobuki_driver.link.port_advice import Port
from kobuki_driver.robot.identification import Identification
from kobuki_protocol.commands import GetController, IdentityRequest
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId
from tutorial_testing.claims import claim

KOBUKI = Port("/dev/ttyUSB1", is_kobuki=True, description="iClebo Kobuki")
ARDUINO = Port("/dev/ttyACM0", description="Arduino Uno")


def test_packets_make_it_online_and_a_tenth_of_a_second_without_them_offline():
    monitor = LinkMonitor(0.0)
    assert monitor.take(81, 1, 0, 0.02) == [LinkEvent.ONLINE]
    assert monitor.take(81, 1, 0, 0.04) == []
    assert monitor.take(0, 0, 0, 0.14) == []
    assert monitor.take(0, 0, 0, 0.15) == [LinkEvent.LOST]
    assert monitor.take(0, 0, 0, 5.0) == []
    assert monitor.take(81, 1, 0, 5.1) == [LinkEvent.ONLINE]


def test_a_driver_that_was_late_itself_does_not_lose_the_robot():
    monitor = LinkMonitor(0.0)
    monitor.take(81, 1, 0, 0.02)
    assert monitor.take(4000, 40, 0, 3.0) == []
    assert monitor.is_online


@pytest.mark.parametrize(("count", "event"), [(0, LinkEvent.SILENT), (7, LinkEvent.FOREIGN)])
def test_no_packet_for_a_second_is_reported_once(count, event):
    monitor = LinkMonitor(0.0)
    assert monitor.take(count, 0, 0, 0.99) == []
    assert monitor.take(count, 0, 0, 1.0) == [event]
    assert monitor.take(count, 0, 0, 2.0) == []
    assert not monitor.was_online
    assert monitor.take(81, 1, 0, 3.0) == [LinkEvent.ONLINE]


def test_damaged_packets_are_reported_once_and_not_the_first_one():
    monitor = LinkMonitor(0.0)
    monitor.take(81, 1, 1, 0.02)
    assert monitor.take(81, 1, 4, 0.04) == []
    assert monitor.take(81, 1, 5, 0.06) == [LinkEvent.DAMAGED]
    assert monitor.take(81, 1, 50, 0.08) == []


@claim("Each fault of the port ...", because="every fault of the line")
@pytest.mark.parametrize(("line", "parts"), [
    (port_advice.absent("/dev/kobuki", [ARDUINO, KOBUKI]),
     ["no /dev/kobuki", "serialport:=/dev/ttyUSB1", "rosrun kobuki_node create_udev_rules"]),
    (port_advice.absent("/dev/kobuki", [ARDUINO]), ["/dev/ttyACM0 (Arduino Uno)", "cable"]),
    (port_advice.absent("/dev/kobuki", []), ["there are none"]),
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
])  # fmt: skip
def test_each_line_says_what_to_do(line, parts):
    assert "\n" not in line
    for part in parts:
        assert part in line
    if "online" not in line and "damaged" not in line:
        assert "aiting for it" in line


ANSWERS = [HardwareVersion(4, 0, 1), FirmwareVersion(0, 2, 1), UniqueId((1, 2, 3))]


def test_a_robot_is_asked_until_it_has_answered():
    identification = Identification()
    identification.begin(10.0)
    assert identification.requests(10.0) == [IdentityRequest(), GetController()]
    assert identification.requests(10.05) == []
    assert identification.requests(10.11) == [IdentityRequest(), GetController()]
    assert identification.take([*ANSWERS, None]) == ANSWERS
    assert identification.requests(10.22) == [GetController()]
    identification.take([Controller()])
    assert identification.requests(99.0) == []
    identification.begin(100.0)  # the robot was lost, and is back
    assert identification.requests(100.0) == [IdentityRequest(), GetController()]


def test_a_robot_that_does_not_answer_is_asked_less_often():
    identification = Identification()
    identification.begin(0.0)
    times = [0.02 * k for k in range(1000)]
    assert len([now for now in times if identification.requests(now)]) <= 25


@pytest.mark.parametrize(("firmware", "drives", "part"), [
    (FirmwareVersion(0, 2, 1), True, None),
    (FirmwareVersion(3, 1, 1), True, "1.1.4 or newer is recommended"),
    (FirmwareVersion(0, 0, 2), False, "firmware 2.0.0: this driver supports only 1.x"),
    (FirmwareVersion(0, 9, 0), False, "update the robot's"),
])  # fmt: skip
def test_another_major_version_is_not_driven(firmware, drives, part):
    identification = Identification()
    identification.begin(0.0)
    assert not identification.may_drive(0.5)  # the version is unknown
    identification.take([firmware])
    assert identification.may_drive(0.5) is drives
    assert (part or "") in identification.objection()
    assert bool(identification.objection()) is bool(part)


def test_one_that_does_not_say_its_version_is_driven_after_two_seconds():
    identification = Identification()
    identification.begin(0.0)
    assert identification.may_drive(2.0)
