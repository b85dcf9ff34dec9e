"""The start of the node: its parameters, its port and its library are checked before the rest."""

from __future__ import annotations

import errno
import os
import socket
import ssl
import sys
from typing import Any

from foxglove_bridge_server.parameters import BridgeParameters, parse_parameters
from node_kit.errors import StartError
from node_kit.ros.graph.ros_api import family
from node_kit.ros.lifecycle.start import run

NODE_NAME = "foxglove_bridge"


def load(given: dict[str, Any]) -> tuple[BridgeParameters, socket.socket, ssl.SSLContext | None]:
    """Return what the node starts with. Raises ValueError or StartError, one line."""
    parameters, tls = parse_parameters(given), None
    about = f"~certfile: {parameters.certfile!r}, ~keyfile: {parameters.keyfile!r}"
    try:
        if parameters.tls:
            if not (parameters.certfile and parameters.keyfile):
                raise StartError("~tls: true: give certfile:= and keyfile:=, too")
            tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            tls.load_cert_chain(parameters.certfile, parameters.keyfile, password="")
        about = f"~address: {parameters.address!r}"
        address = parameters.address, parameters.port
        kind = family(parameters.address)
        return parameters, socket.create_server(address, family=kind, backlog=128), tls
    except OSError as error:
        why = error.strerror or str(error)
        if error.errno in (errno.EADDRINUSE, errno.EACCES):
            why = f"{os.strerror(error.errno)}; choose another: port:=8766"
            about = f"~port: {parameters.port}"
        raise StartError(f"{about}: {why}") from None


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
