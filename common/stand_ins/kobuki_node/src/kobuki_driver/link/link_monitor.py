"""Watches the line to the robot: whether it is online, and what is to be reported, each once."""

from __future__ import annotations

from enum import Enum

OFFLINE_S = 0.1  # without a packet (kobuki.cpp: timeout)
PATIENCE_S = 1.0  # after the port was opened, before it is called silent
MANY_DAMAGED = 5  # packets; the first one that is seen is mostly cut off


class LinkEvent(Enum):
    """What has just become true of the line."""

    ONLINE = "packets come"
    LOST = "packets have ceased"
    SILENT = "nothing comes"
    FOREIGN = "something else comes"
    DAMAGED = "many packets are damaged"


class LinkMonitor:
    """Judges the line of one open port. Times are in seconds of one clock that never jumps."""

    def __init__(self, now_s: float) -> None:
        """Begin as the port is opened."""
        self.opened_s = now_s
        self.is_online = False
        self.count = 0  # bytes
        self.damaged = 0  # packets
        self._packet_s: float | None = None  # when the last one came
        self._reported: set[LinkEvent] = set()

    @property
    def was_online(self) -> bool:
        """Return whether a packet has come since the port was opened."""
        return self._packet_s is not None

    def take(self, count: int, packets: int, damaged: int, now_s: float) -> list[LinkEvent]:
        """Take what one read has brought: bytes and packets; damaged: since the port was opened."""
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
