"""Which node holds a name, asked of a master and of nodes that this test plays."""

import socket
import threading
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

import pytest

from node_kit import questions
from node_kit.questions import Answer, call, holder


class Quiet(SimpleXMLRPCRequestHandler):
    rpc_paths = ()

    def log_message(self, *_):
        pass


@pytest.fixture
def serve():
    """Start an XML-RPC server with these methods; its URI."""
    servers = []

    def start(**methods):
        server = SimpleXMLRPCServer(("127.0.0.1", 0), Quiet)
        servers.append(server)
        for name, method in methods.items():
            server.register_function(method, name)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        return f"http://127.0.0.1:{server.server_address[1]}"

    yield start
    for server in servers:
        server.shutdown()
        server.server_close()


def master(serve, uri):
    known = lambda _, name: (1, "", uri) if name == "/robot" else (-1, "unknown node", "")  # noqa: E731
    return serve(lookupNode=known)


def test_a_node_that_answers_holds_its_name(serve):
    node = serve(getPid=lambda _: (1, "", 77))
    assert holder(master(serve, node), "/robot") == (node, f"at {node}, process 77")


@pytest.mark.parametrize(("own", "is_free"), [("/robot", False), ("/joy2twist", True)])
def test_a_port_may_be_another_nodes_by_now(serve, own, is_free):
    node = serve(getPid=lambda _: (1, "", 77), getName=lambda _: (1, "", own))
    assert (holder(master(serve, node), "/robot") is None) == is_free


def test_a_name_that_nobody_has_is_free(serve):
    assert holder(master(serve, "http://127.0.0.1:1"), "/other") is None


def test_a_node_that_is_dead_holds_nothing(serve):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    assert holder(master(serve, f"http://127.0.0.1:{port}"), "/robot") is None


def test_a_node_that_takes_the_connection_and_says_nothing_may_go_on(serve, monkeypatch):
    monkeypatch.setattr(questions, "PATIENCE_S", 0.1)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        uri = f"http://127.0.0.1:{silent.getsockname()[1]}"
        assert holder(master(serve, uri), "/robot") == (uri, f"at {uri}, but does not answer")


def test_no_master_is_no_answer():
    assert call("http://127.0.0.1:1", "getPid") == (Answer.REFUSED, None)
    assert call("http://no.such.host.invalid:1", "getPid", timeout_s=5.0)[0] in (
        Answer.UNKNOWN_NAME,
        Answer.SILENT,
    )


def test_another_server_is_no_master(serve):
    assert call(serve(), "getPid")[0] is Answer.STRANGE
