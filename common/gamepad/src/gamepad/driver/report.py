"""What the driver tells on /diagnostics, with the keys of ROS Noetic's joy_node (pure)."""

SILENT_FOR = "joystick silent for (s)"  # beyond upstream's: since the device gave its last event


class DriverReport:
    """Counts, and tells once in a period. All times in seconds, of one clock that never jumps."""

    def __init__(self, parameters, topic):
        """parameters: driver_parameters.DriverParameters. topic: its full name."""
        self._parameters = parameters
        self._topic = topic
        self._open = False
        self._path, self._name = parameters.dev, parameters.dev_name
        self.published = 0  # messages so far
        self._next = -float("inf")
        self._before = None  # (time, events, messages) when it was told last

    def opened(self, path, name):
        """A gamepad was opened."""
        self._open, self._path, self._name = True, path, name
        self._next = -float("inf")  # tell it at once

    def lost(self):
        """The gamepad is gone."""
        self._open = False
        self._next = -float("inf")

    def due(self, now):
        """Whether to tell now; the next time is one period later."""
        if now < self._next:
            return False
        self._next = now + self._parameters.diagnostic_period
        return True

    def next_due(self, other):
        """The sooner of the next time to tell and another time."""
        return min(self._next, other)

    def look_at(self, now, period, not_before):
        """When to look for a missing gamepad again, or to tell, whichever is sooner."""
        look = not_before if not_before > now else now + period
        return self.next_due(look)

    def summary(self):
        """(all is well, in a few words)."""
        return (True, "OK") if self._open else (False, "Joystick not open.")

    def details(self, driver, subscribers, now):
        """Pairs of name and value. driver: driver.Driver."""
        events = driver.events
        began, events_then, published_then = self._before or (now, events, self.published)
        seconds = (now - began) or 1.0
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
            (SILENT_FOR, f"{now - driver.heard_at:.1f}" if self._open else "not open"),
            ("subscribers", subscribers),
            ("default trig val", p.default_trig_val),
            ("sticky buttons", p.sticky_buttons),
        ]
