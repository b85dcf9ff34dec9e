"""The start of the node: its parameters and its port are checked before anything else."""

from __future__ import annotations

import socket
import ssl
import sys
from typing import Any

from foxglove_bridge_server.parameters import BridgeParameters, parse_parameters
from node_kit.ros.lifecycle.start import run

NODE_NAME = "foxglove_bridge"
OLDEST = (3, 10)  # foxglove-sdk has no wheels for an older Python


def listening(parameters: BridgeParameters) -> socket.socket:
    """Return a socket that listens. Raises ValueError, one line."""
    address = parameters.address, parameters.port
    family = socket.AF_INET6 if ":" in parameters.address else socket.AF_INET
    try:
        return socket.create_server(address, family=family, backlog=128)
    except OSError as error:
        raise ValueError(f"~port: {address[1]} of {address[0]}: {error.strerror}") from None


def tls_of(parameters: BridgeParameters) -> ssl.SSLContext | None:
    """Return what encrypts, if asked for. Raises ValueError, one line."""
    if not parameters.tls:
        return None
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    try:
        context.load_cert_chain(parameters.certfile, parameters.keyfile, password="")
    except OSError as error:
        files = f"{parameters.certfile}, {parameters.keyfile}"
        raise ValueError(f"~certfile, ~keyfile: {files}: {error.strerror or error}") from None
    return context


def load(given: dict[str, Any]) -> tuple[BridgeParameters, socket.socket, ssl.SSLContext | None]:
    """Return what the node starts with. Raises ValueError, one line."""
    parameters = parse_parameters(given)
    tls = tls_of(parameters)
    return parameters, listening(parameters), tls


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    if sys.version_info < OLDEST:
        sys.exit(f"{NODE_NAME}: foxglove-sdk needs Python 3.10 or later, as Debian 12 has")
    try:
        from foxglove_bridge_server.ros.bridge_node import Bridge  # noqa: PLC0415  may be missing
    except ModuleNotFoundError as error:
        if error.name != "foxglove":
            raise
        todo = "./tutorial foxglove installs it: 19 MB from PyPI"
        sys.exit(f"{NODE_NAME}: foxglove-sdk is missing; {todo}")
    lost = []

    def spin(loaded: Any) -> None:
        bridge = Bridge(*loaded)
        bridge.run()
        lost.append(bridge.has_lost_master)

    code = run(NODE_NAME, load, spin, keeps_name=True)
    if any(lost):
        print(f"{NODE_NAME}: the ROS master has exited", file=sys.stderr)
    return code or int(any(lost))
