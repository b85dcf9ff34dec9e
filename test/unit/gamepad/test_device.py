"""Choosing, opening and losing devices: files and FIFOs here, the kernel's in test/system."""

import errno
import os
import select
import struct
import threading
import time

import pytest

from gamepad.driver.device import Finder
from gamepad.driver.device_choice import DeviceError, choose_by_name, explain
from gamepad.driver.wake import Wake
from gamepad.gamepads import F710_D
from gamepad.js_event import SIGN_OF_LIFE_MS
from gamepad.virtual.pads import SIGN_OF_LIFE_S, PadError, StreamPad

NAMES = {"/dev/input/js0": "Pad F710", "/dev/input/js1": "Pad F310", "/dev/input/js2": "Pad"}
DEADLINE_S = 10.0


@pytest.mark.parametrize(
    ("wanted", "path"),
    [("Pad", "/dev/input/js2"), ("F710", "/dev/input/js0"), ("Pad F3", "/dev/input/js1")],
)
def test_the_exact_name_first_then_a_unique_part(wanted, path):
    assert choose_by_name(NAMES, wanted) == path


@pytest.mark.parametrize(
    ("names", "wanted", "line"),
    [
        (
            NAMES,
            "ad F",
            "~dev_name 'ad F' fits several gamepads, write more of it: 'Pad F710'",
        ),
        (NAMES, "PS4", "No gamepad is named 'PS4'; there are: 'Pad F710' (/dev/input/js0), "),
        ({}, "PS4", "No gamepad is named 'PS4'; there are: none at all. Plug it in."),
    ],
)
def test_no_gamepad_is_opened_in_place_of_another(names, wanted, line):
    with pytest.raises(DeviceError) as error:
        choose_by_name(names, wanted)
    assert str(error.value).startswith(line)


@pytest.mark.parametrize(
    ("number", "container", "wsl", "words"),
    [
        (errno.ENOENT, False, False, "No joystick at /dev/input/js0: plug it in"),
        (errno.ENOENT, True, False, "start it with --device /dev/input/js0"),
        (errno.ENOENT, False, True, "usbipd attach --wsl"),
        (errno.EACCES, False, False, "usermod -aG input"),
        (errno.EPERM, True, False, "start it with --device"),
        (errno.EIO, False, False, "Cannot open /dev/input/js0: Input/output error."),
    ],
)
def test_each_case_is_told_apart_and_says_what_to_do(number, container, wsl, words):
    line = explain("/dev/input/js0", number, container, wsl)
    assert words in line
    assert "\n" not in line
    assert ("virtual:=true" in line) is (number == errno.ENOENT)


def test_a_program_that_will_serve_a_fifo_is_waited_for():
    line = explain("/tmp/virtual_f710", errno.ENOENT, container=True, wsl=True)
    assert line == "No joystick at /tmp/virtual_f710 so far: it is waited for."


@pytest.mark.parametrize("path", ["/dev/null", "/tmp"])
def test_what_is_no_joystick_is_refused(path):
    with pytest.raises(DeviceError, match="joystick"):
        Finder(path, "").open()


def test_a_plain_file_is_read_once_until_it_changes(tmp_path):
    path = tmp_path / "events"
    path.write_bytes(b"8 bytes.")
    finder = Finder(str(path), "")
    device = finder.open()
    assert device.read() == b"8 bytes."
    with pytest.raises(DeviceError, match="closed"):
        device.read()
    device.close()
    with pytest.raises(DeviceError, match="read to its end"):
        finder.open()
    path.write_bytes(b"another 16 bytes")
    device = finder.open()
    assert device.read() == b"another 16 bytes"
    device.close()


# ---------------------------------------------------------------------------------------- waiting


def test_a_call_from_another_thread_ends_the_wait():
    wake = Wake()
    threading.Thread(target=wake.wake).start()
    began = time.monotonic()
    assert not wake.wait(began + DEADLINE_S)
    assert time.monotonic() < began + DEADLINE_S
    wake.wait(0.0)  # nothing is left over, and a time that is past does not wait


# ----------------------------------------------------------------------------------------- stream


def events(device):
    return list(struct.iter_unpack("=IhBB", device.read()))


def test_a_stream_tells_the_state_at_opening_and_then_the_changes(tmp_path):
    path = str(tmp_path / "pad")
    rest = ((0.0,) * 6, (0,) * 12)
    with StreamPad(F710_D, path, clock=lambda: 5.0) as pad:
        pad.show(rest)
        assert not pad.connected
        device = Finder(path, "").open()
        pad.show(rest)
        first = events(device)
        assert [kind for _, _, kind, _ in first] == [0x81] * 12 + [0x82] * 6
        assert not any(value for _, value, _, _ in first)
        pad.show(((0.0, 1.0, 0, 0, 0, 0), (0, 0, 0, 0, 1) + (0,) * 7))
        assert sorted([event[1:] for event in events(device)]) == [(-32767, 2, 1), (1, 1, 4)]
        assert device.read() == b""  # nothing new, and not the end
        pad.show(None)
        with pytest.raises(DeviceError, match="Lost"):
            device.read()
        device.close()
    assert not os.path.exists(path)


def test_a_second_reader_is_told_all_again(tmp_path):
    path = str(tmp_path / "pad")
    pushed = ((0.0, 1.0, 0, 0, 0, 0), (0,) * 12)
    with StreamPad(F710_D, path, clock=lambda: 5.0) as pad:
        for _ in range(2):
            device = Finder(path, "").open()
            pad.show(pushed)
            assert [event[1:] for event in events(device)][-1] == (-32767, 2, 1)
            device.close()
            pad.show(pushed)
            assert not pad.connected


def test_a_stream_tells_that_it_lives(tmp_path):
    path, clock = str(tmp_path / "pad"), [5.0]
    pushed = ((0.0, 1.0, 0, 0, 0, 0), (0, 0, 0, 0, 1) + (0,) * 7)
    with StreamPad(F710_D, path, clock=lambda: clock[0]) as pad:
        device = Finder(path, "").open()
        pad.show(pushed)
        device.read()
        clock[0] += 0.14
        pad.show(pushed)
        assert device.read() == b""
        assert pad.watch(select.poll()) <= SIGN_OF_LIFE_S
        for _ in range(3):
            clock[0] += SIGN_OF_LIFE_S + 0.01
            pad.show(pushed)
            signs = events(device)
            # All of the state, for a reader that has just come; the time says what it is.
            assert sorted(event[1:] for event in signs if event[1]) == [
                (-32767, 0x82, 1), (1, 0x81, 4),
            ]  # fmt: skip
            assert len(signs) == 18
            assert {event[0] for event in signs} == {SIGN_OF_LIFE_MS}
        device.close()


def test_a_path_that_is_no_fifo_is_refused_and_left_alone(tmp_path):
    path = tmp_path / "notes"
    path.write_text("mine")
    with pytest.raises(PadError, match="is no FIFO"):
        StreamPad(F710_D, str(path))
    assert path.read_text() == "mine"
    with pytest.raises(PadError, match="cannot make the FIFO"):
        StreamPad(F710_D, str(tmp_path / "none" / "pad"))
