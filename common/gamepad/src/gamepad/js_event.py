"""The events of the Linux joystick device, from and to bytes.

Source: linux/joystick.h. An event has 8 bytes in the machine's own byte order: time [ms] (u32),
value (s16), type (u8), number of the button or axis (u8).
"""

from __future__ import annotations

import struct
from typing import NamedTuple

_EVENT = struct.Struct("=IhBB")
EVENT_BYTES = _EVENT.size

BUTTON = 0x01
AXIS = 0x02
INIT = 0x80  # flag in the type: the state at opening, not a change

# The time of an INIT event that is a sign of life. Other readers see it as the state at opening,
# repeated. The kernel's clock has this value for 1 ms in 49 days.
SIGN_OF_LIFE_MS = 2**32 - 1

FULL = 32767  # value of an axis at full deflection


class JsEvent(NamedTuple):
    """An event. type: BUTTON or AXIS, with or without INIT; other types are unknown."""

    time_ms: int
    value: int
    type: int
    number: int


def pack(event: JsEvent) -> bytes:
    """Return the 8 bytes of a JsEvent. Raises struct.error if a value does not fit."""
    return _EVENT.pack(*event)


class Decoder:
    """Turns bytes from a device, cut anywhere, into events."""

    def __init__(self, late_init_is_change: bool = False) -> None:
        """Take whether to remove INIT from the events after the first change.

        For a kernel device this must be true: after an overflow of its buffer of 64 events, the
        kernel sends the whole state again, as INIT, and the lost changes are only there.
        """
        self._rest = b""
        self._late_init_is_change = late_init_is_change
        self._changed = False

    def feed(self, data: bytes) -> list[JsEvent]:
        """Return the events that these bytes complete, oldest first."""
        data = self._rest + data
        whole = len(data) - len(data) % EVENT_BYTES
        self._rest = data[whole:]
        return [self._checked(JsEvent(*fields)) for fields in _EVENT.iter_unpack(data[:whole])]

    def _checked(self, event: JsEvent) -> JsEvent:
        if not event.type & INIT:
            self._changed = True
        elif self._changed and self._late_init_is_change:
            return event._replace(type=event.type & ~INIT)
        return event
