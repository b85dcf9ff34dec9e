"""When to send a velocity, when to send zero and when to send nothing.

Every method takes the time `now` [s] of a clock that never jumps, and returns the velocity to send
at once, or None to send nothing.

A loss is: silence on joy, a joystick node that exits, another sender, a suspension of this node, or
a joystick that does not change while the robot moves. Where arm_on_neutral is on, nothing moves
after a loss until the sender that drives then has shown that everything is released
(node_kit.rules.arming). Where it is off, only: no velocity later than joy_timeout after the last
message, unless a stop was sent between them.
"""

from __future__ import annotations

import math
from typing import Callable

from joy_to_twist.mapping import approach
from joy_to_twist.parameters import Parameters
from joy_to_twist.states import WARNS_BEFORE_S, Notice, State
from node_kit.rules.arming import ZERO, Arming, Velocity
from node_kit.rules.throttle import ThrottleEach

IN_TURN_S = 1.0  # two joystick nodes that send within this time send in turn
WARNING_PERIOD_S = 5.0  # between two of these warnings


class Safety:
    """Turns the velocity that the user asks for into the velocity that the robot receives.

    With a dead-man button, a release sends a few zeros and then nothing, so that a multiplexer of
    velocities can switch to another source. Without one, every joystick message gives one velocity.
    A released dead-man button, a bad message and a loss send zero at once (hard stop); a released
    stick slows down within the acceleration limits (soft stop).
    """

    def __init__(
        self,
        parameters: Parameters,
        wake: Callable[[], object],
        warn: Callable[[Notice], object] = lambda notice: None,
    ) -> None:
        """Call wake() when `due` becomes earlier, and warn() with what the user must know."""
        p = self._parameters = parameters
        self._wake, self._warn = wake, warn
        self._period = 1.0 / p.output_rate
        self._gradual = bool(p.max_linear_acceleration or p.max_angular_acceleration)
        self._changes = (  # largest change of velocity in one period
            (p.max_linear_acceleration or math.inf) * self._period,
            (p.max_angular_acceleration or math.inf) * self._period,
        )
        self._silence_s = p.joy_timeout or math.inf
        self._stillness_s = p.vigilance_timeout or math.inf
        self._hears = False  # a good message arrived since the last loss
        self._silent_at = math.inf  # when the joystick counts as silent
        self._still_at = math.inf  # when it counts as unchanged for too long
        self._is_warned = False  # the warning was sent
        self._sent: Velocity = ZERO  # the last velocity sent
        self._target: Velocity = ZERO  # where the acceleration limits lead to
        self._stopping = False  # zeros are or were repeated
        self._repeats: float = 0  # zeros still to send
        self._next_output = math.inf  # when a zero or a step of the acceleration is due
        self._sender: object = None  # the sender of the last good message
        self._switched_at = -math.inf  # when the sender last changed
        self._may_warn = ThrottleEach(1.0 / WARNING_PERIOD_S)
        self.arming = Arming(not p.arm_on_neutral)  # whether this sender may drive
        self._unarmed = State.NOT_ARMED  # the state until then
        self.latched = False  # the stop button was pressed
        self.state = State.WAITING

    @property
    def due(self) -> float:
        """When tick() must be called next [s]; infinity if only a message can change the state."""
        still_at = self._still_at - (0.0 if self._is_warned else WARNS_BEFORE_S)
        due = min(self._next_output, self._silent_at)
        return due if self._sent == ZERO else min(due, still_at)

    @property
    def released(self) -> bool:
        """Whether to drive a lost robot again: all released or, without arming, zero sent."""
        return self.arming.released if self._parameters.arm_on_neutral else self._sent == ZERO

    def drive(
        self,
        velocity: Velocity | None,
        released: bool,
        now: float,
        sender: object = None,
        changed: bool = True,
    ) -> Velocity | None:
        """Take the velocity of a good message; None if its dead-man button is released.

        released: whether everything is. sender: an object that identifies the joystick node.
        changed: whether an axis or a button differs from the message before.
        """
        if changed:
            self._still_at = now + self._stillness_s
            if self._is_warned:
                self._is_warned = False
                self._wake()  # for the next warning
        why = None
        is_still = now >= self._still_at and velocity not in (None, ZERO)
        released = released and not is_still
        if is_still and self.arming.armed:
            why = State.STILL
        elif now >= self._silent_at:  # tick() was not called in time
            why = State.SILENT
        elif sender is not self._sender and self._parameters.arm_on_neutral:
            why = State.ANOTHER
            if now - self._switched_at < IN_TURN_S:
                self._warn_at_times(Notice.IN_TURN, now)
            self._switched_at = now
        stop = self.lost(why, now) if why else None
        if stop is not None and not self._parameters.arm_on_neutral:
            return stop  # the next message arrives in time again
        self._sender = sender
        answer = self._obey(velocity, released, now)
        return answer or stop

    def _obey(self, velocity: Velocity | None, released: bool, now: float) -> Velocity | None:
        self._silent_at = now + self._silence_s
        if not self._hears:
            self._hears = True
            self._wake()  # the silence timeout starts
        if not self.arming.hear(released):
            if self._unarmed is State.NOT_ARMED and velocity not in (None, ZERO):
                self._warn_at_times(Notice.NOT_ARMED, now)
            return self._refuse(self._unarmed, now)
        if velocity is None:
            return self._refuse(State.ARMED, now)

        if not self._is_warned:
            self.state = State.DRIVING
        if self._stopping:
            self._stopping, self._next_output = False, math.inf
        if not self._gradual:
            return self._answer(velocity)
        self._target = velocity
        # During a change of velocity, tick() sends at a steady rate.
        return self._step(now) if math.isinf(self._next_output) else None

    def reject(self, now: float) -> Velocity | None:
        """Stop at a bad message, which does not count as a sign of life."""
        self.arming.released = False
        return self._refuse(State.BAD_MESSAGE, now)

    def latch(self, now: float) -> Velocity | None:
        """Send zeros from the stop button until reset(), which also hold a multiplexer."""
        if self.latched:
            return None
        self._warn(Notice.BUTTON)
        self._forget(State.BUTTON)
        self.arming.lose()
        self.latched = self._stopping = True
        self._repeats = math.inf
        return self._repeat(now)

    def reset(self) -> None:
        """End the effect of the stop button: the robot moves again once everything was released."""
        self.latched, self._repeats = False, 1
        self.state = self._unarmed = State.NOT_ARMED

    def lost(self, why: State, now: float) -> Velocity | None:
        """Stop, because the joystick is unreliable, and disarm if so configured."""
        if not self._hears:
            return None
        self._forget(why)
        self._unarmed = State.NOT_ARMED
        if why is State.STILL:
            self._unarmed = why
            self._warn(Notice.STILL)
        if why in (State.SILENT, State.LEFT) and self._sent != ZERO:
            self._warn(Notice[why.name])
        if self._parameters.arm_on_neutral:
            self.arming.lose()
        # A robot that stands needs no zero, which would also occupy its multiplexer.
        stands = self._sent == ZERO and math.isinf(self._next_output)
        return None if stands else self._stop(now)

    def _forget(self, state: State) -> None:
        self.state = state
        self._hears, self._silent_at = False, math.inf

    def tick(self, now: float) -> Velocity | None:
        """Return the velocity that is due."""
        if now >= self._silent_at:
            return self.lost(State.SILENT, now)
        if self._sent != ZERO and now >= self._still_at - WARNS_BEFORE_S:
            if now >= self._still_at:
                return self.lost(State.STILL, now)
            if not self._is_warned:
                self._is_warned = True
                self.state = State.STILL_SOON
                self._warn(Notice.STILL_SOON)
        if now < self._next_output:
            return None
        return self._repeat(now) if self._stopping else self._step(now)

    def _refuse(self, why: State, now: float) -> Velocity | None:
        self.state = why
        if self._parameters.require_enable_button:
            return self._stop(now)
        self._next_output = math.inf
        return self._answer(ZERO)

    def _stop(self, now: float) -> Velocity | None:
        if self._stopping:
            return None
        self._stopping = True
        self._repeats = self._parameters.stop_messages
        return self._repeat(now)

    def _repeat(self, now: float) -> Velocity:
        self._repeats -= 1
        self._schedule(now + self._period if self._repeats else math.inf)
        return self._answer(ZERO)

    def _step(self, now: float) -> Velocity:
        velocity = approach(self._sent, self._target, *self._changes)
        stands = velocity == self._target == ZERO
        self._schedule(math.inf if stands else now + self._period)
        return self._answer(velocity)

    def _schedule(self, next_output: float) -> None:
        self._next_output = next_output
        self._wake()

    def _warn_at_times(self, notice: Notice, now: float) -> None:
        if self._may_warn.ready(notice.name, now):
            self._warn(notice)

    def _answer(self, velocity: Velocity) -> Velocity:
        before, self._sent = self._sent, velocity
        if before == ZERO != velocity:
            self._wake()  # the vigilance timeout starts
        return velocity
