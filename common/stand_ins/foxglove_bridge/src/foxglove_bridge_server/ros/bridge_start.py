"""The start of the node: its parameters, its port and its library are checked before the rest."""

from __future__ import annotations

import socket
import ssl
import sys
from typing import Any

from foxglove_bridge_server.parameters import BridgeParameters, parse_parameters
from node_kit.ros.lifecycle.start import run

NODE_NAME = "foxglove_bridge"


def load(given: dict[str, Any]) -> tuple[BridgeParameters, socket.socket, ssl.SSLContext | None]:
    """Return what the node starts with. Raises ValueError, one line."""
    parameters, tls = parse_parameters(given), None
    about = f"~certfile: {parameters.certfile!r}, ~keyfile: {parameters.keyfile!r}"
    try:
        if parameters.tls:
            tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            tls.load_cert_chain(parameters.certfile, parameters.keyfile, password="")
        about = f"~port: {parameters.port} of {parameters.address}"
        family = socket.AF_INET6 if ":" in parameters.address else socket.AF_INET
        address = parameters.address, parameters.port
        return parameters, socket.create_server(address, family=family, backlog=128), tls
    except OSError as error:
        raise ValueError(f"{about}: {error.strerror or error}") from None


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    try:
        from foxglove_bridge_server.ros.bridge_node import Bridge  # noqa: PLC0415  may be missing
    except ModuleNotFoundError as error:
        if error.name != "foxglove":
            raise
        todo = "./tutorial foxglove installs it: 19 MB from PyPI, for Python 3.10 or later"
        sys.exit(f"{NODE_NAME}: foxglove-sdk is missing; {todo}")
    return run(NODE_NAME, load, lambda loaded: Bridge(*loaded).run(), keeps_name=True)
