"""The right to look and to drive.

A page of another server can make a browser in this network send us requests: to our address, with
its own Origin, or to a name of its own that it resolves to our address (DNS rebinding). So the Host
must be ours, and the Origin the same. A numeric address cannot be made to point elsewhere.
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
    """Who may do what. Without tokens every page may drive, as all are on this machine."""

    names: tuple[str, ...] = ("localhost",)  # names that reach this machine
    driver_token: str | None = None
    viewer_token: str | None = None
    peers: tuple[str, ...] | None = None  # the only other machines whose requests are answered
    origins: tuple[str, ...] = ()  # servers that forward to this page

    def may_come(self, address: str) -> bool:
        """Return whether an IP address may send requests."""
        return self.peers is None or address in self.peers or address.startswith("127.")

    def is_ours(self, host: str | None) -> bool:
        """Return whether a Host header, NAME or NAME:PORT, means this machine."""
        match = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[^:\[\]]+)(:\d{1,5})?", host or "")
        if not match:
            return False
        name = match[1].strip("[]").lower()
        try:
            address = ipaddress.ip_address(name)
        except ValueError:
            return name in self.names
        return self.driver_token is not None or address.is_loopback

    def may_request(self, host: str, origin: str | None) -> bool:
        """Return whether to answer a request. origin: the header, or None."""
        return self.is_ours(host) and origin in (None, f"http://{host}", *self.origins)

    def may_connect(self, host: str, origin: str | None) -> bool:
        """Return whether a WebSocket may be opened; every browser sends its Origin."""
        return origin is not None and self.may_request(host, origin)

    def role(self, token: str | None) -> str | None:
        """Return DRIVER, VIEWER, or None if the token is wrong or missing."""
        if self.driver_token is None:
            return DRIVER
        given = (token or "").encode()
        # Always both: the duration must not depend on the token.
        drives = hmac.compare_digest(given, self.driver_token.encode())
        views = hmac.compare_digest(given, (self.viewer_token or "").encode())
        return DRIVER if drives else VIEWER if views else None


def gateways(route_table: str) -> tuple[str, ...]:
    """Return the gateways in a /proc/net/route, whose numbers have the machine's byte order."""
    rows = [line.split() for line in route_table.splitlines()]
    numbers = [int(row[2], 16).to_bytes(4, sys.byteorder) for row in rows if not row[1].strip("0")]
    return tuple(str(ipaddress.IPv4Address(number)) for number in numbers)


def without_token(uri: str) -> str:
    """Return a request's path and query without its token, for a log."""
    return re.sub(r"(?i)(tok[^=&?]*=)[^&\s]*", r"\1...", uri)
