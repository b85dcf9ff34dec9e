"""Calls of services that answer well, badly or never; the test simulates each service."""

import socket
import struct
import threading
from io import BytesIO

import pytest
from rosgraph.network import read_ros_handshake_header, write_ros_handshake_header
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

from node_kit.errors import ServiceError
from node_kit.ros.graph import services
from node_kit.ros.graph.services import call_service, kind_of
from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim


@pytest.fixture
def serve(monkeypatch):
    """Start a service /x; a function answers each connection."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        uri = f"rosrpc://127.0.0.1:{listener.getsockname()[1]}"
        monkeypatch.setattr(services, "call", lambda *_, **__: (Answer.WELL, uri))
        monkeypatch.setattr(services.rospy, "get_name", lambda: "/test")
        connections = []

        def start(answer):
            def run():
                connection, _ = listener.accept()
                connections.append(connection)
                answer(connection)

            threading.Thread(target=run, daemon=True).start()

        yield start
        for connection in connections:
            connection.close()


def after_header(data, kind="std_srvs/SetBool"):
    """Return an answer: a header with this type and, after the request, these bytes."""

    def answer(connection):
        read_ros_handshake_header(connection, BytesIO(), 4096)
        write_ros_handshake_header(connection, {"type": kind, "md5sum": "*"})
        if connection.recv(4096):
            connection.sendall(data)

    return answer


def framed(is_well, data):
    return struct.pack("<BI", is_well, len(data)) + data


def asked():
    return call_service("/x", SetBoolRequest(True), SetBool, 0.2)


def test_an_answer_arrives_and_a_failure_is_its_text(serve):
    buffer = BytesIO()
    SetBoolResponse(True, "yes").serialize(buffer)
    serve(after_header(framed(1, buffer.getvalue())))
    assert asked().message == "yes"
    serve(after_header(framed(0, b"not now")))
    with pytest.raises(ServiceError, match=r"^not now$"):
        asked()


@claim("A service that ...", because="given up in time")
@pytest.mark.parametrize(("answer", "why"), [
    (lambda _: None, "/x has not answered for 0.2 s"),
    (after_header(b""), "/x has not answered for 0.2 s"),
    (after_header(framed(1, b"")[:3]), "/x has not answered for 0.2 s"),
    (lambda connection: connection.close(), "has ended without an answer"),
    (after_header(framed(1, b"abc")), "the answer of /x is malformed"),
    (after_header(struct.pack("<BI", 1, 2**32 - 1)), "/x answers with 4294967295 bytes"),
])  # fmt: skip
def test_a_service_that_does_not_answer_or_wrongly_is_one_line(serve, answer, why):
    serve(answer)
    with pytest.raises(ServiceError, match=why):
        asked()


@claim("A type that a page, a master ...", because="a service")
def test_its_type_is_one_that_genpy_made(serve):
    serve(after_header(b""))
    assert kind_of("/x") is SetBool
    serve(after_header(b"", kind="unittest.__main__/x"))
    with pytest.raises(ServiceError, match="the package of /x is not installed here"):
        kind_of("/x")
