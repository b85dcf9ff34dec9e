"""What the driver publishes, and when: from bytes and times to axes and buttons."""

from __future__ import annotations

import math
from typing import Iterable

from gamepad.driver.parameters import DriverParameters
from gamepad.driver.schedule import Schedule
from gamepad.driver.state import NOW, GamepadState, Message
from gamepad.js_event import INIT, SIGN_OF_LIFE_MS, Decoder

# After a loss, a gamepad is not reopened for this time [s], however quickly it is plugged in again:
# a node that stops on silence (0.5 s, joy2twist's ~joy_timeout) must detect the loss.
SHORTEST_SILENCE_S = 0.6
# A source that has sent a sign of life is lost if it sends none for this time [s]: three periods of
# our virtual gamepad, and less than joy2twist's ~joy_timeout. So is one that sends noise without a
# sign: a byte was lost, so that all later events are noise.
LONGEST_LIFELESS_S = 0.45


class Driver:
    """One gamepad at a time: opened, read, lost and reopened.

    Every method takes the time `now` [s] of a clock that never jumps. A message is a pair of
    tuples: axes (floats from -1 to 1, left and up positive) and buttons (0 or 1).
    """

    def __init__(self, parameters: DriverParameters) -> None:
        self._parameters = parameters
        self._state: GamepadState | None = None  # the open gamepad
        self._may_drive = False  # a published message may drive a robot
        self._mute = False  # nothing is published until the user touches the gamepad
        self.opens_at = -math.inf  # earliest time to open it
        self.unknown_events = 0  # events whose type linux/joystick.h lacks
        self.events = 0
        self.heard_at = -math.inf  # when the last bytes arrived

    @property
    def due(self) -> float:
        """When tick() must be called next [s]; infinity if only new bytes can change the state."""
        if self._state is None:
            return math.inf
        return min(math.inf if self._mute else self._schedule.due, self._lifeless_at)

    def is_lifeless(self, now: float) -> bool:
        """Return whether a source that sends signs of life has sent none for too long."""
        return self._state is not None and now >= self._lifeless_at

    def opened(self, triggers: Iterable[int] | None, kernel_device: bool) -> None:
        """Start with a gamepad. triggers: numbers of the axes that rest at +1; None if unknown.

        kernel_device: whether it is a device of the kernel, not a file or a FIFO.
        """
        p = self._parameters
        self._state = GamepadState(p.deadzone, p.default_trig_val, p.sticky_buttons)
        self._triggers = triggers
        self._decoder = Decoder(late_init_is_change=kernel_device)
        self._schedule = Schedule(p.coalesce_interval, p.autorepeat_rate)
        self._can_give_signs = not kernel_device
        self._lifeless_at = math.inf

    def read(self, data: bytes, now: float) -> list[Message]:
        """Take bytes from the gamepad; return the messages to publish, oldest first."""
        messages: list[Message] = []
        self.heard_at = now
        assert self._state
        for event in self._decoder.feed(data):
            self.events += 1
            initial = event.type & INIT
            if initial and event.time_ms == SIGN_OF_LIFE_MS and self._can_give_signs:
                self._lifeless_at = now + LONGEST_LIFELESS_S
                if self._state.knows(event):
                    continue
            urgency = self._state.apply(event)
            if not urgency:
                self.unknown_events += 1
                if self._can_give_signs:
                    self._lifeless_at = min(self._lifeless_at, now + LONGEST_LIFELESS_S)
                continue
            if not initial:
                self._mute = False
            if urgency == NOW:
                self._schedule.at_once(now)
            else:
                self._schedule.soon(now)
            messages += self.tick(now)  # a quick press and release must not share a message
        return messages

    def tick(self, now: float) -> list[Message]:
        """Return the messages that are due: one or none."""
        if self._state is None or self._mute or now < self._schedule.due:
            return []
        self._schedule.published(now)
        self._may_drive = True
        return [self._state.publish()]

    def lost(self, now: float) -> list[Message]:
        """Return the messages to publish at a loss: a neutral one, unless none was published.

        The next gamepad publishes nothing until the user touches it. The kernel can make up the
        state at opening, and a made-up neutral position would arm a robot
        (node_kit.rules.released).
        """
        messages = [self._state.neutral(self._triggers)] if self._state and self._may_drive else []
        self._state, self._may_drive, self._mute = None, False, True
        self.opens_at = now + SHORTEST_SILENCE_S
        return messages
