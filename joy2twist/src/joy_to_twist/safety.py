"""When to send a velocity, when to send zero and when to stay silent (pure).

Every method is given the time `now` [s] of one clock that never jumps; nothing here reads a clock.
A method returns the velocity to send at once (six floats, see limits), or None to send nothing.

The rule of arming, for every loss: of the joystick (silence, leaving, a suspension of this node,
another sender) and of the robot (who tells it what is released: see `released`). After each, where
arm_on_neutral is on, nothing moves before all was seen released by one sender, the one that drives
then. Without it, only: no velocity later than joy_timeout after the last message, unless a stop was
sent between them.
"""

import math

from joy_to_twist.limits import ZERO, approach
from node_kit.states import DRIVING

WAITING = "waiting for the joystick"
NOT_ARMED = "stopped: not armed, release the sticks and the dead-man button once"
ANOTHER = "another joystick node sends, whose sticks and dead-man button were not seen released"
BAD_MESSAGE = "stopped: bad joystick message"
ARMED = "armed: hold the dead-man button to drive"


class Safety:
    """Turns what the user asks for into what the robot is told.

    With a dead-man button, its release gives zero a few times and then silence, so that a
    multiplexer of velocities can fall back to another source. Without one, every joystick message
    is answered by one velocity. Zero comes at once for a released dead-man, a bad message and
    silence (hard stop); a released stick slows down within the acceleration limits (soft stop).
    """

    def __init__(self, parameters, wake):
        """parameters: parameters.Parameters. wake: called when due has become sooner."""
        p = self._parameters = parameters
        self._wake = wake
        self._period = 1.0 / p.output_rate
        self._gradual = p.max_linear_acceleration > 0 or p.max_angular_acceleration > 0
        self._changes = (  # of the velocity in one period, at most
            (p.max_linear_acceleration or math.inf) * self._period,
            (p.max_angular_acceleration or math.inf) * self._period,
        )
        self._heard = None  # when the last good message came; None: none since the last silence
        self._sent = ZERO  # the last velocity sent
        self._target = ZERO  # where the acceleration limits lead to
        self._stopping = False  # zeros are being repeated, or have been
        self._repeats = 0  # zeros still to come
        self._next_output = None  # when a zero or a step of the acceleration is due
        self._sender = None  # of the last good message
        self.armed = not p.arm_on_neutral  # for that sender
        self._released = True  # that message had everything released
        self.state = WAITING

    @property
    def due(self):
        """When tick() must be called next [s]; infinity if nothing will happen by itself."""
        output = math.inf if self._next_output is None else self._next_output
        return min(output, self._silent_at)

    @property
    def _silent_at(self):
        if self._heard is None or self._parameters.joy_timeout == 0:
            return math.inf
        return self._heard + self._parameters.joy_timeout

    @property
    def released(self):
        """Whether a robot that was lost may be driven again: all is released, or, where arming is
        off, it was told to stop.
        """
        return self._released if self._parameters.arm_on_neutral else self._sent == ZERO

    def drive(self, velocity, neutral, now, sender=None):
        """A good message asks for this velocity; None: its dead-man button is released.

        neutral: whether its sticks are released. sender: an object, which tells one from another.
        """
        stop = None
        if now >= self._silent_at:  # and tick() was not called in time
            stop = self.lost(self._silence, now)
        elif sender is not self._sender and self._parameters.arm_on_neutral:
            stop = self.lost(ANOTHER, now)
        if stop is not None and not self._parameters.arm_on_neutral:
            return stop  # the next message is in time again
        self._sender = sender
        answer = self._obey(velocity, neutral, now)
        return stop if answer is None else answer

    def _obey(self, velocity, neutral, now):
        was_silent, self._heard = self._heard is None, now
        if was_silent:
            self._wake()  # the watch over the silence begins
        self._released = neutral and (
            velocity is None or not self._parameters.require_enable_button
        )
        if not self.armed:
            self.armed = self._released
            if not self.armed:
                return self._refuse(NOT_ARMED, now)
        if velocity is None:
            return self._refuse(ARMED, now)

        self.state = DRIVING
        if self._stopping:
            self._stopping, self._next_output = False, None
        if not self._gradual:
            return self._send(velocity)
        self._target = velocity
        # While the velocity changes, tick() sends it at a steady rate.
        return self._step(now) if self._next_output is None else None

    def reject(self, now):
        """A bad message came: stop. It is no sign of life."""
        self._released = False
        return self._refuse(BAD_MESSAGE, now)

    @property
    def _silence(self):
        return f"no message for {self._parameters.joy_timeout:g} s"

    def lost(self, why, now):
        """The joystick cannot be relied upon any more: stop, and arm anew if so configured."""
        if self._heard is None:
            return None
        self._heard = None
        self._released = False
        self.armed = not self._parameters.arm_on_neutral
        self.state = f"stopped: {why}"
        # A robot that stands needs no zero, and its multiplexer no claim to drive it.
        stands = self._sent == ZERO and self._next_output is None
        return None if stands else self._stop(now)

    def tick(self, now):
        """Time has passed: send what is due."""
        if now >= self._silent_at:
            return self.lost(self._silence, now)
        if self._next_output is None or now < self._next_output:
            return None
        return self._repeat(now) if self._stopping else self._step(now)

    def _refuse(self, why, now):
        self.state = why
        if self._parameters.require_enable_button:
            return self._stop(now)
        self._next_output = None
        return self._send(ZERO)

    def _stop(self, now):
        if self._stopping:
            return None
        self._stopping = True
        self._repeats = self._parameters.stop_messages
        return self._repeat(now)

    def _repeat(self, now):
        self._repeats -= 1
        self._schedule(now if self._repeats else None)
        return self._send(ZERO)

    def _step(self, now):
        velocity = approach(self._sent, self._target, *self._changes)
        rests = velocity == self._target == ZERO
        self._schedule(None if rests else now)
        return self._send(velocity)

    def _schedule(self, now):
        self._next_output = None if now is None else now + self._period
        self._wake()

    def _send(self, velocity):
        self._sent = velocity
        return velocity
