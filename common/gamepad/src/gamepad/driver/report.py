"""The driver's status for /diagnostics, with the keys of ROS Noetic's joy_node."""

from __future__ import annotations

from math import inf
from typing import Any

from gamepad.driver.driver import Driver
from gamepad.driver.parameters import DriverParameters

SILENT_FOR = "joystick silent for (s)"  # not in upstream: time since the last event of the device


class DriverReport:
    """Counts messages, and reports once a period. Times in seconds, of a clock that never jumps."""

    def __init__(self, parameters: DriverParameters, topic: str) -> None:
        """Take the full name of the topic."""
        self._parameters, self._topic = parameters, topic
        self._path, self._name = parameters.dev, parameters.dev_name
        self._is_open = False
        self.published = 0  # messages so far
        self.next = -inf  # when to report again [s]
        self._before = (-inf, 0, 0)  # (time, events, messages) at the last report

    def opened(self, path: str, name: str) -> None:
        """Record that a gamepad was opened, which is reported at once."""
        self._is_open, self._path, self._name, self.next = True, path, name, -inf

    def lost(self) -> None:
        """Record that the gamepad was lost, which is reported at once."""
        self._is_open, self.next = False, -inf

    def due(self, now: float) -> bool:
        """Return whether to report now; the next time is one period later."""
        if now < self.next:
            return False
        self.next = now + self._parameters.diagnostic_period
        return True

    def summary(self) -> tuple[bool, str]:
        """Return (whether all is well, a summary)."""
        return (True, "OK") if self._is_open else (False, "Joystick not open.")

    def details(self, driver: Driver, subscribers: int, now: float) -> list[tuple[str, Any]]:
        """Return pairs of name and value."""
        events = driver.events
        began, events_then, published_then = self._before
        seconds = (now - began) or inf
        self._before = (now, events, self.published)
        p = self._parameters
        return [
            ("topic", self._topic),
            ("device", self._path),
            ("device name", self._name),
            ("dead zone", p.deadzone),
            ("autorepeat rate (Hz)", p.autorepeat_rate),
            ("coalesce interval (s)", p.coalesce_interval),
            ("recent joystick event rate (Hz)", (events - events_then) / seconds),
            ("recent publication rate (Hz)", (self.published - published_then) / seconds),
            (SILENT_FOR, f"{now - driver.heard_at:.1f}" if self._is_open else "not open"),
            ("subscribers", subscribers),
            ("default trig val", p.default_trig_val),
            ("sticky buttons", p.sticky_buttons),
        ]
