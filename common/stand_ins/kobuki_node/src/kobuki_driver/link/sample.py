"""A sample of the bytes at a port of a Kobuki, for the doctor."""

from __future__ import annotations

from dataclasses import dataclass

from kobuki_protocol.battery import Battery
from kobuki_protocol.feedback import Core
from kobuki_protocol.framing import Framer
from kobuki_protocol.identity import FirmwareVersion
from kobuki_protocol.robot_packets import parse


@dataclass(frozen=True)
class Sample:
    """The state of a port; complaint: why it cannot be read, or ""."""

    path: str
    complaint: str = ""
    has_rule: bool = True
    latency_ms: int | None = None  # of FTDI's converter; None: another converter
    count: int = 0  # bytes
    packets: int = 0
    damaged: int = 0
    firmware: FirmwareVersion | None = None
    battery: Battery | None = None


class Sampler:
    """Collects the values of a Sample from the bytes of a port."""

    def __init__(self) -> None:
        """Start without any bytes."""
        self._framer = Framer()
        self.count = self.packets = 0
        self.firmware: FirmwareVersion | None = None
        self.battery: Battery | None = None

    @property
    def damaged(self) -> int:
        """Return the number of damaged packets, without the first one, which is incomplete."""
        return max(0, self._framer.damaged - 1)

    def take(self, data: bytes) -> None:
        """Add bytes."""
        self.count += len(data)
        for payload in self._framer.feed(data):
            for part in parse(payload):
                if isinstance(part, Core):
                    self.packets += 1
                    self.battery = Battery.of(part)
                elif isinstance(part, FirmwareVersion):
                    self.firmware = part
