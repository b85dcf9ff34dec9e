"""Unreadable messages are reported once a second and leave the buffer empty."""

import io
from types import SimpleNamespace

import pytest
from rospy.exceptions import TransportException
from sensor_msgs.msg import Joy

from node_kit.ros.rospy_patches import connections
from node_kit.rules.throttle import ThrottleEach
from tutorial_testing.claims import claim
from tutorial_testing.clock import Clock

WRONG_LENGTH = b"\x03\0\0\0abc"  # three bytes are not a Joy


@pytest.fixture
def read(monkeypatch):
    """read(bytes, time [s]), as a subscription: the warnings so far, and the messages or None."""
    clock, lines = Clock(), []
    monkeypatch.setattr(connections, "time", clock)
    monkeypatch.setattr(connections, "_may_warn", ThrottleEach(1.0))
    monkeypatch.setattr(connections, "_warn", lines.append)
    subscription = SimpleNamespace(queue_size=10, recv_data_class=Joy, resolved_name="/joy")

    def read(data, at, buffer=None):
        clock.now = at
        buffer, messages = buffer or io.BytesIO(), []
        buffer.write(data)
        try:
            connections._read_messages(subscription, buffer, messages, None)
        except TransportException:
            assert (buffer.getvalue(), messages) == (b"", [])
            return lines, None
        return lines, messages

    return read


@claim("A message that cannot be read is reported once a second")
def test_unreadable_messages_are_reported_once_a_second(read):
    for number in range(25):
        lines, messages = read(WRONG_LENGTH, 0.1 * number)
        assert messages is None
    assert len(lines) == 3 and "/joy cannot be read" in lines[0]


def test_a_message_that_does_not_end_is_reported(read):
    buffer = io.BytesIO()
    started = b"\0\0\1\0" + b"." * 20  # it announces 65536 bytes
    assert read(started, 0.0, buffer) == ([], [])
    assert read(b".", 0.4, buffer) == ([], [])
    lines, messages = read(b".", 0.6, buffer)
    assert messages is None and "65536 bytes" in lines[0]


def test_one_thread_at_a_time_connects_to_a_publisher(monkeypatch):
    monkeypatch.setattr(connections, "_connect", lambda *way: connections._turns[way[1:]].locked())
    assert connections._connect_in_turn(None, "/joy", "http://ada:1/")


def test_a_long_message_may_take_its_time_while_its_bytes_come(read):
    buffer = io.BytesIO()
    assert read(b"\0\0\0\1", 0.0, buffer) == ([], [])  # 16 MB
    for second in range(1, 8):
        assert read(bytes(1_000_000), float(second), buffer) == ([], [])
    assert read(b"", 8.0, buffer)[1] is None
