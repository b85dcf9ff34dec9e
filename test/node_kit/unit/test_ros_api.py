"""Which node holds a name, with a master and nodes that the test simulates."""

import socket
import threading
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from node_kit.ros.graph import ros_api
from node_kit.ros.graph.ros_api import holder


@pytest.fixture
def serve():
    """Start an XML-RPC server with these methods; return its URI."""
    servers = []

    def start(**methods):
        server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        servers.append(server)
        for name, method in methods.items():
            server.register_function(method, name)
        threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
        return f"http://127.0.0.1:{server.server_address[1]}"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()


def answering(**values):
    """Methods of a server that answer with these values."""
    return {name: lambda *_, value=value: (1, "", value) for name, value in values.items()}


@pytest.mark.parametrize(("own", "held"), [(None, True), ("/robot", True), ("/joy2twist", False)])
def test_a_node_that_answers_under_its_name_holds_it(serve, own, held):
    """But not if another node has its port by now. Not every node knows its name."""
    node = serve(**answering(getPid=77, **({"getName": own} if own else {})))
    found = (node, f"at {node}, process 77") if held else None
    assert holder(serve(**answering(lookupNode=node)), "/robot") == found


def test_an_unknown_name_and_that_of_a_dead_node_are_free(serve):
    assert holder(serve(lookupNode=lambda *_: (-1, "unknown node", "")), "/other") is None
    assert holder(serve(**answering(lookupNode="http://127.0.0.1:1")), "/robot") is None


def test_a_node_that_accepts_the_connection_and_does_not_answer_holds_its_name(serve, monkeypatch):
    monkeypatch.setattr(ros_api, "PATIENCE_S", 0.1)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        uri = f"http://127.0.0.1:{silent.getsockname()[1]}"
        found = holder(serve(**answering(lookupNode=uri)), "/robot")
        assert found == (uri, f"at {uri}, but does not answer")
