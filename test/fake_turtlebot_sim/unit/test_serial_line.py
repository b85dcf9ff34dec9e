"""The pseudo terminal of serial_kobuki, as a driver that opens and closes it sees it."""

import os
from contextlib import contextmanager

import pytest

from fake_turtlebot_sim.io.serial_kobuki.serial_line import SerialLine

BYTES = bytes(range(256))


@pytest.fixture
def link(tmp_path):
    return str(tmp_path / "kobuki")


@pytest.fixture
def line(link):
    serial_line = SerialLine(link)
    yield serial_line
    serial_line.unplug()


@contextmanager
def opened(path):
    descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def test_all_bytes_pass_unchanged_both_ways_and_also_when_it_is_opened_again(link, line):
    for _ in range(2):
        assert not line.is_open
        with opened(link) as driver:
            assert line.is_open
            line.write(BYTES)
            assert os.read(driver, 1000) == BYTES
            os.write(driver, BYTES)
            assert line.read() == BYTES


def test_what_is_sent_while_it_is_closed_is_lost(link, line):
    line.write(b"old")
    with opened(link) as driver, pytest.raises(BlockingIOError):
        os.read(driver, 10)


def test_a_driver_that_does_not_read_holds_up_nothing(link, line):
    with opened(link):
        for _ in range(1000):
            line.write(BYTES)


def test_what_waits_is_dropped_on_request(link, line):
    with opened(link) as driver:
        os.write(driver, BYTES * 10)
        line.drain()
        assert line.read() == b""
        os.write(driver, b"new")
        assert line.read() == b"new"


def test_unplugged_the_link_is_gone_and_the_driver_reads_its_end(link):
    line = SerialLine(link)
    with opened(link) as driver:
        line.unplug()
        assert not os.path.lexists(link)
        assert os.read(driver, 10) == b""


def test_the_link_of_a_program_that_was_killed_is_replaced(link):
    os.symlink("/dev/pts/nothing", link)
    line = SerialLine(link)
    assert os.readlink(link) == line.path
    line.unplug()


@pytest.mark.parametrize("make", [lambda link: open(link, "w").close(), os.mkdir])
def test_a_file_where_the_link_would_be_is_left_alone(link, make):
    make(link)
    with pytest.raises(ValueError, match=f"~link: '{link}': File exists"):
        SerialLine(link)
    assert os.path.exists(link)


def test_the_link_of_a_living_one_is_left_alone(link, line):
    with pytest.raises(ValueError, match="which exists; end its program"):
        SerialLine(link)
    assert os.readlink(link) == line.path
