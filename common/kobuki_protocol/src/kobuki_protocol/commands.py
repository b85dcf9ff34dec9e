"""The commands of a driver to a Kobuki, and their packets."""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import Callable, ClassVar, Iterable, Sequence, Union, get_args

from kobuki_protocol.framing import packet, parse_parts, part
from kobuki_protocol.identity import Controller
from kobuki_protocol.packed_part import PackedPart

POWER_ON = 0x00F0  # all four supplies on, as the driver starts
LED_COLOURS = (0, 2, 3, 1)  # two bits, red and green, of kobuki_msgs' BLACK, GREEN, ORANGE, RED
MELODIES = ("on", "off", "recharge", "button", "error", "cleaning start", "cleaning end")
MOST_GAIN = 1 << 32  # in thousandths


@dataclass(frozen=True)
class BaseControl(PackedPart):
    """The motion of the wheels; see kobuki_protocol.base_control."""

    ID: ClassVar[int] = 1
    LAYOUT: ClassVar[Struct] = Struct("<2h")
    speed: int = 0  # [mm/s] of the outer wheel
    radius: int = 0  # [mm]; 0: straight on, 1: on the spot


@dataclass(frozen=True)
class Sound(PackedPart):
    """A note; the driver never sends this command."""

    ID: ClassVar[int] = 3
    LAYOUT: ClassVar[Struct] = Struct("<HB")
    note: int
    duration: int  # [ms]


@dataclass(frozen=True)
class SoundSequence(PackedPart):
    """One of the MELODIES."""

    ID: ClassVar[int] = 4
    LAYOUT: ClassVar[Struct] = Struct("<B")
    number: int

    @classmethod
    def of(cls, number: int) -> SoundSequence:
        """Return the command for a value of kobuki_msgs/Sound. Raises ValueError."""
        if not 0 <= number < len(MELODIES):
            raise ValueError(f"sound {number}: must be 0 to {len(MELODIES) - 1}")
        return cls(number)


@dataclass(frozen=True)
class IdentityRequest(PackedPart):
    """A request for versions and the unique id."""

    ID: ClassVar[int] = 9
    LAYOUT: ClassVar[Struct] = Struct("<H")
    HARDWARE: ClassVar[int] = 1
    FIRMWARE: ClassVar[int] = 2
    UNIQUE_ID: ClassVar[int] = 8
    flags: int = HARDWARE | FIRMWARE | UNIQUE_ID


@dataclass(frozen=True)
class Outputs(PackedPart):
    """Pins (bits 0 to 3), supplies (4 to 7), red and green of the LEDs (8, 9 and 10, 11)."""

    ID: ClassVar[int] = 12
    LAYOUT: ClassVar[Struct] = Struct("<H")
    bits: int = POWER_ON

    @property
    def leds(self) -> tuple[int, int]:
        """Return the colours of LED 1 and 2, as in kobuki_msgs/Led."""
        return LED_COLOURS.index(self.bits >> 8 & 3), LED_COLOURS.index(self.bits >> 10 & 3)

    def with_led(self, number: int, value: int) -> Outputs:
        """Return the outputs with LED 1 or 2 in a colour of kobuki_msgs/Led. Raises ValueError."""
        if not 0 <= value < len(LED_COLOURS):
            raise ValueError(f"led{number}: {value}: must be 0 to {len(LED_COLOURS) - 1}")
        shift = 8 if number == 1 else 10
        return self._with(3 << shift, LED_COLOURS[value] << shift)

    def with_pins(self, values: Sequence[bool], mask: Sequence[bool]) -> Outputs:
        """Return the outputs with the pins in the mask set to their values."""
        return self._with(bits_of(mask), bits_of(values))

    def with_power(self, source: int, state: int) -> Outputs:
        """Return the outputs with a supply, 0 to 3, on (1) or off (0). Raises ValueError."""
        for name, value, most in (("source", source, 3), ("state", state, 1)):
            if not 0 <= value <= most:
                raise ValueError(f"external_power: {name} {value}: must be 0 to {most}")
        return self._with(1 << (4 + source), state << (4 + source))

    def _with(self, mask: int, values: int) -> Outputs:
        return Outputs((self.bits & ~mask) | (values & mask))


@dataclass(frozen=True)
class SetController:
    """The gains for the Kobuki; firmware 1.2 and newer obeys."""

    ID: ClassVar[int] = 13
    wanted: Controller

    @classmethod
    def of(cls, kind: int, gains: Sequence[float]) -> SetController:
        """Return the command for the gains P, I and D. Raises ValueError."""
        if not all(0.0 <= gain * 1000.0 < MOST_GAIN for gain in gains):
            raise ValueError("controller_info: each gain must be 0 or more, and below 4294967")
        if kind not in (0, 1):
            raise ValueError(f"controller_info: type {kind}: must be 0 (factory) or 1 (own)")
        return cls(Controller(kind, tuple(int(gain * 1000.0) for gain in gains)))

    def data(self) -> bytes:
        """Return the data of the part."""
        return self.wanted.data()

    @classmethod
    def parse(cls, data: bytes) -> SetController:
        """Return the part with this data."""
        return cls(Controller.parse(data))


@dataclass(frozen=True)
class GetController(PackedPart):
    """A request for the gains."""

    ID: ClassVar[int] = 14
    LAYOUT: ClassVar[Struct] = Struct("<x")  # a byte without a meaning


Command = Union[
    BaseControl, Sound, SoundSequence, IdentityRequest, Outputs, SetController, GetController
]  # fmt: skip
PARSERS: dict[int, Callable[[bytes], Command]] = {c.ID: c.parse for c in get_args(Command)}


def bits_of(flags: Iterable[bool]) -> int:
    """Return the flags as a number, whose lowest bit is the first flag."""
    return sum(bool(is_on) << bit for bit, is_on in enumerate(flags))


def build(*commands: Command) -> bytes:
    """Return the packet with these commands."""
    return packet(b"".join(part(command.ID, command.data()) for command in commands))


def parse(payload: bytes) -> list[Command]:
    """Return the commands of a payload, without those of an unknown id or length."""
    return parse_parts(payload, PARSERS)
