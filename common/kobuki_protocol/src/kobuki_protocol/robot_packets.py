"""Conversion between packets of a Kobuki and their parts."""

from __future__ import annotations

from typing import Callable, Union, get_args

from kobuki_protocol import feedback, identity
from kobuki_protocol.framing import packet, parse_parts, part

RobotPart = Union[
    feedback.Sensor,
    identity.HardwareVersion,
    identity.FirmwareVersion,
    identity.UniqueId,
    identity.Controller,
]
PARSERS: dict[int, Callable[[bytes], RobotPart]] = {p.ID: p.parse for p in get_args(RobotPart)}


def build(*parts: RobotPart) -> bytes:
    """Return the packet in which a Kobuki sends these parts."""
    return packet(b"".join(part(value.ID, value.data()) for value in parts))


def parse(payload: bytes) -> list[RobotPart]:
    """Return the parts of a payload, without those of an unknown id or length."""
    return parse_parts(payload, PARSERS)
