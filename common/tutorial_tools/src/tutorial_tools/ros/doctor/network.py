"""Network queries that always end in time; rospy's may wait without end."""

from __future__ import annotations

import itertools
import os
import socket
import struct
import threading
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from typing import Any, TypeVar
from xmlrpc.server import SimpleXMLRPCServer

import rosgraph.network
from rosgraph.network import ROSHandshakeException

from node_kit.ros.graph import ros_api
from node_kit.ros.graph.ros_api import TIMEOUT_S, family

CALLER = f"/doctor_{os.getpid()}"
call = partial(ros_api.call, caller=CALLER)
LONGEST_MESSAGE = 10_000_000  # bytes; the stamped messages looked at are far shorter
Thing = TypeVar("Thing")
Result = TypeVar("Result")
_number = itertools.count()


def at_once(
    question: Callable[[Thing], Result], things: Iterable[Thing], timeout_s: float
) -> dict[Thing, Result]:
    """Ask question(thing) for all things at once; return {thing: answer} for answers in time."""
    answers = {}

    def ask(thing: Thing) -> None:
        with suppress(Exception):  # a broken peer may answer anything
            answers[thing] = question(thing)

    threads = [threading.Thread(target=ask, args=(thing,), daemon=True) for thing in things]
    for thread in threads:
        thread.start()
    end = time.monotonic() + timeout_s
    for thread in threads:
        thread.join(max(0.0, end - time.monotonic()))
    return dict(answers)


def addresses(name: str) -> list[str]:
    """Return the addresses of a host, maybe none; in time, even if the look-up hangs."""
    # As in ROS, IPv6 only if ROS_IPV6 asks for it.
    family = socket.AF_UNSPEC if os.environ.get("ROS_IPV6") == "on" else socket.AF_INET

    def look_up(host: str) -> list[str]:
        records = socket.getaddrinfo(host, 0, family, socket.SOCK_STREAM)
        return [str(entry[4][0]) for entry in records]

    return at_once(look_up, [name], TIMEOUT_S).get(name, [])


def is_here(address: str) -> bool:
    """Return whether an address is this machine's: only then can a socket be bound to it."""
    try:
        with socket.socket(family(address), socket.SOCK_DGRAM) as probe:
            probe.bind((address, 0))
            return address not in ("0.0.0.0", "::")
    except OSError:
        return False


def is_called_back(master_uri: str, own_name: str) -> bool:
    """Return whether the master reaches this machine under its own name.

    This program registers a publisher and a subscriber of a topic for a moment: the master must
    notify the subscriber of the publisher.
    """
    called = threading.Event()

    def publisher_update(*_: object) -> tuple[int, str, int]:
        called.set()
        return 1, "", 0

    with SimpleXMLRPCServer(("", 0), logRequests=False) as server:
        server.register_function(publisher_update, "publisherUpdate")
        threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
        uri = f"http://{own_name}:{server.server_address[1]}/"
        topic, kind = f"{CALLER}/here", "std_msgs/Empty"
        try:
            call(master_uri, "registerSubscriber", topic, kind, uri)
            call(master_uri, "registerPublisher", topic, kind, uri)
            return called.wait(TIMEOUT_S)
        finally:
            call(master_uri, "unregisterSubscriber", topic, uri)
            call(master_uri, "unregisterPublisher", topic, uri)
            server.shutdown()


def listen(node_uri: str, topic: str, seconds: float, most: int = 1) -> list[tuple[float, bytes]]:
    """Return [(arrival [s, of this machine's clock], bytes)] of messages that a node sends.

    Ends after `most` messages or after some seconds; there may be none.
    """
    heard: list[tuple[float, bytes]] = []
    _receive(node_uri, topic, seconds, most, heard)
    return heard


def header(node_uri: str, topic: str) -> dict[str, str]:
    """Return the header that a node sends before the messages: callerid, type, md5sum ..."""
    begin = _receive(node_uri, topic, TIMEOUT_S, 0, [])
    with suppress(ROSHandshakeException, ValueError, struct.error):
        return dict(rosgraph.network.decode_ros_handshake_header(begin))
    return {}


def _receive(
    node_uri: str, topic: str, seconds: float, most: int, heard: list[tuple[float, bytes]]
) -> bytes:
    """Append up to `most` messages to heard; return what the node sends before them."""
    end = time.monotonic() + seconds
    # A new name for each connection: a node closes an older one with the same name.
    name = f"{CALLER}_{next(_number)}"
    fields = {"callerid": name, "topic": topic, "md5sum": "*", "type": "*"}
    begin = b""
    with suppress(OSError, ValueError, TypeError, struct.error):  # too late, or the node has exited
        _, (_, host, port) = call(node_uri, "requestTopic", topic, [["TCPROS"]])
        with socket.create_connection((host, port), TIMEOUT_S) as connection:
            connection.sendall(rosgraph.network.encode_ros_handshake_header(fields))
            stream = connection.makefile("rb")
            own = _block(connection, stream, end)
            begin = struct.pack("<I", len(own)) + own
            while len(heard) < most:
                data = _block(connection, stream, end)
                heard.append((time.time(), data))
    return begin


def _block(connection: socket.socket, stream: Any, end: float) -> bytes:
    connection.settimeout(max(0.001, end - time.monotonic()))
    (length,) = struct.unpack("<I", stream.read(4))
    data: bytes = stream.read(min(length, LONGEST_MESSAGE))
    if len(data) < length:
        raise ValueError("the connection was closed, or the message is too long")
    return data
