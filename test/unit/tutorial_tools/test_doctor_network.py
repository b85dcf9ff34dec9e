"""An answer comes in time, whatever the other end is. No ROS runs here."""

import socket
import struct
import threading
import time

import pytest

from node_kit.questions import Answer, way_out
from tutorial_tools.doctor import network


@pytest.fixture(autouse=True)
def hurry(monkeypatch):
    monkeypatch.setattr(network, "TIMEOUT_S", 0.2)


@pytest.fixture
def server():
    """A function that serves what it is given to every caller; returns the URI."""
    sockets = []

    def serve(answer):
        listener = socket.create_server(("127.0.0.1", 0))
        sockets.append(listener)

        def run():
            while True:
                try:
                    connection, _ = listener.accept()
                    sockets.append(connection)
                    answer(connection)
                except OSError:
                    return

        threading.Thread(target=run, daemon=True).start()
        return f"http://127.0.0.1:{listener.getsockname()[1]}/"

    yield serve
    for each in sockets:
        each.close()


def dribble(connection):
    """Send a little, again and again, as a camera on the web does."""
    connection.recv(1000)
    connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\n\r\n")
    while True:
        connection.sendall(b" ")
        time.sleep(0.05)


def say(text):
    def answer(connection):
        connection.recv(1000)
        connection.sendall(text)
        connection.close()

    return answer


@pytest.mark.parametrize(
    ("answer", "expected"),
    [
        (lambda connection: None, Answer.SILENT),
        (dribble, Answer.SILENT),
        *((say(text), Answer.STRANGE) for text in (b"", b"SSH-2.0\r\n", b"HTTP/1.0 200\r\n\r\nhi")),
    ],
)
def test_whatever_answers(server, answer, expected):
    assert network.call(server(answer), "getPid") == (expected, None)


def test_nothing_listens_or_nobody_knows_the_name():
    assert network.call("http://127.0.0.1:1/", "getPid") == (Answer.REFUSED, None)
    answer, _ = network.call("http://no.such.host.invalid:1/", "getPid")
    assert answer in (Answer.UNKNOWN_NAME, Answer.SILENT)


def test_a_name_that_does_not_exist():
    assert network.addresses("no.such.host.invalid") == []
    assert network.addresses("a" * 300) == []
    assert network.addresses("127.0.0.1") == ["127.0.0.1"]


def test_a_look_up_without_an_end(monkeypatch):
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_: threading.Event().wait())
    assert network.addresses("robot") == []


def test_own_addresses():
    assert network.is_here("127.0.0.1")
    assert not network.is_here("192.0.2.7")  # for documentation: nobody's (RFC 5737)
    assert not network.is_here("0.0.0.0")
    assert not network.is_here("no address")
    assert way_out("127.0.0.1") == "127.0.0.1"
    assert way_out("no address") == ""


def block(data):
    return struct.pack("<I", len(data)) + data


@pytest.mark.parametrize(
    ("sent", "heard"),
    [
        (block(b"") + block(b"first") + block(b"second") + block(b"third"), [b"first", b"second"]),
        (block(b"header") + block(b"first"), [b"first"]),
        (block(b"header") + b"\xff\xff\xff\xff", []),
        (b"\x05", []),
        (b"", []),
    ],
)
def test_listening(server, monkeypatch, sent, heard):
    port = int(server(say(sent)).rsplit(":", 1)[1].strip("/"))
    monkeypatch.setattr(network, "call", lambda *_: (Answer.WELL, ["TCPROS", "127.0.0.1", port]))
    assert [data for _, data in network.listen("", "/odom", 0.5, most=2)] == heard


def test_listening_to_a_node_that_has_gone():
    assert network.listen("http://127.0.0.1:1/", "/odom", 0.5) == []


def test_only_what_is_answered_in_time_counts():
    late = threading.Event()
    answers = network.at_once(lambda thing: thing or late.wait(), [0, 1, 2], 0.2)
    assert answers == {1: 1, 2: 2}
    late.set()
