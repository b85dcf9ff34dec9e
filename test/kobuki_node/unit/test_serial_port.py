"""The serial port on pseudo terminals: bytes that arrive, and one line for each fault."""

import fcntl
import os
import tty

import pytest

from kobuki_driver.errors import PortError
from kobuki_driver.io import serial_port
from kobuki_driver.io.serial_port import SerialPort
from tutorial_testing.claims import claim

pytestmark = claim("Each fault of the port ...", because="every fault of the port")


@pytest.fixture
def line(tmp_path):
    """A master, and the path of its slave."""
    master, slave = os.openpty()
    tty.setraw(slave)
    path = tmp_path / "kobuki"
    path.symlink_to(os.ttyname(slave))
    yield master, slave, str(path)
    for fd in (master, slave):
        try:
            os.close(fd)
        except OSError:
            pass


def test_bytes_pass_both_ways(line):
    master, _, path = line
    port = SerialPort(path)
    os.write(master, b"\xaa\x55\x00\r\n\x03\x04")
    assert port.read() == b"\xaa\x55\x00\r\n\x03\x04"
    port.write(b"\x03\x11\x13\n")
    assert os.read(master, 99) == b"\x03\x11\x13\n"
    assert port.read() == b""
    port.close()


def test_a_second_driver_does_not_get_the_port(line):
    port = SerialPort(line[2])
    with pytest.raises(PortError, match="another program has"):
        SerialPort(line[2])
    port.close()
    SerialPort(line[2]).close()


def test_a_port_that_takes_nothing_keeps_no_old_commands(line):
    """When the other side reads again, it gets only what is sent from then on."""
    master, _, path = line
    port = SerialPort(path)
    for _ in range(3):
        port.write(bytes(5000))
    os.set_blocking(master, False)
    try:
        while os.read(master, 65536):
            pass
    except BlockingIOError:
        pass
    port.write(b"new")
    assert os.read(master, 65536) == b"new"


def test_a_cable_that_is_pulled_out_is_one_line(line):
    master, slave, path = line
    port = SerialPort(path)
    os.unlink(path)
    os.close(slave)
    os.close(master)
    with pytest.raises(PortError, match="is gone: was the cable unplugged"):
        port.read()
    with pytest.raises(PortError, match="is gone"):
        port.write(b"x")
    port.close()


def test_what_is_no_port_is_one_line(tmp_path):
    with pytest.raises(PortError, match="there is no "):
        SerialPort(str(tmp_path / "nothing"))
    file = tmp_path / "file"
    file.write_text("")
    for path in (file, tmp_path, "/dev/null"):
        with pytest.raises(PortError, match="is not a working serial port"):
            SerialPort(str(path))


def test_no_permission_is_one_line(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(serial_port.serial, "Serial", refuse)
    file = tmp_path / "port"
    file.write_text("")
    file.chmod(0o600)
    with pytest.raises(PortError, match="create_udev_rules"):
        SerialPort(str(file))
    file.chmod(0o660)
    with pytest.raises(PortError, match="usermod -aG"):
        SerialPort(str(file))


def test_another_program_that_has_the_port_is_named(line):
    """The other program locks it by flock."""
    path = line[2]
    fcntl.flock(os.open(path, os.O_RDWR | os.O_NOCTTY), fcntl.LOCK_EX)
    with pytest.raises(PortError, match="two drivers would command one robot"):
        SerialPort(path)
