"""Questions to the network that always end in time.

No rospy here: one of its nodes may wait forever for a master, or for a name.
"""

import itertools
import os
import socket
import struct
import threading
import time
from contextlib import contextmanager, suppress
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

from node_kit import questions
from node_kit.questions import TIMEOUT_S, Answer

CALLER = f"/doctor_{os.getpid()}"
LONGEST_MESSAGE = 10_000_000  # bytes; the stamped messages looked at are far shorter
_number = itertools.count()


def at_once(question, things, timeout_s):
    """Ask question(thing) about all things at once; {thing: answer} of those answered in time."""
    answers = {}

    def ask(thing):
        with suppress(Exception):  # what a broken peer says may be anything
            answers[thing] = question(thing)

    threads = [threading.Thread(target=ask, args=(thing,), daemon=True) for thing in things]
    for thread in threads:
        thread.start()
    end = time.monotonic() + timeout_s
    for thread in threads:
        thread.join(max(0.0, end - time.monotonic()))
    return dict(answers)


def addresses(name):
    """The addresses of a host, maybe none. Ends in time, though a look-up itself may not."""
    # As ROS does: IPv6 only where it is asked for.
    family = socket.AF_UNSPEC if os.environ.get("ROS_IPV6") == "on" else socket.AF_INET

    def look_up(host):
        try:
            return [
                found[4][0] for found in socket.getaddrinfo(host, 0, family, socket.SOCK_STREAM)
            ]
        except (OSError, UnicodeError):
            return []

    return at_once(look_up, [name], TIMEOUT_S).get(name, [])


def is_here(address):
    """Whether an address is one of this machine: only then can a socket be bound to it."""
    if address in ("0.0.0.0", "::"):
        return False
    try:
        with socket.socket(_family(address), socket.SOCK_DGRAM) as probe:
            probe.bind((address, 0))
            return True
    except OSError:
        return False


def way_out(address):
    """Our own address on the way to another one, or "". Nothing is sent."""
    try:
        with socket.socket(_family(address), socket.SOCK_DGRAM) as probe:
            probe.connect((address, 9))
            return probe.getsockname()[0]
    except OSError:
        return ""


def _family(address):
    return socket.AF_INET6 if ":" in address else socket.AF_INET


def call(uri, method, *arguments):
    """Call a master's or a node's method as this program; (Answer, its value or None)."""
    answer, value = questions.call(uri, method, *arguments, caller=CALLER)
    return answer, value if answer is Answer.WELL else None


class _Quiet(SimpleXMLRPCRequestHandler):
    rpc_paths = ()  # any

    def log_message(self, *_):
        pass


def is_called_back(master_uri, own_name):
    """Whether the master reaches this machine under its own name.

    For a moment there is a topic of which this program is publisher and subscriber at once; the
    master has to inform the subscriber of the publisher.
    """
    called = threading.Event()

    def publisher_update(*_):
        called.set()
        return 1, "", 0

    with SimpleXMLRPCServer(("", 0), _Quiet, logRequests=False) as server:
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


@contextmanager
def _connection(node_uri, topic):
    """A socket on which a node sends the messages of a topic. Raises OSError, ValueError."""
    _, way = call(node_uri, "requestTopic", topic, [["TCPROS"]])
    if not way:
        raise OSError("it does not send this topic")
    _, host, port = way
    with socket.create_connection((host, port), TIMEOUT_S) as connection:
        # A name for each: a node drops an older connection of the same name.
        fields = {
            "callerid": f"{CALLER}_{next(_number)}",
            "topic": topic,
            "md5sum": "*",
            "type": "*",
        }
        lines = [f"{name}={value}".encode() for name, value in fields.items()]
        header = b"".join(struct.pack("<I", len(line)) + line for line in lines)
        connection.sendall(struct.pack("<I", len(header)) + header)
        yield connection


def listen(node_uri, topic, seconds, most=1):
    """[(time of arrival [s, of this machine's clock], bytes)] of messages that a node sends.

    Ends after `most` messages or after some seconds; there may be none.
    """
    heard = []
    end = time.monotonic() + seconds
    try:
        with _connection(node_uri, topic) as connection:
            _receive(connection, end)  # the node's own header
            while len(heard) < most:
                message = _receive(connection, end)
                heard.append((time.time(), message))
    except (OSError, ValueError):
        pass  # the time is over, or the node has gone
    return heard


def _receive(connection, end):
    """One block of bytes with its length before it. Raises OSError, ValueError."""
    (length,) = struct.unpack("<I", _read(connection, 4, end))
    if length > LONGEST_MESSAGE:
        raise ValueError(f"{length} bytes")
    return _read(connection, length, end)


def _read(connection, count, end):
    data = b""
    while len(data) < count:
        left_s = end - time.monotonic()
        if left_s <= 0:
            raise OSError("no time left")
        connection.settimeout(left_s)
        part = connection.recv(count - len(data))
        if not part:
            raise OSError("it was closed")
        data += part
    return data
