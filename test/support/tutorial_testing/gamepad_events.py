"""The bytes that a gamepad sends, and a driver that reads them."""

import struct

from gamepad.driver.driver import Driver
from gamepad.driver.parameters import DriverParameters

BUTTON, AXIS, INIT = 1, 2, 0x80  # linux/joystick.h


def driver(kernel_device=True, triggers=(), **parameters):
    """Return a driver with an open gamepad."""
    new = Driver(DriverParameters(**parameters))
    new.opened(triggers, kernel_device)
    return new


def events(*fields, time_ms=0):
    """Return the bytes of events, given as (type, number, value)."""
    return b"".join([struct.pack("=IhBB", time_ms, value, kind, n) for kind, n, value in fields])


def sign(*fields):
    """Return the bytes of a sign of life, given as (type, number, value)."""
    return events(*((kind | INIT, n, value) for kind, n, value in fields), time_ms=2**32 - 1)
