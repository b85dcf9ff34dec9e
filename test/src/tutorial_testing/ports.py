"""Ports for what a test starts."""

import socket


def free_port():
    """Return a TCP port of this machine that no program uses now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
