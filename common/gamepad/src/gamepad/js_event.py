"""The events of the Linux joystick device, from bytes and to bytes (pure).

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
INIT = 0x80  # added to the type: not a change, but the state at opening

# As the time of an INIT event: it only says that the source lives. Readers that do not know this
# see the state at opening once more. The kernel's clock shows it for 1 ms in 49 days.
SIGN_OF_LIFE_MS = 2**32 - 1

FULL = 32767  # value of an axis at its end


class JsEvent(NamedTuple):
    """One event. type: BUTTON or AXIS, with INIT or without; others are possible, but unknown."""

    time_ms: int
    value: int
    type: int
    number: int


def pack(event: JsEvent) -> bytes:
    """Return the 8 bytes of a JsEvent; struct.error if a value does not fit."""
    return _EVENT.pack(*event)


class Decoder:
    """Turns what is read from a device, cut anywhere, into events."""

    def __init__(self, late_init_is_change: bool = False) -> None:
        """Take whether to remove INIT from the events after the first change.

        The kernel sends the whole state again, as INIT, after its buffer of 64 events has run over.
        What had changed meanwhile stands only there, so for a kernel device this must be true.
        """
        self._rest = b""
        self._late_init_is_change = late_init_is_change
        self._changed = False

    def feed(self, data: bytes) -> list[JsEvent]:
        """Return the events that are complete with these bytes, oldest first."""
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
