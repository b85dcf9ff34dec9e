"""Services registered before a node loads rospy, at a master that the test simulates."""

import atexit
import signal
import socket
import subprocess
import sys
import threading
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from node_kit.ros.lifecycle import announcement
from node_kit.ros.lifecycle.announcement import announce
from tutorial_testing.claims import claim

pytestmark = claim(
    "A node's services are registered before it loads rospy, and withdrawn if its start fails"
)
SERVICES = ("spawn", "turtle1/set_pen")


@pytest.fixture
def master(monkeypatch):
    """The state of a master, and the requests it received: (method, caller, ...)."""
    state, requests = [[], [], []], []
    server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    server.register_function(lambda _: (1, "", state), "getSystemState")
    for method in ("registerService", "unregisterService"):
        server.register_function(
            lambda *given, method=method: requests.append((method, *given)) or (1, "", 1), method
        )
    threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{server.server_address[1]}")
    monkeypatch.setenv("ROS_IP", "127.0.0.1")
    monkeypatch.setattr(sys, "argv", ["turtlesim_node"])
    monkeypatch.setattr(atexit, "register", lambda _: None)  # it would run when the tests end
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    yield state, requests
    server.shutdown()
    server.server_close()


@pytest.fixture
def sockets(monkeypatch):
    """Close the sockets of an announcement after the test."""
    made, make = [], announcement._bound
    monkeypatch.setattr(announcement, "_bound", lambda: made.append(make()) or made[-1])
    yield made
    for listener in made:
        listener.close()


@pytest.mark.parametrize(("arguments", "node", "names"), [
    ([], "/turtlesim", ["/spawn", "/turtle1/set_pen"]),
    (["__name:=sim", "__ns:=a/b"], "/a/b/sim", ["/a/b/spawn", "/a/b/turtle1/set_pen"]),
    (["spawn:=hatch", "_x:=1"], "/turtlesim", ["/hatch", "/turtle1/set_pen"]),
])  # fmt: skip
def test_services_are_registered_as_the_node_will_name_them(
    master, sockets, monkeypatch, arguments, node, names
):
    monkeypatch.setattr(sys, "argv", ["turtlesim_node", *arguments])
    made = announce("turtlesim", SERVICES)
    port = sockets[0].getsockname()[1]
    where, uri = f"rosrpc://127.0.0.1:{port}", f"http://127.0.0.1:{made.node_port}/"
    assert master[1] == [("registerService", node, name, where, uri) for name in names]
    master[1].clear()
    made.withdraw()
    assert master[1] == [("unregisterService", node, name, where) for name in names]


def test_callers_wait_and_the_node_gets_its_port(master, sockets):
    made = announce("turtlesim", SERVICES)
    with socket.create_connection(("127.0.0.1", sockets[0].getsockname()[1])) as caller:
        assert made.listener.accept()[1] == caller.getsockname()
    with pytest.raises(ConnectionRefusedError):  # for a master that asks: there is no node yet
        socket.create_connection(("127.0.0.1", made.node_port))
    place = "127.0.0.1", made.node_port
    with SimpleXMLRPCServer(place):  # as rospy starts it
        made.keep()
        socket.create_connection(place).close()


@pytest.mark.parametrize("state", [
    [[["/rosout", ["/turtlesim"]]], [], []],  # a running node of that name
    [[], [], [["/spawn", ["/sim"]]]],
])  # fmt: skip
def test_what_runs_already_is_left_alone(master, sockets, state):
    master[0][:] = state
    assert announce("turtlesim", SERVICES) is None
    assert (master[1], sockets) == ([], [])


def test_without_a_master_the_start_goes_on_to_the_line_that_says_so(master, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:1")
    assert announce("turtlesim", SERVICES) is None


def test_nothing_slow_is_loaded_before():
    modules = "import sys, node_kit.ros.lifecycle.announcement; print(*sys.modules)"
    loaded = subprocess.check_output([sys.executable, "-c", modules], text=True)
    assert not {"rospy", "numpy", "yaml", "genpy", "catkin"} & set(loaded.split())
