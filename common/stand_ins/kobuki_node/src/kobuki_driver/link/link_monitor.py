"""Monitors the link to the robot: whether it is online, and the events to report."""

from __future__ import annotations

from enum import Enum

OFFLINE_S = 0.1  # without a packet (kobuki.cpp: timeout)
PATIENCE_S = 1.0  # after opening the port, before it counts as silent
MANY_DAMAGED = 5  # packets; the first packet is usually incomplete


class LinkEvent(Enum):
    """A change of the link that is reported."""

    ONLINE = "packets come"
    LOST = "packets no longer come"
    SILENT = "nothing comes"
    FOREIGN = "bytes come, but no packets"
    DAMAGED = "many packets are damaged"


class LinkMonitor:
    """Monitors one open port. Times are in seconds of a clock that never jumps."""

    def __init__(self, now_s: float) -> None:
        """Start when the port is opened."""
        self.opened_s = now_s
        self.is_online = False
        self.count = 0  # bytes
        self.damaged = 0  # packets
        self._packet_s: float | None = None  # time of the last packet
        self._reported: set[LinkEvent] = set()

    @property
    def was_online(self) -> bool:
        """Return whether a packet has come since the port was opened."""
        return self._packet_s is not None

    def take(self, count: int, packets: int, damaged: int, now_s: float) -> list[LinkEvent]:
        """Return the events of a read with `count` bytes; damaged: since the port was opened."""
        self.count += count
        self.damaged = damaged
        if packets:
            self._packet_s = now_s
            if not self.is_online:
                self.is_online = True
                self._reported -= {LinkEvent.SILENT, LinkEvent.FOREIGN}
                return [LinkEvent.ONLINE]
            return self._once(LinkEvent.DAMAGED) if damaged >= MANY_DAMAGED else []
        if self._packet_s is None:
            if now_s - self.opened_s < PATIENCE_S:
                return []
            return self._once(LinkEvent.FOREIGN if self.count else LinkEvent.SILENT)
        if self.is_online and now_s - self._packet_s > OFFLINE_S:
            self.is_online = False
            return [LinkEvent.LOST]
        return []

    def _once(self, event: LinkEvent) -> list[LinkEvent]:
        if event in self._reported:
            return []
        self._reported.add(event)
        return [event]
