"""The answers of a Kobuki to requests: its versions, its unique id and its gains."""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import ClassVar

from kobuki_protocol.packed_part import Version

SUPPORTED_MAJOR = 1  # other major versions of the firmware have other protocols
# Versions of the first firmware, in two bytes (firmware.hpp): patch, minor, major.
OLD_STYLE = {
    123: (0, 0, 1), 110: (0, 1, 1), 10100: (0, 1, 1), 111: (1, 1, 1), 10101: (1, 1, 1),
}  # fmt: skip
RECOMMENDED = (1, 1, 4)  # by its driver, which accepts newer ones (firmware.cpp)


@dataclass(frozen=True)
class HardwareVersion(Version):
    """The version of the board."""

    ID: ClassVar[int] = 10


@dataclass(frozen=True)
class FirmwareVersion(Version):
    """The version of the firmware."""

    ID: ClassVar[int] = 11

    @property
    def is_supported(self) -> bool:
        """Return whether this package knows its protocol."""
        return self.major == SUPPORTED_MAJOR

    @property
    def is_recommended(self) -> bool:
        """Return whether it is at least the recommended version."""
        return self.is_supported and (self.major, self.minor, self.patch) >= RECOMMENDED

    @classmethod
    def parse(cls, data: bytes) -> FirmwareVersion:
        """Return the part with this data."""
        number = int.from_bytes(data, "little")
        if len(data) == 2 and number in OLD_STYLE:
            return cls(*OLD_STYLE[number])
        return cls(*cls.LAYOUT.unpack(data))


@dataclass(frozen=True)
class UniqueId:
    """The unique id of the processor, in three words."""

    ID: ClassVar[int] = 19
    LAYOUT: ClassVar[Struct] = Struct("<3I")
    words: tuple[int, ...]

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(*self.words)

    @classmethod
    def parse(cls, data: bytes) -> UniqueId:
        """Return the part with this data."""
        return cls(cls.LAYOUT.unpack(data))


@dataclass(frozen=True)
class Controller:
    """The gains of the wheel speed controller."""

    ID: ClassVar[int] = 21
    LAYOUT: ClassVar[Struct] = Struct("<B3I")
    kind: int = 0  # 0: factory gains, 1: own gains
    gains: tuple[int, ...] = (100_000, 100, 2_000)  # P, I, D in thousandths

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(self.kind, *self.gains)

    @classmethod
    def parse(cls, data: bytes) -> Controller:
        """Return the part with this data."""
        kind, *gains = cls.LAYOUT.unpack(data)
        return cls(kind, tuple(gains))
