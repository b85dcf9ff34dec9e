"""A Kobuki's battery: its level, and its charger."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from kobuki_protocol.feedback import Core

CHARGER_STATE = 6  # the bits of core.charger for its state: 0, CHARGED or CHARGING
CHARGED = 2
CHARGING = 6
ADAPTER = 16  # the bit for the socket; without it the docking station charges


class Level(Enum):
    """The level of the battery; the values are those of upstream's diagnostics."""

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
    """The state of the battery in one packet."""

    voltage: float  # [V]
    charger: int = 0  # core.charger
    limits: Limits = USUAL

    @classmethod
    def of(cls, core: Core, limits: Limits = USUAL) -> Battery:
        """Return the battery of a packet."""
        return cls(core.battery / 10.0, core.charger, limits)

    @property
    def is_charged(self) -> bool:
        """Return whether the charger is connected and has finished."""
        return self.charger & CHARGER_STATE == CHARGED

    @property
    def is_charging(self) -> bool:
        """Return whether the battery is being charged."""
        return self.charger & CHARGER_STATE == CHARGING

    @property
    def source(self) -> str:
        """Return the source in upstream's diagnostics: None, Adapter or Dock."""
        if not (self.is_charged or self.is_charging):
            return "None"
        return "Adapter" if self.charger & ADAPTER else "Dock"

    @property
    def level(self) -> Level:
        """Return the level by charger and voltage."""
        if self.is_charged:
            return Level.MAXIMUM
        if self.voltage > self.limits.low:
            return Level.HEALTHY
        return Level.LOW if self.voltage > self.limits.dangerous else Level.DANGEROUS

    @property
    def percent(self) -> float:
        """Return the charge: 100 at limits.capacity, 5 at limits.dangerous (battery.cpp)."""
        limits = self.limits
        share = (self.voltage - limits.dangerous) / (limits.capacity - limits.dangerous)
        return min(100.0, max(0.0, 95.0 * share + 5.0))
