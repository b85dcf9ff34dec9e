"""A Kobuki's battery: how full it is, and what charges it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kobuki_protocol.feedback import Core

CHARGER_STATE = 6  # the bits of core.charger for the state: 0, CHARGED or CHARGING
CHARGED = 2
CHARGING = 6
ADAPTER = 16  # the bit for the socket in the side; without it the docking station


class Level(Enum):
    """How full the battery is; the values are those of upstream's diagnostics."""

    MAXIMUM = "Maximum"  # charged
    HEALTHY = "Healthy"
    LOW = "Low"
    DANGEROUS = "Dangerous"


@dataclass(frozen=True)
class Limits:
    """Voltages [V]: kobuki_node's parameters battery_capacity, battery_low, battery_dangerous."""

    capacity: float = 16.5
    low: float = 14.0
    dangerous: float = 13.2


USUAL = Limits()


@dataclass(frozen=True)
class Battery:
    """What one packet says of the battery."""

    voltage: float  # [V]
    charger: int = 0  # core.charger
    limits: Limits = USUAL

    @classmethod
    def of(cls, core: Core, limits: Limits = USUAL) -> Battery:
        """Return the battery of a packet."""
        return cls(core.battery / 10.0, core.charger, limits)

    @property
    def is_charged(self) -> bool:
        """Return whether the charger is in place and has no more to do."""
        return self.charger & CHARGER_STATE == CHARGED

    @property
    def is_charging(self) -> bool:
        """Return whether the charger fills it."""
        return self.charger & CHARGER_STATE == CHARGING

    @property
    def source(self) -> str:
        """Return what charges it: None, Adapter or Dock, the words of upstream's diagnostics."""
        if not (self.is_charged or self.is_charging):
            return "None"
        return "Adapter" if self.charger & ADAPTER else "Dock"

    @property
    def level(self) -> Level:
        """Return how full it is."""
        if self.is_charged:
            return Level.MAXIMUM
        if self.voltage > self.limits.low:
            return Level.HEALTHY
        return Level.LOW if self.voltage > self.limits.dangerous else Level.DANGEROUS

    @property
    def percent(self) -> float:
        """Return it in percent: 100 at the capacity, 5 where it is dangerous (battery.cpp)."""
        limits = self.limits
        share = (self.voltage - limits.dangerous) / (limits.capacity - limits.dangerous)
        return min(100.0, max(0.0, 95.0 * share + 5.0))
