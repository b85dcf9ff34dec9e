"""An answer comes in time, whatever the other end is; no ROS runs here."""

import contextlib
import socket
import struct
import threading
import time

import pytest

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_tools.ros.doctor import network

pytestmark = claim("An answer comes in time, whatever the other end is")


@pytest.fixture(autouse=True)
def hurry(monkeypatch):
    monkeypatch.setattr(network, "TIMEOUT_S", 0.2)


@pytest.fixture
def server():
    """server(answer): answer each caller with a function; return the URI."""
    with contextlib.ExitStack() as stack:

        def serve(answer):
            listener = stack.enter_context(socket.create_server(("127.0.0.1", 0)))

            def run():
                with contextlib.suppress(OSError):  # a caller has hung up, or the test ends
                    while True:
                        answer(stack.enter_context(listener.accept()[0]))

            threading.Thread(target=run, daemon=True).start()
            return f"http://127.0.0.1:{listener.getsockname()[1]}/"

        yield serve


def dribble(connection):
    """Send a little again and again, like a web camera."""
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


@pytest.mark.parametrize(("answer", "expected"), [
    (dribble, Answer.SILENT),
    *((say(text), Answer.STRANGE) for text in (b"", b"SSH-2.0\r\n", b"HTTP/1.0 200\r\n\r\nhi")),
])  # fmt: skip
def test_whatever_answers_the_doctor_goes_on(server, answer, expected):
    assert network.call(server(answer), "getPid") == (expected, None)


def test_a_look_up_without_an_end_has_one(monkeypatch):
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_: threading.Event().wait())
    assert network.addresses("robot") == []
    assert [network.is_here(one) for one in ("127.0.0.1", "0.0.0.0")] == [True, False]


def block(data):
    return struct.pack("<I", len(data)) + data


@pytest.mark.parametrize(("sent", "heard"), [
    (block(b"") + block(b"first") + block(b"second") + block(b"third"), [b"first", b"second"]),
    (block(b"header") + block(b"first") + b"\xff\xff\xff\xff", [b"first"]),
    (b"\x05", []),
])  # fmt: skip
def test_messages_of_a_node_are_heard_as_far_as_they_are_whole(server, monkeypatch, sent, heard):
    port = int(server(say(sent)).rsplit(":", 1)[1].strip("/"))
    monkeypatch.setattr(network, "call", lambda *_: (Answer.WELL, ["TCPROS", "127.0.0.1", port]))
    assert [data for _, data in network.listen("", "/odom", 0.5, most=2)] == heard
