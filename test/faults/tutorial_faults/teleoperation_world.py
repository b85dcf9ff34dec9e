"""Teleoperation (Mapping, Safety, arming), judged by (a), (b), (c) and (d)."""

import copy
import math
from typing import NamedTuple

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from node_kit.arming import SETTLING_S, ZERO
from tutorial_faults.invariants import HeldDeadMan, Joy, Loss, SeenReleased, Twist, WithinLimits
from tutorial_faults.meaning import Meaning
from tutorial_faults.worlds import SUSPENDED, TICK, World, moves

LEFT = "left"  # an event: no node publishes joystick messages


class Message(NamedTuple):
    """A message of a joystick node."""

    sender: str
    axes: tuple
    buttons: tuple
    age_s: float = 0.0


class TeleoperationWorld(World):
    """The real Teleoperation, and the invariants that it must keep."""

    def __init__(self, **given):
        """given: private parameters of joy2twist."""
        p = self._parameters = load(given)
        self._ramps = p.max_linear_acceleration > 0 or p.max_angular_acceleration > 0
        self._woken = []  # of the transition that is made just now
        self._machine = Teleoperation(p, lambda line: None, lambda: self._woken.append(True))
        self._suspensions = 0
        self._sent = ZERO
        self._zeros = p.stop_messages  # sent since the last motion, as far as they count
        self._has_moved = False
        self._all_released = True  # by the last message, if no loss came after it
        meaning = self._meaning = Meaning(
            (0, 1), p.enable_button, p.enable_turbo_button, p.require_enable_button,
            max_age_s=p.max_joy_age, stop=p.stop_button, reset=p.stop_reset_button,
        )  # fmt: skip
        self._held = HeldDeadMan(p.joy_timeout, meaning.holds, p.vigilance_timeout, meaning.is_good)
        self._latched = False  # the stop button was pressed, and not yet the reset button
        self._is_reset = True  # since then all was seen released after the reset button, too
        self._armed = SeenReleased(p.joy_timeout, meaning.is_good, meaning.is_released)
        self._limits = WithinLimits(p.max_linear_speed or math.inf, p.max_angular_speed or math.inf)

    def happen(self, event):
        self._woken.clear()
        due, sent, was_late = self._machine.safety.due, self._sent, self._is_silent
        if event == TICK:
            self._all_released = self._all_released and not was_late
            if moves(sent) and self.now >= self._held.still_s:
                self._lose(Loss(self.now, "joystick that does not change"))
            answer = self._machine.safety.tick(self.now)
        elif event == LEFT:
            self._lose(Loss(self.now, "joystick node"))
            answer = self._machine.left(self.now)
        elif event == SUSPENDED:
            self._lose(Loss(self.now, "joy2twist", SETTLING_S))
            self._suspensions += 1
            answer = self._machine.suspended(self._suspensions, self.now)
        else:
            answer = self._hear(event)
        if answer is not None:
            yield from self._judge_velocity(answer, sent)
            self._sent = answer
            self._zeros = (
                0 if moves(answer) else min(self._zeros + 1, self._parameters.stop_messages)
            )
            self._has_moved = self._has_moved or moves(answer)
        is_rearmed = self._arms and self._armed.armed  # by this message, as silence disarms
        if was_late and not is_rearmed and moves(sent) and moves(answer or ZERO):
            yield "f", "no stop before a message that is late"
        yield from self._must_stand(event)
        yield from self._must_watch(event, due, answer)
        yield from self._must_go_on(event, answer, was_late)

    @property
    def _is_silent(self):
        return self.now - self._armed.heard_s >= (self._parameters.joy_timeout or math.inf)

    def _lose(self, loss):
        self._held.take(loss)
        self._armed.take(loss)
        self._all_released = False

    def _hear(self, message):
        joy = Joy(self.now, *message)
        if joy.at_s >= self._armed.settled_s:
            self._all_released = self._meaning.is_released(joy)
        self._held.take(joy)
        self._armed.take(joy)
        wants = self._meaning.holds(joy) and moves(joy.axes[:2])
        if wants and joy.at_s >= max(self._held.still_s, self._armed.settled_s):
            self._lose(Loss(self.now, "joystick that does not change"))
        if self._meaning.stops(joy) or self._latched:
            self._is_reset = False
            self._latched = joy.at_s < self._armed.settled_s or not self._meaning.resets(joy)
            self._lose(Loss(self.now, "stop button"))
        elif self._all_released:
            self._is_reset = True
        return self._machine.joy(
            joy.axes, joy.buttons, self.now, round(joy.age_s * 1e9), joy.sender
        )

    def _judge_velocity(self, velocity, before):
        twist = Twist(self.now, velocity)
        judges = (self._held, self._limits, *([self._armed] if self._arms else []))
        for violation in filter(None, (judge.take(twist) for judge in judges)):
            yield violation.invariant, violation.what
        change = math.hypot(*(new - old for new, old in zip(velocity[:3], before[:3])))
        most = (self._parameters.max_linear_acceleration or math.inf) / self._parameters.output_rate
        if moves(velocity) and change > most * (1 + 1e-9):
            yield "c", f"from {before[0]} to {velocity[0]} at once"

    @property
    def _arms(self):
        return self._parameters.arm_on_neutral

    def _must_stand(self, event):
        """Yield what is wrong with the velocity that the robot keeps until the next one."""
        if moves(self._sent):
            if self.now >= self._held.until_s:
                yield "d", "no stop, though no dead-man button is held"
            if self._arms and not self._armed.armed:
                yield "d", "no stop, though all must be seen released first"
            if event in (LEFT, SUSPENDED):
                yield "d", f"no stop, though: {event}"
            if not self._is_reset:
                yield "d", "no stop, though the stop button was pressed"
            if self._machine.safety.due > self._held.until_s:
                yield "d", "silence will be noticed too late"
        if self._machine.safety.released and self._has_moved:
            if self._arms and not self._all_released:
                yield "b", "a robot that was lost is driven on, and nothing was released"
            if not self._arms and moves(self._sent):
                yield "b", "a robot that was lost is driven on without a stop"

    def _must_watch(self, event, due, answer):
        """Yield what is wrong with the time of the next call, and with repeated stops."""
        if self._machine.safety.due < due and not self._woken:
            yield "d", "something is due sooner, and the node is not woken"
        p = self._parameters
        is_last = self._machine.safety.due > self.now + 1.0 / p.output_rate
        if self._latched and is_last:
            yield "e", "a robot that was stopped by its button is left to other inputs"
        if event == TICK and self._never_sleeps():
            yield "d", "the node is never let sleep"
        is_over = self.now >= self._held.until_s and p.require_enable_button
        if answer is not None and is_over and self._zeros < p.stop_messages and is_last:
            yield "d", "a stop is not repeated"

    def _never_sleeps(self):
        machine = copy.deepcopy(self._machine)
        for _ in range(self._parameters.stop_messages):
            if machine.safety.due > self.now:
                return False
            machine.safety.tick(self.now)
        return machine.safety.due <= self.now

    def _must_go_on(self, event, answer, was_late):
        """Yield (h): a dead-man button that is held, in time and armed, drives."""
        if not isinstance(event, Message) or self._ramps or self.now < self._armed.settled_s:
            return
        may = self._meaning.holds(Joy(self.now, *event)) and (self._armed.armed or not self._arms)
        may = may and self.now < self._held.still_s and self._is_reset
        wants = moves(event.axes[:2])
        if may and wants and not was_late and not moves(answer or ZERO):
            yield "h", "the dead-man is held, and the robot is not driven"
