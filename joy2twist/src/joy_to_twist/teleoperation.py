"""From a joystick message to a velocity, and the reports to the user."""

from __future__ import annotations

import math
from typing import Callable, Sequence

from joy_to_twist.gamepad_hints import GamepadHints
from joy_to_twist.mapping import BadJoyError, Mapping
from joy_to_twist.parameters import Parameters
from joy_to_twist.safety import Safety
from joy_to_twist.states import State, sentence
from node_kit.rules.arming import Resumption, Velocity
from node_kit.rules.throttle import Throttle

UNHEARD_S = 2.0  # a robot that starts together with this node needs a moment to subscribe
WARNING_PERIOD_S = 5.0  # often enough to be seen, and not so often that it hides other lines


class Teleoperation:
    """Combines the mapping, the safety rules and the hints. Not thread-safe.

    Times are in seconds of a clock that never jumps. None in place of a velocity: send nothing.
    """

    def __init__(
        self, parameters: Parameters, warn: Callable[[str], object], wake: Callable[[], object]
    ) -> None:
        """Call wake() as Safety does, and warn() with a line for the user."""
        self._parameters = parameters
        self._warn = warn
        self._mapping = Mapping(parameters)
        self._safety = Safety(parameters, wake, lambda notice: warn(sentence(notice, parameters)))
        self._hints = GamepadHints(parameters)
        self._may_warn = Throttle(1.0 / WARNING_PERIOD_S)
        self._max_age_ns = round(parameters.max_joy_age * 1e9)
        self._unheard_since: float | None = None  # since when velocities reach no subscriber
        self._resumption = Resumption()
        self._messages, self._counted_at = 0, -math.inf  # messages since the last summary; its time
        self._last_message: float | None = None
        self._last: object = None  # axes and buttons of the last good message

    @property
    def state(self) -> State:
        return self._safety.state

    @property
    def due(self) -> float:
        """When tick() must be called next [s]; infinity if only a message can change the state."""
        return self._safety.due

    @property
    def released(self) -> bool:
        """Whether a robot that was lost may be driven again."""
        return self._safety.released

    def describe(self) -> list[str]:
        """Return lines that describe the mapping."""
        return self._mapping.describe()

    def tick(self, now: float) -> Velocity | None:
        """Return the velocity that is due by now, such as a stop after silence."""
        return self._safety.tick(now)

    def joy(
        self,
        axes: Sequence[float],
        buttons: Sequence[int],
        now: float,
        age_ns: int = 0,
        sender: object = None,
    ) -> Velocity | None:
        """Take a joystick message; return the velocity to send at once.

        age_ns: time since its stamp [ns], ignored unless max_joy_age is set. sender: an object that
        identifies the joystick node.
        """
        if self._mapping.stops(buttons):
            return self._safety.latch(now)
        if self._resumption.is_old(now):
            return None
        self._messages += 1
        self._last_message = now
        try:
            velocity = self._mapping.velocity(axes, buttons)
            if self._max_age_ns and age_ns > self._max_age_ns:
                raise BadJoyError(f"it is {age_ns / 1e9:.1f} s old")
        except BadJoyError as error:
            if self._may_warn.ready(now):
                self._warn(f"Stopping: a joystick message is unusable, {error}.")
            return None if self._safety.latched else self._safety.reject(now)
        last, self._last = self._last, (axes, buttons)
        if self._safety.latched:
            if self._mapping.resets(buttons):
                self._safety.reset()
            return None
        hint = self._hints.hint(axes, buttons)
        if hint:
            self._warn(hint)
        matters = self._parameters.arm_on_neutral or not self._safety.arming.armed
        released = matters and self._mapping.released(axes, velocity)
        return self._safety.drive(velocity, released, now, sender, last != self._last)

    def suspended(self, number: int, now: float) -> Velocity | None:
        """Take the number of suspensions of this node; return the velocity to send at once."""
        if not self._resumption.notice(number, now):
            return None
        self._warn("This node was suspended. Messages from that time are ignored.")
        return self._safety.lost(State.SUSPENDED, now)

    def left(self, now: float) -> Velocity | None:
        """Stop, as no node publishes joystick messages; return the velocity to send at once."""
        return self._safety.lost(State.LEFT, now)

    def listeners(self, count: int, topic: str, now: float) -> None:
        """Warn once if velocities reach no subscriber, such as on a topic with a wrong name."""
        if count or self._safety.state is not State.DRIVING:
            self._unheard_since = None
        elif self._unheard_since is None:
            self._unheard_since = now
        elif now - self._unheard_since > UNHEARD_S:
            self._unheard_since = math.inf
            self._warn(f"No node subscribes to {topic}: start the robot, or check its name.")

    def summary(self, now: float) -> tuple[bool, str, dict[str, str]]:
        """Return for /diagnostics whether all is well, the state, and details by name."""
        state = self._safety.state
        rate = self._messages / ((now - self._counted_at) or math.inf)
        self._messages, self._counted_at = 0, now
        age = "none yet" if self._last_message is None else f"{now - self._last_message:.3f}"
        details = {
            "Joy rate [Hz]": f"{rate:.1f}",
            "Age of the last Joy [s]": age,
            "Dead-man button": self._mapping.deadman,
        }
        return state in (State.ARMED, State.DRIVING), sentence(state, self._parameters), details
