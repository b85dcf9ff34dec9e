"""Teleoperation (Mapping, Safety, arming), judged by (a) to (f) and (h).

The meaning of a message follows joy2twist's documentation, not its code.
"""

import copy
import math
from typing import NamedTuple

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from node_kit.rules.arming import SETTLING_S, ZERO
from tutorial_faults.worlds import ROUNDING, SUSPENDED, TICK, World, beyond, moves

LEFT = "left"  # an event: no node publishes joystick messages
RELEASED = 0.1  # a stick within this part of its range is released
LARGEST = 1e6  # axes whose length as a vector is beyond this are noise


class Message(NamedTuple):
    sender: str
    axes: tuple
    buttons: tuple
    age_s: float = 0.0

    @property
    def wants(self):
        """Whether the stick is moved."""
        return moves(self.axes[:2])


class Meaning:
    """Whether a Message is good, holds the dead-man button, has all released, stops, resets."""

    def __init__(self, p):
        self._p = p
        self._dead_men = [b for b in (p.enable_button, p.enable_turbo_button) if b >= 0]
        self._last = max([*self._dead_men, p.stop_button, p.stop_reset_button])

    def is_good(self, joy):
        """Return whether it has all axes and buttons, usable numbers, and is not too old."""
        return (
            len(joy.axes) > 1
            and len(joy.buttons) > self._last
            and all(map(math.isfinite, joy.axes))
            and math.hypot(*joy.axes) <= LARGEST
            and joy.age_s <= (self._p.max_joy_age or math.inf)
        )

    def holds(self, joy):
        """Return whether it lets the robot move."""
        return self.is_good(joy) and (not self._p.require_enable_button or self._presses(joy))

    def is_released(self, joy):
        """Return whether it is good, with the sticks and any dead-man button released."""
        sticks = self.is_good(joy) and all(abs(axis) <= RELEASED for axis in joy.axes[:2])
        return sticks and not (self._p.require_enable_button and self._presses(joy))

    def stops(self, joy):
        """Return whether the stop button is pressed, in a good or a bad message."""
        button = self._p.stop_button
        return button >= 0 and any(joy.buttons[button : button + 1])

    def resets(self, joy):
        """Return whether it is good, with the reset button pressed and not the stop button."""
        pressed = self.is_good(joy) and joy.buttons[self._p.stop_reset_button]
        return bool(pressed) and not self.stops(joy)

    def _presses(self, joy):
        return any(joy.buttons[button] for button in self._dead_men)


class TeleoperationWorld(World):
    """The real Teleoperation, and the invariants that it must keep."""

    def __init__(self, **given):
        """given: private parameters of joy2twist."""
        p = self._p = load(given)
        self._meaning = Meaning(p)
        self._woken = []  # has an item if the node was woken during the current event
        self._machine = Teleoperation(p, lambda line: None, lambda: self._woken.append(True))
        self._suspensions = 0
        self._sent, self._has_moved = ZERO, False
        self._zeros = p.stop_messages  # sent since the last motion, at most p.stop_messages
        self._held_s = self._still_s = -math.inf  # the robot may move before both
        self._heard_s = -math.inf  # the last good message
        self._settled_s = -math.inf  # until then messages may be older than a suspension
        self._shown = self._sender = None  # newest good message
        self._armed = False  # all was seen released since the last start, silence or loss
        self._all_released = True  # in the last message, unless a loss came after it
        self._latched = False  # the stop button was pressed, and the reset button not yet
        self._is_reset = True  # after the reset button, all was seen released, too

    def happen(self, event):
        self._woken.clear()
        due, before, was_late = self._machine.due, self._sent, self._is_silent
        answer = self._answer(event, was_late)
        if answer is not None:
            yield from self._judge_velocity(answer)
            self._sent = answer
            self._zeros = 0 if moves(answer) else min(self._zeros + 1, self._p.stop_messages)
            self._has_moved = self._has_moved or moves(answer)
        moves_on = moves(before) and moves(answer or ZERO)
        if was_late and moves_on and not (self._p.arm_on_neutral and self._armed):
            yield "f", "no stop before a message that is late"
        yield from self._must_stand(event)
        yield from self._must_watch(event, due, answer)
        yield from self._must_go_on(event, answer, was_late)

    def _answer(self, event, was_late):
        """Let the event happen; return the velocity that is sent, if any."""
        if event == TICK:
            self._all_released = self._all_released and not was_late
            if moves(self._sent) and self.now >= self._still_s:
                self._lose()
            return self._machine.tick(self.now)
        if event == LEFT:
            self._lose()
            return self._machine.left(self.now)
        if event == SUSPENDED:
            self._lose()
            self._held_s, self._settled_s = min(self._held_s, self.now), self.now + SETTLING_S
            self._suspensions += 1
            return self._machine.suspended(self._suspensions, self.now)
        self._hear(event)
        age_ns = round(event.age_s * 1e9)
        return self._machine.joy(event.axes, event.buttons, self.now, age_ns, event.sender)

    @property
    def _is_silent(self):
        return self.now - self._heard_s >= (self._p.joy_timeout or math.inf)

    @property
    def _until_s(self):
        return min(self._held_s, self._still_s)

    def _lose(self):
        self._armed = self._all_released = False

    def _hear(self, joy):
        if self.now >= self._settled_s:
            self._believe(joy)
        if self._meaning.stops(joy) or self._latched:
            self._is_reset = False
            self._latched = self.now < self._settled_s or not self._meaning.resets(joy)
            self._lose()
        elif self._all_released:
            self._is_reset = True

    def _believe(self, joy):
        self._all_released = self._meaning.is_released(joy)
        holds, timeout_s = self._meaning.holds(joy), self._p.joy_timeout or math.inf
        self._held_s = self.now + timeout_s if holds else min(self._held_s, self.now)
        if self._meaning.is_good(joy):
            shown, self._shown = self._shown, (joy.axes, joy.buttons)
            if shown != self._shown:
                self._still_s = self.now + (self._p.vigilance_timeout or math.inf)
            self._armed = self._armed and joy.sender == self._sender and not self._is_silent
            self._armed = self._armed or self._all_released
            self._sender, self._heard_s = joy.sender, self.now
        if holds and joy.wants and self.now >= self._still_s:
            self._lose()

    def _judge_velocity(self, velocity):
        p = self._p
        yield from beyond(velocity, p.max_linear_speed or math.inf, p.max_angular_speed or math.inf)
        if not moves(velocity):
            return
        if self.now >= self._until_s:
            yield "a", f"{velocity} without a dead-man button held"
        if p.arm_on_neutral and not self._armed:
            yield "b", f"{velocity} before all was seen released"
        change = math.hypot(*(new - old for new, old in zip(velocity[:3], self._sent[:3])))
        most = (p.max_linear_acceleration or math.inf) / p.output_rate
        if change > most * (1 + ROUNDING):
            yield "c", f"from {self._sent[0]} to {velocity[0]} at once"

    def _must_stand(self, event):
        """Yield what is wrong with the velocity that the robot keeps until the next one."""
        arms, due = self._p.arm_on_neutral, self._machine.due
        is_due = isinstance(event, Message) and due <= self.now < self._held_s
        for must_stand, why in (
            (self.now >= self._until_s and not is_due, "no dead-man button is held"),
            (arms and not self._armed, "all must be seen released first"),
            (event in (LEFT, SUSPENDED), str(event)),
            (not self._is_reset, "the stop button was pressed"),
            (due > self._until_s, "silence will be noticed too late"),
        ):
            if must_stand and moves(self._sent):
                yield "d", f"no stop: {why}"
        stands = self._all_released if arms else not moves(self._sent)
        if self._machine.released and self._has_moved and not stands:
            yield "b", "a robot that was lost is driven on"

    def _must_watch(self, event, due, answer):
        """Yield what is wrong with the time of the next call, and with repeated stops."""
        machine, p = self._machine, self._p
        if machine.due < due and not self._woken:
            yield "d", "something is due sooner, and the node is not woken"
        is_last = machine.due > self.now + 1.0 / p.output_rate
        if self._latched and is_last:
            yield "e", "a robot that was stopped by its button is left to other inputs"
        if event == TICK and self._never_sleeps():
            yield "d", "the node is never let sleep"
        is_over = self.now >= self._until_s and p.require_enable_button
        if answer is not None and is_over and self._zeros < p.stop_messages and is_last:
            yield "d", "a stop is not repeated"

    def _never_sleeps(self):
        machine = copy.deepcopy(self._machine)
        for _ in range(self._p.stop_messages):
            if machine.due > self.now:
                return False
            machine.tick(self.now)
        return machine.due <= self.now

    def _must_go_on(self, event, answer, was_late):
        """Yield (h) if a dead-man button that is held, in time and armed, does not drive."""
        p = self._p
        ramps = p.max_linear_acceleration > 0 or p.max_angular_acceleration > 0
        if not isinstance(event, Message) or ramps or was_late or self.now < self._settled_s:
            return
        may = self._meaning.holds(event) and (self._armed or not p.arm_on_neutral)
        may = may and self.now < self._still_s and self._is_reset
        if may and event.wants and not moves(answer or ZERO):
            yield "h", "the dead-man is held, and the robot is not driven"
