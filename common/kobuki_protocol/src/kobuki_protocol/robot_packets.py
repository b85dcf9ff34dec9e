"""Conversion between packets of a Kobuki and their parts."""

from __future__ import annotations

import struct
from typing import Union

from kobuki_protocol import feedback, identity
from kobuki_protocol.framing import packet, part, split

RobotPart = Union[
    feedback.Sensor,
    identity.HardwareVersion,
    identity.FirmwareVersion,
    identity.UniqueId,
    identity.Controller,
]
KINDS: dict[int, type[RobotPart]] = {
    kind.ID: kind
    for kind in (
        feedback.Core, feedback.DockInfrared, feedback.Inertia, feedback.Cliff, feedback.Current,
        feedback.RawGyro, feedback.Inputs, identity.HardwareVersion, identity.FirmwareVersion,
        identity.UniqueId, identity.Controller,
    )
}  # fmt: skip


def build(*parts: RobotPart) -> bytes:
    """Return the packet in which a Kobuki sends these parts."""
    return packet(b"".join(part(value.ID, value.data()) for value in parts))


def parse(payload: bytes) -> list[RobotPart]:
    """Return the parts of a payload, without those of an unknown id or length."""
    parts: list[RobotPart] = []
    for number, data in split(payload):
        try:
            if number in KINDS:
                parts.append(KINDS[number].parse(data))
        except struct.error:
            continue
    return parts
