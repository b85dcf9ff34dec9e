"""Packets for a Kobuki: what its driver sends for each command (pure)."""

from __future__ import annotations

from typing import Sequence

from fake_turtlebot_sim.kobuki_protocol.packets import bits, int16, packet, part

WHEEL_SEPARATION_MM = 230.0
SMALL = 1e-4  # [m/s, rad/s] Less counts as zero.
POWER_ON = 0x00F0  # All four supplies are on, as the driver starts.
LED_COLOURS = (0, 2, 3, 1)  # two bits, red and green, of kobuki_msgs' BLACK, GREEN, ORANGE, RED
SOUNDS = 7


def speed_and_radius(v: float, w: float) -> tuple[int, int]:
    """Return v [m/s] and w [rad/s] as a Kobuki takes them: speed [mm/s] and radius [mm].

    A radius of 0 is straight ahead, one of 1 a turn on the spot. Otherwise the speed is that of the
    outer wheel.
    """
    half = 0.5 * WHEEL_SEPARATION_MM
    if abs(w) < SMALL:
        return int16(1000.0 * v), 0
    radius = 1000.0 * v / w
    if abs(v) < SMALL or abs(radius) <= 1.0:
        return int16(half * w), 1
    return int16((radius + (half if radius > 0.0 else -half)) * w), int16(radius)


def control_values(v: float, w: float) -> list[int]:
    """Return what debug/raw_control_command has: speed and radius, then [mm/s] and [mrad/s]."""
    return [*speed_and_radius(v, w), int16(1000.0 * v), int16(1000.0 * w)]


def base_control(v: float, w: float) -> bytes:
    """Return the packet of a velocity [m/s, rad/s]."""
    return packet(part(1, "2h", *speed_and_radius(v, w)))


def sound(number: int) -> bytes:
    """Return the packet that plays one of the Kobuki's melodies. Raises ValueError."""
    if not 0 <= number < SOUNDS:
        raise ValueError(f"sound {number}: there are 0 to {SOUNDS - 1}")
    return packet(part(4, "B", number))


def controller(kind: int, gains: Sequence[float]) -> bytes:
    """Return the packet that sets the gains P, I and D of the wheels. Raises ValueError."""
    if not all(0.0 <= gain * 1000.0 < 1 << 32 for gain in gains):
        raise ValueError("controller_info: each gain must be 0 or more, and below 4294967")
    return packet(part(13, "B3I", kind, *(int(gain * 1000.0) for gain in gains)))


class Outputs:
    """The outputs of a Kobuki, which share one command: pins, supplies and LEDs."""

    def __init__(self) -> None:
        """Begin as the driver does."""
        self._bits = POWER_ON

    def led(self, number: int, value: int) -> bytes:
        """Return the packet that gives LED 1 or 2 a colour of kobuki_msgs/Led."""
        if not 0 <= value < len(LED_COLOURS):
            raise ValueError(f"led{number}: {value}: there are 0 to {len(LED_COLOURS) - 1}")
        shift = 8 if number == 1 else 10
        return self._set(3 << shift, LED_COLOURS[value] << shift)

    def digital(self, values: Sequence[bool], mask: Sequence[bool]) -> bytes:
        """Return the packet that sets the pins (of four) that the mask names."""
        return self._set(bits(mask), bits(values))

    def power(self, source: int, state: int) -> bytes:
        """Return the packet that switches one of the four supplies on (1) or off (0)."""
        for name, value, most in (("source", source, 3), ("state", state, 1)):
            if not 0 <= value <= most:
                raise ValueError(f"external_power: {name} {value}: there are 0 to {most}")
        return self._set(1 << (4 + source), state << (4 + source))

    def _set(self, mask: int, values: int) -> bytes:
        self._bits = (self._bits & ~mask) | (values & mask)
        return packet(part(12, "H", self._bits))
