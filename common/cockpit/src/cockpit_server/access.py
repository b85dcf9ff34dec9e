"""The right to look and to drive (pure).

A page of somewhere else can have a browser of this network send us requests: under our address,
with its own Origin, or under a name of its own that it lets point to us (DNS rebinding). So the
Host must be ours, and the Origin the same. An address in numbers cannot be made to point elsewhere.
"""

from __future__ import annotations

import hmac
import ipaddress
import re
import sys
from dataclasses import dataclass

DRIVER, VIEWER = "driver", "viewer"


@dataclass(frozen=True)
class Access:
    """Without tokens, every client may drive: all are on this machine."""

    names: tuple[str, ...] = ("localhost",)  # names that reach this machine
    driver_token: str | None = None
    viewer_token: str | None = None
    peers: tuple[str, ...] | None = None  # the only other machines whose requests are answered
    origins: tuple[str, ...] = ()  # under which others forward to this page

    def may_come(self, address: str) -> bool:
        """Return whether an IP address may send requests."""
        return self.peers is None or address in self.peers or address.startswith("127.")

    def is_ours(self, host: str | None) -> bool:
        """Return whether a Host header, NAME or NAME:PORT, means this machine."""
        found = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[^:\[\]]+)(:\d{1,5})?", host or "")
        if not found:
            return False
        name = found[1].strip("[]").lower()
        try:
            address = ipaddress.ip_address(name)
        except ValueError:
            return name in self.names
        return self.driver_token is not None or address.is_loopback

    def may_request(self, host: str, origin: str | None) -> bool:
        """Return whether a request may be answered. origin: the header, or None."""
        return self.is_ours(host) and origin in (None, f"http://{host}", *self.origins)

    def may_connect(self, host: str, origin: str | None) -> bool:
        """Return whether a WebSocket may be opened; every browser sends its Origin."""
        return origin is not None and self.may_request(host, origin)

    def role(self, token: str | None) -> str | None:
        """Return DRIVER, VIEWER, or None if the token is wrong or missing."""
        if self.driver_token is None:
            return DRIVER
        given = (token or "").encode()
        # Both in any case: the time that it takes must say nothing.
        drives = hmac.compare_digest(given, self.driver_token.encode())
        views = hmac.compare_digest(given, (self.viewer_token or "").encode())
        return DRIVER if drives else VIEWER if views else None


def gateways(route_table: str) -> tuple[str, ...]:
    """Return the gateways of a /proc/net/route, which has numbers in the machine's byte order."""
    rows = [line.split() for line in route_table.splitlines()]
    found = [int(row[2], 16).to_bytes(4, sys.byteorder) for row in rows if not row[1].strip("0")]
    return tuple(str(ipaddress.IPv4Address(one)) for one in found)


def without_token(uri: str) -> str:
    """Return a request's path and query as it may be logged."""
    return re.sub(r"(?i)(tok[^=&?]*=)[^&\s]*", r"\1...", uri)
