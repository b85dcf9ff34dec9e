"""Lines about the outputs that a driver sets: pins, power supplies and LEDs."""

from __future__ import annotations

from kobuki_protocol.commands import Outputs

COLOURS = ("off", "green", "orange", "red")  # of kobuki_msgs/Led
SUPPLIES = ("3.3 V", "5 V", "12 V 5 A", "12 V 1.5 A")  # bits 4 to 7
PINS = 4  # bits 0 to 3
SWITCHED = ("off", "on")


def changes(before: Outputs, after: Outputs) -> list[str]:
    """Return a line for each output that differs between two commands."""
    names = [*(f"digital output {pin}" for pin in range(PINS)), *(f"power {s}" for s in SUPPLIES)]
    lines = [
        f"{name}: {SWITCHED[after.bits >> bit & 1]}"
        for bit, name in enumerate(names)
        if (before.bits ^ after.bits) >> bit & 1
    ]
    for number, (was, colour) in enumerate(zip(before.leds, after.leds), 1):
        if was != colour:
            lines.append(f"LED {number}: {COLOURS[colour]}")
    return lines
