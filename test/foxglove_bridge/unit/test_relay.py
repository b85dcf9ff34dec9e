"""The relay, between sockets of this machine."""

import asyncio
import contextlib
import json
import queue
import socket
import threading

import pytest

from foxglove_bridge_server.io.relay import CLOSE, NEW, OLD, is_old, renamed, serve, with_ros
from tutorial_testing.claims import claim

pytestmark = claim(
    "Clients with the old or the new name of Foxglove's subprotocol connect; bytes pass unchanged"
)
REQUEST = (
    b"GET / HTTP/1.1\r\nHost: a\r\nSec-WebSocket-Protocol: %s\r\nX: foxglove.websocket.v1\r\n\r\n"
)
ANSWER = b"HTTP/1.1 101 OK\r\nsec-websocket-protocol: foxglove.sdk.v1\r\n\r\n"
PATIENCE_S = 30.0
LIMIT = 10_000  # bytes


@pytest.fixture(name="relayed")
def _relayed():
    """Return a function that connects a client through a relay: its socket, and the server's."""
    listener, server = (socket.create_server(("127.0.0.1", 0)) for _ in range(2))
    server.settimeout(PATIENCE_S)
    started = queue.SimpleQueue()

    async def run():
        started.put((asyncio.get_running_loop(), asyncio.current_task()))
        with contextlib.suppress(asyncio.CancelledError):
            await serve(listener, server.getsockname()[1], LIMIT, None)

    thread = threading.Thread(target=lambda: asyncio.run(run()))
    thread.start()
    loop, task = started.get()
    opened = []

    def connect(request):
        client = socket.create_connection(listener.getsockname(), PATIENCE_S)
        client.sendall(request)
        accepted = server.accept()[0]
        accepted.settimeout(PATIENCE_S)
        opened.extend((client, accepted))
        return client, accepted

    yield connect
    for end in (*opened, server):
        end.close()
    loop.call_soon_threadsafe(task.cancel)
    thread.join()
    listener.close()


def received(end, count):
    data = b""
    while len(data) < count:
        part = end.recv(count - len(data))
        assert part, data
        data += part
    return data


def test_only_the_name_of_the_subprotocol_is_replaced():
    assert renamed(REQUEST % OLD, OLD, NEW) == REQUEST % NEW
    assert is_old(REQUEST % OLD)
    assert not is_old(REQUEST % (NEW + b", " + OLD))
    assert not is_old(REQUEST % b"chat")
    assert is_old((REQUEST % OLD).replace(b"Sec-WebSocket-P", b"SEC-WEBSOCKET-P"))


@pytest.mark.parametrize("name", [OLD, NEW, NEW + b", " + OLD, OLD + b", " + NEW, b"chat"])
def test_a_request_and_its_answer_pass_with_what_follows_at_once(relayed, name):
    is_translated = name == OLD
    client, server = relayed(REQUEST % name + b"\x81\0early")
    wanted = REQUEST % (NEW if is_translated else name)
    assert received(server, len(wanted)) == wanted
    server.sendall(ANSWER + OLD + NEW + b"\xff")
    answer = (ANSWER.replace(NEW, OLD) if is_translated else ANSWER) + OLD + NEW + b"\xff"
    assert received(client, len(answer)) == answer
    client.sendall(b"\0\xff" + OLD)
    wanted = b"\x81\0early\0\xff" + OLD
    assert received(server, len(wanted)) == wanted


def test_the_end_of_either_side_ends_the_other(relayed):
    for number in (0, 1):
        ends = relayed(REQUEST % OLD)
        received(ends[1], len(REQUEST % NEW))
        ends[1].sendall(ANSWER)
        received(ends[0], len(ANSWER.replace(NEW, OLD)))
        ends[number].close()
        wanted = CLOSE if number else b""  # a close frame for the client
        assert received(ends[1 - number], len(wanted)) == wanted
        assert ends[1 - number].recv(1) == b""


def test_a_client_that_does_not_read_stops_the_server_and_not_another_client(relayed):
    client, server = relayed(REQUEST % OLD)
    received(server, len(REQUEST % NEW))
    server.sendall(ANSWER)
    server.settimeout(1.0)
    sent = 0
    with pytest.raises(socket.timeout):
        while sent < 1 << 30:
            sent += server.send(bytes(1 << 16))
    other, server_of_other = relayed(REQUEST % NEW)
    assert received(server_of_other, len(REQUEST % NEW)) == REQUEST % NEW
    server_of_other.sendall(ANSWER)
    assert received(other, len(ANSWER)) == ANSWER
    head = ANSWER.replace(NEW, OLD)
    assert received(client, len(head) + sent) == head + bytes(sent)


def test_a_head_that_does_not_end_is_refused(relayed):
    client = relayed(REQUEST % OLD)[0]
    with socket.create_connection(client.getpeername(), PATIENCE_S) as other:
        with contextlib.suppress(ConnectionError):
            other.sendall(b"x" * 1_000_000)
        with contextlib.suppress(ConnectionResetError):
            assert other.recv(1) == b""


def test_the_first_message_names_ros_1_and_keeps_its_length():
    greeting = b'\x81\x40{"metadata":{"fg-library":"foxglove-sdk-python/0.30.3"},"sessionId":"1"}'
    changed = with_ros(greeting)
    assert len(changed) == len(greeting)
    assert json.loads(changed[2:])["metadata"] == {"ROS_DISTRO": "noetic"}
    assert with_ros(ANSWER) == ANSWER
