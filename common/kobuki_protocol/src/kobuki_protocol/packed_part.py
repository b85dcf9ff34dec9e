"""Parts of a packet whose fields, in their order, are the values of a struct layout."""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import ClassVar, TypeVar

_Part = TypeVar("_Part", bound="PackedPart")


class PackedPart:
    """The base class of such parts, which are dataclasses."""

    LAYOUT: ClassVar[Struct]

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.LAYOUT.pack(*vars(self).values())

    @classmethod
    def parse(cls: type[_Part], data: bytes) -> _Part:
        """Return the part with this data. Raises struct.error."""
        return cls(*cls.LAYOUT.unpack(data))


@dataclass(frozen=True)
class Version(PackedPart):
    """A version as a part."""

    LAYOUT: ClassVar[Struct] = Struct("<3Bx")
    patch: int
    minor: int
    major: int

    def __str__(self) -> str:
        """Return the version as major.minor.patch."""
        return f"{self.major}.{self.minor}.{self.patch}"
