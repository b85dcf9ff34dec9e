"""Which gamepad is meant, and what to report without one."""

import errno

import pytest

from gamepad.driver.device_choice import choose_by_name, explain
from gamepad.errors import DeviceError

JS0 = "/dev/input/js0"
NAMES = {JS0: "Pad F710", "/dev/input/js1": "Pad F310", "/dev/input/js2": "Pad"}


def test_the_exact_name_first_then_a_unique_part():
    assert choose_by_name(NAMES, "Pad") == "/dev/input/js2"
    assert choose_by_name(NAMES, "F710") == JS0


@pytest.mark.parametrize(
    ("names", "wanted", "line"),
    [
        (NAMES, "ad F", "~dev_name 'ad F' matches several gamepads, write more of it: 'Pad F710'"),
        (NAMES, "PS4", "No gamepad is named 'PS4'; there are: 'Pad F710' (/dev/input/js0), "),
    ],
)
def test_no_gamepad_is_opened_in_place_of_another(names, wanted, line):
    with pytest.raises(DeviceError) as error:
        choose_by_name(names, wanted)
    assert str(error.value).startswith(line)


@pytest.mark.parametrize(
    ("path", "number", "container", "wsl", "words"),
    [
        (JS0, errno.ENOENT, False, False, "No joystick at /dev/input/js0: plug it in"),
        (JS0, errno.ENOENT, True, False, "start it with --device /dev/input/js0"),
        (JS0, errno.ENOENT, False, True, "usbipd attach --wsl"),
        (JS0, errno.EACCES, False, False, "usermod -aG input"),
        (JS0, errno.EIO, False, False, "Cannot open /dev/input/js0: Input/output error."),
        ("/tmp/pad", errno.ENOENT, True, True, "No joystick at /tmp/pad yet: waiting for it."),
    ],
)
def test_each_case_is_told_apart_and_says_what_to_do(path, number, container, wsl, words):
    line = explain(path, number, container, wsl)
    assert words in line and "\n" not in line
    assert ("virtual:=true" in line) is (number == errno.ENOENT and path == JS0)
