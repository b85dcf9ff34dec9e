"""What the driver publishes, and when: from bytes and times to axes and buttons (pure)."""

from __future__ import annotations

import math
from typing import Iterable

from gamepad.driver.parameters import DriverParameters
from gamepad.driver.schedule import Schedule
from gamepad.driver.state import NOW, GamepadState, Message
from gamepad.js_event import INIT, SIGN_OF_LIFE_MS, Decoder

# After a loss a gamepad is not opened again for this time [s]: a node that stops on silence (0.5 s,
# joy2twist's ~joy_timeout) must have noticed, however quick the hand that plugs it in again.
SHORTEST_SILENCE_S = 0.6
# A source that has once given a sign of life and gives none for this time [s] is lost: three signs
# of our virtual gamepad, and less than joy2twist's ~joy_timeout. So is one that sends noise and no
# sign: a byte of it was lost, and everything after that would be noise.
LONGEST_LIFELESS_S = 0.45


class Driver:
    """One gamepad at a time: opened, read, lost, opened again.

    Every method is given the time `now` [s] of a clock that never jumps. A message is a pair of
    tuples: axes (floats from -1 to 1, left and up positive) and buttons (0 or 1).
    """

    def __init__(self, parameters: DriverParameters) -> None:
        self._parameters = parameters
        self._state: GamepadState | None = None  # the open gamepad
        self._told = False  # whether what was published may be driving a robot
        self._mute = False  # nothing is published until the user touches the gamepad
        self.opens_at = -math.inf  # not to be opened before this time
        self.unknown_events = 0  # events whose type linux/joystick.h lacks
        self.events = 0
        self.heard_at = -math.inf  # when the gamepad gave bytes last

    @property
    def due(self) -> float:
        """When tick() must be called next [s]; infinity if only bytes can bring something new."""
        if self._state is None:
            return math.inf
        return min(math.inf if self._mute else self._schedule.due, self._lifeless_at)

    def is_lifeless(self, now: float) -> bool:
        """Return whether the source, which owes signs of life, has given none for too long."""
        return self._state is not None and now >= self._lifeless_at

    def opened(self, triggers: Iterable[int] | None, kernel_device: bool) -> None:
        """Begin with a gamepad. triggers: numbers of the axes that rest at +1; None if unknown.

        kernel_device: whether the kernel serves it, and not a file or a FIFO.
        """
        p = self._parameters
        self._state = GamepadState(p.deadzone, p.default_trig_val, p.sticky_buttons)
        self._triggers = triggers
        self._decoder = Decoder(late_init_is_change=kernel_device)
        self._schedule = Schedule(p.coalesce_interval, p.autorepeat_rate)
        self._can_give_signs = not kernel_device
        self._lifeless_at = math.inf

    def read(self, data: bytes, now: float) -> list[Message]:
        """Take bytes that came from the gamepad; return the messages to publish, oldest first."""
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
            messages += self.tick(now)  # a quick press and release must not end up in one message
        return messages

    def tick(self, now: float) -> list[Message]:
        """Return the messages that are due by now: one or none."""
        if self._state is None or self._mute or now < self._schedule.due:
            return []
        self._schedule.published(now)
        self._told = True
        return [self._state.publish()]

    def lost(self, now: float) -> list[Message]:
        """Return the messages to publish at a loss: a neutral one, if any was before.

        The next gamepad sends nothing until the user touches it. What the kernel says of a
        gamepad at opening may be made up, and a made-up neutral position would arm a robot
        (node_kit.rules.released).
        """
        messages = [self._state.neutral(self._triggers)] if self._state and self._told else []
        self._state, self._told, self._mute = None, False, True
        self.opens_at = now + SHORTEST_SILENCE_S
        return messages
