"""Packets of a Kobuki's serial line: the frame, and what the robot sends 50 times a second (pure).

All numbers are little-endian. A packet is a header, the length of its payload, the payload and a
checksum; the payload is a row of parts, each with its id and length.
"""

from __future__ import annotations

import struct
from functools import reduce
from math import degrees
from operator import xor
from typing import Any, Iterable, Sequence, Tuple

HEADER = b"\xaa\x55"
Reading = Tuple[float, float, float]  # turn rates of the robot about x, y, z [rad/s]
DIGIT = 0.00875  # [deg/s] of the gyro L3G4200D
INT16 = (-(1 << 15), (1 << 15) - 1)


def packet(*parts: bytes) -> bytes:
    """Return parts as a packet; the exclusive or of all bytes behind the header is 0."""
    payload = b"".join(parts)
    body = bytes([len(payload)]) + payload
    return HEADER + body + bytes([reduce(xor, body)])


def part(number: int, layout: str, *values: Any) -> bytes:
    """Return one part of a payload: its id, and values in the layout of the module struct."""
    data = struct.pack(f"<{layout}", *values)
    return bytes([number, len(data)]) + data


def bits(flags: Iterable[bool]) -> int:
    """Return a number whose lowest bit is the first flag."""
    return sum(bool(is_on) << bit for bit, is_on in enumerate(flags))


def int16(value: float) -> int:
    """Return a number without its fraction, cut to 16 bits, as the Kobuki's driver does."""
    return int(min(max(value, INT16[0]), INT16[1]))


def core(state: Any) -> bytes:
    """Return the basic sensors, from the fields of a kobuki_msgs/SensorState."""
    return part(
        1, "H3B2H2b4B",
        state.time_stamp, state.bumper, state.wheel_drop, state.cliff,
        state.left_encoder, state.right_encoder, state.left_pwm, state.right_pwm,
        state.buttons, state.charger, state.battery, state.over_current,
    )  # fmt: skip


def dock_ir(right: int, center: int, left: int) -> bytes:
    """Return what the three receivers see of a docking station."""
    return part(3, "3B", right, center, left)


def inertia(angle: float, rate: float) -> bytes:
    """Return the gyro's heading [rad] and its rate [rad/s], sent in 0.01 deg."""
    return part(4, "2h3x", *(int16(100 * degrees(value)) for value in (angle, rate)))


def cliff(bottom: Sequence[int]) -> bytes:
    """Return the voltages of the right, center and left cliff sensor, 0 to 4095."""
    return part(5, "3H", *bottom)


def current(amount: Sequence[int]) -> bytes:
    """Return the currents of the left and the right motor [10 mA]."""
    return part(6, "2B", *amount)


def raw_gyro(frame: int, readings: Iterable[Reading]) -> bytes:
    """Return readings of the gyro, 10 ms apart; it is mounted turned by 90 degrees.

    frame: counts the readings, in 8 bits.
    """
    digits = [int16(degrees(rate) / DIGIT) for x, y, z in readings for rate in (y, -x, z)]
    return part(13, f"2B{len(digits)}h", frame % 256, len(digits), *digits)


def inputs(digital: int, analog: Sequence[int]) -> bytes:
    """Return the state of the digital inputs, by bit, and of the four analog ones, 0 to 4095."""
    return part(16, "5H6x", digital, *analog)
