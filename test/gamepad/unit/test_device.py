"""Choosing, opening and losing devices: files and FIFOs here, the kernel's in kernel/."""

import contextlib
import os
import stat
from types import SimpleNamespace

import pytest

from gamepad.driver.parameters import load
from gamepad.errors import DeviceError
from gamepad.io.device import Finder
from tutorial_testing.claims import claim


def test_what_is_no_joystick_is_refused():
    with pytest.raises(DeviceError, match="joystick"):
        Finder("/dev/null", "").open()
    with pytest.raises(ValueError, match="~dev: 'js0': must be a whole path, such as /dev/input"):
        load({"dev": "js0"})


@claim("Another user's FIFO, and what is no joystick, is refused")
@pytest.mark.parametrize(
    ("owner", "group", "mode", "is_refused"),
    [
        (0, 0, 0o644, False), (8, 7, 0o600, True), (0, 0, 0o602, True),
        (7, 7, 0o664, False), (7, 9, 0o664, True),  # the user's own group, as with umask 002
    ],
)  # fmt: skip
def test_a_fifo_that_another_user_could_write_is_refused(
    tmp_path, monkeypatch, owner, group, mode, is_refused
):
    path = tmp_path / "virtual_f710"
    os.mkfifo(path)
    status = SimpleNamespace(st_uid=owner, st_gid=group, st_mode=stat.S_IFIFO | mode)
    monkeypatch.setattr(os, "fstat", lambda _: status)
    monkeypatch.setattr(os, "getuid", lambda: 7)
    monkeypatch.setattr(os, "getgid", lambda: 7)
    refusal = pytest.raises(DeviceError, match="drive the robot: choose another path, or")
    with refusal if is_refused else contextlib.nullcontext():
        Finder(str(path), "").open().close()


def test_a_plain_file_is_read_once_until_it_changes(tmp_path):
    path = tmp_path / "events"
    finder = Finder(str(path), "")
    for content in (b"8 bytes.", b"another 16 bytes"):
        path.write_bytes(content)
        device = finder.open()
        assert device.read() == content
        with pytest.raises(DeviceError, match="closed"):
            device.read()
        device.close()
        with pytest.raises(DeviceError, match="read to its end"):
            finder.open()
