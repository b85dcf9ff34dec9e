"""What a Kobuki answers on request: its versions, its number, and the gains of its wheels."""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import ClassVar

from kobuki_protocol.packed_part import Version

DRIVEN_MAJOR = 1  # another major version of the firmware has another protocol
# How the first firmware wrote its version, in two bytes (firmware.hpp): patch, minor, major.
OLD_STYLE = {
    123: (0, 0, 1), 110: (0, 1, 1), 10100: (0, 1, 1), 111: (1, 1, 1), 10101: (1, 1, 1),
}  # fmt: skip
RECOMMENDED = (1, 1, 4)  # or newer, by its driver (firmware.cpp)


@dataclass(frozen=True)
class HardwareVersion(Version):
    """The version of the board."""

    ID: ClassVar[int] = 10


@dataclass(frozen=True)
class FirmwareVersion(Version):
    """The version of the program in the Kobuki."""

    ID: ClassVar[int] = 11

    @property
    def is_driven(self) -> bool:
        """Return whether its protocol is the one of this package."""
        return self.major == DRIVEN_MAJOR

    @property
    def is_recommended(self) -> bool:
        """Return whether it is one of those that the driver was made for."""
        return self.is_driven and (self.major, self.minor, self.patch) >= RECOMMENDED

    @classmethod
    def parse(cls, data: bytes) -> FirmwareVersion:
        """Return the part of these data."""
        number = int.from_bytes(data, "little")
        if len(data) == 2 and number in OLD_STYLE:
            return cls(*OLD_STYLE[number])
        return cls(*cls.LAYOUT.unpack(data))


@dataclass(frozen=True)
class UniqueId:
    """The number of the processor, in three words."""

    ID: ClassVar[int] = 19
    LAYOUT: ClassVar[Struct] = Struct("<3I")
    words: tuple[int, ...]

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(*self.words)

    @classmethod
    def parse(cls, data: bytes) -> UniqueId:
        """Return the part of these data."""
        return cls(cls.LAYOUT.unpack(data))


@dataclass(frozen=True)
class Controller:
    """The gains of the controller of the wheels' speeds."""

    ID: ClassVar[int] = 21
    LAYOUT: ClassVar[Struct] = Struct("<B3I")
    kind: int = 0  # 0: those of the factory, 1: own ones
    gains: tuple[int, ...] = (100_000, 100, 2_000)  # P, I, D in thousandths

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(self.kind, *self.gains)

    @classmethod
    def parse(cls, data: bytes) -> Controller:
        """Return the part of these data."""
        kind, *gains = cls.LAYOUT.unpack(data)
        return cls(kind, tuple(gains))
