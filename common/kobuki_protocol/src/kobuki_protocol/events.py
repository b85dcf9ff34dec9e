"""The events of a Kobuki: changes between two packets as messages of mobile_base/events."""

from __future__ import annotations

from typing import Iterator, Tuple, Union

from kobuki_msgs.msg import (
    BumperEvent,
    ButtonEvent,
    CliffEvent,
    DigitalInputEvent,
    PowerSystemEvent,
    WheelDropEvent,
)

from kobuki_protocol.battery import USUAL, Battery, Level, Limits
from kobuki_protocol.feedback import Core, Feedback

# Topic, message, and the field for the number of the sensor, in the order left, center, right.
EVENTS = (
    ("bumper", BumperEvent, "bumper"),
    ("cliff", CliffEvent, "sensor"),
    ("wheel_drop", WheelDropEvent, "wheel"),
)
QUEUE = 100  # events, of which none may be lost (kobuki_ros.cpp)
Message = Union[
    BumperEvent, ButtonEvent, CliffEvent, DigitalInputEvent, PowerSystemEvent, WheelDropEvent
]
Event = Tuple[str, Message]  # topic below mobile_base/events, and message
SIDES = (4, 2, 1)  # bits of left, center and right
WHEELS = (2, 1)  # bits of left and right
BUTTONS = (1, 2, 4)
PINS = (1, 2, 4, 8)


def _changed(before: int, now: int, bits: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    """Yield (index in bits, new value 0 or 1) of each bit that changed."""
    for number, bit in enumerate(bits):
        if (before ^ now) & bit:
            yield number, int(bool(now & bit))


def events(before: Feedback, now: Feedback, limits: Limits = USUAL) -> list[Event]:
    """Return the events between two packets; before the first packet: Feedback()."""
    old, new = before.core, now.core
    bottom = now.cliff.left, now.cliff.center, now.cliff.right
    made: list[Event] = [
        ("button", ButtonEvent(number, state))
        for number, state in _changed(old.buttons, new.buttons, BUTTONS)
    ]
    made += [
        ("bumper", BumperEvent(number, state))
        for number, state in _changed(old.bumper, new.bumper, SIDES)
    ]
    made += [
        ("cliff", CliffEvent(number, state, bottom[number]))
        for number, state in _changed(old.cliff, new.cliff, SIDES)
    ]
    made += [
        ("wheel_drop", WheelDropEvent(number, state))
        for number, state in _changed(old.wheel_drop, new.wheel_drop, WHEELS)
    ]
    made += [("power_system", event) for event in _power(old, new, limits)]
    pins = now.inputs.digital
    if any(_changed(before.inputs.digital, pins, PINS)):
        made.append(("digital_input", DigitalInputEvent([bool(pins & pin) for pin in PINS])))
    return made


def _power(old: Core, new: Core, limits: Limits) -> Iterator[PowerSystemEvent]:
    before, now = Battery.of(old, limits), Battery.of(new, limits)
    state = now.is_charged, now.is_charging
    if state != (before.is_charged, before.is_charging):
        if now.is_charged:
            yield PowerSystemEvent(PowerSystemEvent.CHARGE_COMPLETED)
        elif not now.is_charging:
            yield PowerSystemEvent(PowerSystemEvent.UNPLUGGED)
        elif now.source == "Adapter":
            yield PowerSystemEvent(PowerSystemEvent.PLUGGED_TO_ADAPTER)
        else:
            yield PowerSystemEvent(PowerSystemEvent.PLUGGED_TO_DOCKBASE)
    if now.voltage < before.voltage and now.level is not before.level:
        if now.level is Level.LOW:
            yield PowerSystemEvent(PowerSystemEvent.BATTERY_LOW)
        elif now.level is Level.DANGEROUS:
            yield PowerSystemEvent(PowerSystemEvent.BATTERY_CRITICAL)
