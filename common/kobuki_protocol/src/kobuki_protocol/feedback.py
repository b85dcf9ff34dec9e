"""The sensor values that a Kobuki sends 50 times a second.

Fields hold the values on the line, so that building and parsing lose nothing; properties convert
them to other units.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import degrees, radians
from struct import Struct
from typing import Any, ClassVar, Iterable, Tuple, Union

from kobuki_protocol.packed_part import PackedPart

PERIOD_S = 0.02  # between two packets
DIGIT_DEG_PER_S = 0.00875  # of the gyro L3G4200D (its data sheet, at 250 deg/s)
READING_PERIOD_S = 0.01  # between two readings of the gyro
INT16 = (-(1 << 15), (1 << 15) - 1)
Digits = Tuple[int, int, int]
Rates = Tuple[float, float, float]  # of the robot about x, y, z [rad/s]


def int16(value: float) -> int:
    """Return a number without its fraction, limited to 16 bits, as the Kobuki's driver does."""
    return int(min(max(value, INT16[0]), INT16[1]))


@dataclass(frozen=True)
class Core(PackedPart):
    """The basic sensors. Bits: right 1, center 2, left 4; for wheels right 1, left 2."""

    ID: ClassVar[int] = 1
    LAYOUT: ClassVar[Struct] = Struct("<H3B2H2b4B")
    time_stamp: int = 0  # [ms], 16 bits
    bumper: int = 0
    wheel_drop: int = 0
    cliff: int = 0
    left_encoder: int = 0  # [ticks], 16 bits
    right_encoder: int = 0
    left_pwm: int = 0  # [% of the full voltage], -100 to 100
    right_pwm: int = 0
    buttons: int = 0  # bits 1, 2, 4: buttons 0, 1, 2
    charger: int = 0  # see kobuki_protocol.battery
    battery: int = 0  # [0.1 V]
    overcurrent: int = 0  # bits: left 1, right 2


@dataclass(frozen=True)
class DockInfrared(PackedPart):
    """The docking station as the three receivers see it: the bits of kobuki_msgs/DockInfraRed."""

    ID: ClassVar[int] = 3
    LAYOUT: ClassVar[Struct] = Struct("<3B")
    right: int = 0
    center: int = 0
    left: int = 0


@dataclass(frozen=True)
class Inertia(PackedPart):
    """The heading that the Kobuki computes from its gyro, 0 when it is switched on."""

    ID: ClassVar[int] = 4
    LAYOUT: ClassVar[Struct] = Struct("<2h3x")
    angle: int = 0  # [0.01 deg]
    rate: int = 0  # [0.01 deg/s]

    @classmethod
    def of(cls, heading: float, rate: float) -> Inertia:
        """Return the part with a heading [rad] and a rate [rad/s]."""
        return cls(*(int16(round(100.0 * degrees(value))) for value in (heading, rate)))

    @property
    def heading(self) -> float:
        """Return the angle in rad."""
        return radians(0.01 * self.angle)

    @property
    def turn_rate(self) -> float:
        """Return the rate in rad/s."""
        return radians(0.01 * self.rate)


@dataclass(frozen=True)
class Cliff(PackedPart):
    """The voltages of the cliff sensors, 0 to 4095: lower where the floor is farther away."""

    ID: ClassVar[int] = 5
    LAYOUT: ClassVar[Struct] = Struct("<3H")
    right: int = 0
    center: int = 0
    left: int = 0


@dataclass(frozen=True)
class Current(PackedPart):
    """The currents of the two motors [10 mA]."""

    ID: ClassVar[int] = 6
    LAYOUT: ClassVar[Struct] = Struct("<2B")
    left: int = 0
    right: int = 0


@dataclass(frozen=True)
class RawGyro:
    """Readings of the gyro, 10 ms apart, the newest last; the sensor is rotated by 90 degrees."""

    ID: ClassVar[int] = 13
    frame: int = 0  # counts the readings, in 8 bits
    readings: tuple[Digits, ...] = ()  # of the sensor about its x, y, z [DIGIT_DEG_PER_S]

    @classmethod
    def of(cls, frame: int, rates: Iterable[Rates]) -> RawGyro:
        """Return the part with turn rates of the robot; the frame is taken modulo 256."""
        turned = ((y, -x, z) for x, y, z in rates)
        digits = (tuple(int16(degrees(rate) / DIGIT_DEG_PER_S) for rate in of) for of in turned)
        return cls(frame % 256, tuple(digits))  # type: ignore[arg-type]

    @property
    def rates(self) -> list[Rates]:
        """Return the turn rates of the robot."""
        scale = radians(DIGIT_DEG_PER_S)
        return [(-scale * y, scale * x, scale * z) for x, y, z in self.readings]

    def data(self) -> bytes:
        """Return the data of the part."""
        digits = [digit for reading in self.readings for digit in reading]
        return Struct(f"<2B{len(digits)}h").pack(self.frame, len(digits), *digits)

    @classmethod
    def parse(cls, data: bytes) -> RawGyro:
        """Return the part with this data."""
        frame, length, *digits = Struct(f"<2B{len(data) // 2 - 1}h").unpack(data)
        used = digits[: length - length % 3]
        return cls(frame, tuple(zip(used[::3], used[1::3], used[2::3])))


@dataclass(frozen=True)
class Inputs:
    """The pins of the connector for additional devices."""

    ID: ClassVar[int] = 16
    LAYOUT: ClassVar[Struct] = Struct("<5H6x")
    digital: int = 0  # bits 0 to 3
    analog: tuple[int, ...] = (0, 0, 0, 0)  # 0 to 4095: 0 to 3.3 V

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(self.digital, *self.analog)

    @classmethod
    def parse(cls, data: bytes) -> Inputs:
        """Return the part with this data."""
        digital, *analog = cls.LAYOUT.unpack(data)
        return cls(digital, tuple(analog))


Sensor = Union[Core, DockInfrared, Inertia, Cliff, Current, RawGyro, Inputs]


@dataclass(frozen=True)
class Feedback:
    """The parts that a Kobuki sends 50 times a second."""

    core: Core = field(default_factory=Core)
    dock: DockInfrared = field(default_factory=DockInfrared)
    inertia: Inertia = field(default_factory=Inertia)
    cliff: Cliff = field(default_factory=Cliff)
    current: Current = field(default_factory=Current)
    gyro: RawGyro = field(default_factory=RawGyro)
    inputs: Inputs = field(default_factory=Inputs)

    def parts(self) -> list[Sensor]:
        """Return the parts, in the order in which the Kobuki sends them."""
        return [
            self.core, self.dock, self.inertia, self.cliff, self.current, self.gyro, self.inputs,
        ]  # fmt: skip

    def updated(self, parts: Iterable[object]) -> Feedback:
        """Return the feedback with the parts of a packet in place of earlier ones."""
        values: dict[str, Any] = {NAMES[type(p)]: p for p in parts if type(p) in NAMES}
        return replace(self, **values)


NAMES: dict[type, str] = {
    Core: "core", DockInfrared: "dock", Inertia: "inertia", Cliff: "cliff", Current: "current",
    RawGyro: "gyro", Inputs: "inputs",
}  # fmt: skip
