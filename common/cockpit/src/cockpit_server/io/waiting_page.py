"""What browsers show while the cockpit waits for a master: a line, and then the page."""

from __future__ import annotations

import select
import socket
import time
from contextlib import suppress

READ_S, LONGEST_REQUEST = 0.2, 4096  # for reading a request once; bytes
LINE = "The cockpit waits for a ROS master: start roscore, or a launch file. Its page then opens."
PAGE = f"<!doctype html><html lang=en><title>Cockpit</title><p>{LINE}</p></html>\n"
ANSWER = (
    "HTTP/1.1 503 Service Unavailable\r\nContent-Type: text/html; charset=utf-8\r\n"
    "Refresh: 1\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
    "Content-Security-Policy: default-src 'none'; frame-ancestors 'none'\r\n"
    f"Connection: close\r\nContent-Length: {len(PAGE)}\r\n\r\n{PAGE}"
)


def answer_for(listener: socket.socket, duration_s: float) -> None:
    """Answer all connections with the waiting page, for a time."""
    end = time.monotonic() + duration_s
    while select.select([listener], [], [], max(0.0, end - time.monotonic()))[0]:
        with suppress(OSError):  # The browser has closed it.
            connection, _ = listener.accept()
            with connection:
                connection.settimeout(READ_S)
                connection.recv(LONGEST_REQUEST)
                connection.sendall(ANSWER.encode())
        if time.monotonic() > end:
            return
