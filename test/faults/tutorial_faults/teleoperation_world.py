"""Every state of Teleoperation (Mapping, Safety, arming), judged by (a), (b), (c) and (d).

Clocks: the last good message, the next output, the end of a suspension's settling, and with a
vigilance_timeout the last change of the joystick; the invariants have the same. Thresholds:
joy_timeout 0.5 s, the period of the output 0.25 s, SETTLING_S 0.25 s, vigilance_timeout 1 s.
"""

import math

from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from node_kit.arming import SETTLING_S, ZERO
from tutorial_faults.events import Joy, Loss, Twist
from tutorial_faults.explore import SUSPENDED, TICK, World, key_of, until
from tutorial_faults.invariants import HeldDeadMan, SeenReleased, WithinLimits, judged, moves
from tutorial_faults.meaning import Meaning
from tutorial_faults.teleoperation_alphabet import LEFT, Message

STEP_S, VIGILANT_STEP_S = 0.0625, 0.05  # 0.25 s for three clocks, and for four
PARTS = {"_machine": {"safety": {"arming": {}}, "_resumption": {}}, "_held": {}, "_armed": {}}
# What is fixed, what is only for the user, and the parts that have keys of their own.
NOT_IN_KEY = {
    "_parameters", "_warn", "mapping", "safety", "_hints", "_knows_gamepad", "_may_warn",
    "_max_age_ns", "_unheard_since", "_resumption", "_messages", "_last_message", "_last_summary",
    "_watches_stillness",
}  # fmt: skip
FIXED_IN_SAFETY = {
    "_parameters", "_wake", "_warn", "_period", "_gradual", "_changes", "_silence_s",
    "_stillness_s", "_silence", "_stillness", "_watches_stillness", "_unarmed", "state", "arming",
    "_switched_at", "_may_warn",
}  # fmt: skip
FIXED_IN_RELEASED = {"_is_good", "_is_released", "settled_s"}  # Resumption's


class TeleoperationWorld(World):
    """The real Teleoperation, and the invariants that it must keep."""

    def __init__(self, **given):
        """given: private parameters of joy2twist."""
        p = self._parameters = load(given)
        super().__init__(VIGILANT_STEP_S if p.vigilance_timeout else STEP_S, PARTS)
        self._ramps = p.max_linear_acceleration > 0 or p.max_angular_acceleration > 0
        self._woken = []  # of the transition that is made just now
        self._machine = Teleoperation(p, lambda line: None, lambda: self._woken.append(True))
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

    def key(self):
        """Return all that decides what follows; Resumption's _seen only counts suspensions."""
        now, machine, timeout_s = self._now, self._machine, self._parameters.joy_timeout
        return (
            key_of(machine, now, without=NOT_IN_KEY),
            key_of(
                machine.safety, now, future={"_next_output", "_silent_at", "_still_at"},
                without=FIXED_IN_SAFETY,
            ),
            (machine.safety.arming.armed, machine.safety.arming.rests),
            until(now, machine._resumption._settled_at),
            (until(now, self._held.held_s), until(now, self._held.still_s)),
            (self._latched, self._is_reset),
            self._held.shown if self._parameters.vigilance_timeout else None,
            key_of(self._armed, now, timeout_s, past={"heard_s"}, without=FIXED_IN_RELEASED),
            (self._sent, self._zeros, self._has_moved, self._all_released),
        )  # fmt: skip

    def _happen(self, event):
        self._woken.clear()
        due, sent, was_late = self._machine.safety.due, self._sent, self._is_silent
        if event == TICK:
            self._all_released = self._all_released and not was_late
            if moves(sent) and self._now >= self._held.still_s:
                self._lose(Loss(self._now, "joystick that does not change"))
            answer = self._machine.safety.tick(self._now)
        elif event == LEFT:
            self._lose(Loss(self._now, "joystick node"))
            answer = self._machine.left(self._now)
        elif event == SUSPENDED:
            self._lose(Loss(self._now, "joy2twist", SETTLING_S))
            answer = self._machine.suspended(self._machine._resumption._seen + 1, self._now)
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
        return self._now - self._armed.heard_s >= (self._parameters.joy_timeout or math.inf)

    def _lose(self, loss):
        self._held.take(loss)
        self._armed.take(loss)
        self._all_released = False

    def _hear(self, message):
        joy = Joy(self._now, *message)
        if joy.at_s >= self._armed.settled_s:
            self._all_released = self._meaning.is_released(joy)
        self._held.take(joy)
        self._armed.take(joy)
        wants = self._meaning.holds(joy) and moves(joy.axes[:2])
        if wants and joy.at_s >= max(self._held.still_s, self._armed.settled_s):
            self._lose(Loss(self._now, "joystick that does not change"))
        if self._meaning.stops(joy) or self._latched:
            self._is_reset = False
            self._latched = joy.at_s < self._armed.settled_s or not self._meaning.resets(joy)
            self._lose(Loss(self._now, "stop button"))
        elif self._all_released:
            self._is_reset = True
        return self._machine.joy(
            joy.axes, joy.buttons, self._now, round(joy.age_s * 1e9), joy.sender
        )

    def _judge_velocity(self, velocity, before):
        twist = Twist(self._now, velocity)
        judges = (self._held, self._limits, *([self._armed] if self._arms else []))
        for violation in judged([twist], *judges):
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
            if self._now >= self._held.until_s:
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
        is_last = self._machine.safety.due > self._now + 1.0 / p.output_rate
        if self._latched and is_last:
            yield "e", "a robot that was stopped by its button is left to other inputs"
        if event == TICK and self._never_sleeps():
            yield "d", "the node is never let sleep"
        is_over = self._now >= self._held.until_s and p.require_enable_button
        if answer is not None and is_over and self._zeros < p.stop_messages and is_last:
            yield "d", "a stop is not repeated"

    def _never_sleeps(self):
        machine = self.copy()._machine
        for _ in range(self._parameters.stop_messages):
            if machine.safety.due > self._now:
                return False
            machine.safety.tick(self._now)
        return machine.safety.due <= self._now

    def _must_go_on(self, event, answer, was_late):
        """Yield (h): a dead-man button that is held, in time and armed, drives."""
        if not isinstance(event, Message) or self._ramps or self._now < self._armed.settled_s:
            return
        may = self._meaning.holds(Joy(self._now, *event)) and (self._armed.armed or not self._arms)
        may = may and self._now < self._held.still_s and self._is_reset
        wants = moves(event.axes[:2])
        if may and wants and not was_late and not moves(answer or ZERO):
            yield "h", "the dead-man is held, and the robot is not driven"
