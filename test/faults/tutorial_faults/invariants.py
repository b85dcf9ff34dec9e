"""What never happens, whatever fails: the invariants of FAULTS.md, and what they judge (pure).

Each class takes what happened in the order of time, and returns a Violation or None. They know
nothing of the code that they judge. Times [s] are of one clock that never jumps. A velocity is
linear x, y, z [m/s] and angular x, y, z [rad/s], in the frame of the base.
"""

from __future__ import annotations

import math
from typing import Any, Callable, Hashable, NamedTuple, Tuple

from tutorial_faults.worlds import moves

Velocity = Tuple[float, ...]
# Silence after which a base stops by itself [s]: fake_turtlebot's ~cmd_vel_timeout and a Kobuki's.
BASE_TIMEOUT_S = 0.6
# A sender that is silent for longer while it drives may be cut off [s]. What the network then kept
# arrives with less than this between two commands, and until this time after the first one [s].
SILENCE_S, AT_ONCE_S, DELIVERED_S = 0.5, 0.02, 0.25
ROUNDING = 1e-9  # of a float64, as part of a limit


class Joy(NamedTuple):
    """A joystick message, as the node that drives by it received it."""

    at_s: float
    sender: Hashable  # the joystick node
    axes: tuple[float, ...]
    buttons: tuple[int, ...]
    age_s: float = 0.0  # since its stamp


class Twist(NamedTuple):
    """A velocity that was sent to the robot."""

    at_s: float
    velocity: Velocity


class Command(NamedTuple):
    """A velocity at an input of the multiplexer."""

    at_s: float
    input: str
    velocity: Velocity
    sender: Hashable = None  # one of several on the same input


class Loss(NamedTuple):
    """A part was lost: killed, suspended, cut off, restarted."""

    at_s: float
    part: str
    settles_s: float = 0.0  # messages that arrive within this time were sent before


class Violation(NamedTuple):
    """An invariant does not hold."""

    invariant: str  # its letter
    at_s: float
    what: str


class HeldDeadMan:
    """(a) Nothing moves without a dead-man button held in a message younger than joy_timeout, of a
    joystick that has changed within vigilance_timeout.
    """

    def __init__(
        self,
        joy_timeout_s: float,
        holds: Callable[[Joy], bool],
        vigilance_s: float = 0.0,
        is_good: Callable[[Joy], bool] = lambda joy: True,
    ) -> None:
        """joy_timeout_s, vigilance_s: [s], 0 for none. holds, is_good: of a Meaning."""
        self._lasts_s = joy_timeout_s or math.inf
        self._vigilance_s = vigilance_s or math.inf
        self._holds, self._is_good = holds, is_good
        self.held_s = -math.inf  # the robot may move before this time, if the joystick changes
        self.still_s = -math.inf  # and before this one
        self.shown: tuple[Any, Any] | None = None  # axes and buttons of the newest good message
        self.settled_s = -math.inf  # what arrives before is old

    @property
    def until_s(self) -> float:
        """The robot may move before this time."""
        return min(self.held_s, self.still_s)

    def take(self, event: Any) -> Violation | None:
        """Take a Joy, a Twist or a Loss; after one that settles nothing counts from before."""
        if isinstance(event, Loss) and event.settles_s:
            self.held_s = min(self.held_s, event.at_s)
            self.settled_s = max(self.settled_s, event.at_s + event.settles_s)
        elif isinstance(event, Joy) and event.at_s >= self.settled_s:
            if self._is_good(event):
                shown, self.shown = self.shown, (event.axes, event.buttons)
                if shown != self.shown:
                    self.still_s = event.at_s + self._vigilance_s
            held_s = event.at_s + self._lasts_s
            self.held_s = held_s if self._holds(event) else min(self.held_s, event.at_s)
        elif isinstance(event, Twist) and moves(event.velocity) and event.at_s >= self.until_s:
            return Violation("a", event.at_s, f"{event.velocity} without a dead-man button held")
        return None


class SeenReleased:
    """(b) After a start, silence or loss nothing moves until released, where arming is on.

    A loss is also a suspension, and another sender than before. Released: a good message has all
    released, and is of the sender that drives then.
    """

    def __init__(
        self,
        joy_timeout_s: float,
        is_good: Callable[[Joy], bool],
        is_released: Callable[[Joy], bool],
    ) -> None:
        """joy_timeout_s: [s], 0 for none. is_good, is_released: of a Meaning."""
        self._timeout_s = joy_timeout_s or math.inf
        self._is_good, self._is_released = is_good, is_released
        self.armed = False
        self.sender: Any = None
        self.heard_s = -math.inf  # the last good message
        self.settled_s = -math.inf  # what arrives before is old

    def take(self, event: Any) -> Violation | None:
        """Take a Joy, a Twist or a Loss of what drives."""
        if isinstance(event, Loss):
            self.armed = False
            self.settled_s = max(self.settled_s, event.at_s + event.settles_s)
        elif isinstance(event, Joy):
            self._hear(event)
        elif isinstance(event, Twist) and moves(event.velocity) and not self.armed:
            return Violation("b", event.at_s, f"{event.velocity} before all was seen released")
        return None

    def _hear(self, joy: Joy) -> None:
        if joy.at_s < self.settled_s or not self._is_good(joy):
            return
        if joy.sender != self.sender or joy.at_s - self.heard_s >= self._timeout_s:
            self.armed = False
        self.sender, self.heard_s = joy.sender, joy.at_s
        self.armed = self.armed or self._is_released(joy)


class WithinLimits:
    """(c) Every velocity is finite and within the limits."""

    def __init__(self, max_linear: float = math.inf, max_angular: float = math.inf) -> None:
        """max_linear: [m/s], max_angular: [rad/s], of the vectors' lengths."""
        self._max_linear = max_linear * (1 + ROUNDING)
        self._max_angular = max_angular * (1 + ROUNDING)

    def take(self, event: Twist | Command) -> Violation | None:
        """Take what was sent, or passed the multiplexer."""
        linear, angular = event.velocity[:3], event.velocity[3:]
        if not all(map(math.isfinite, event.velocity)):
            return Violation("c", event.at_s, f"{linear}, {angular} is not finite")
        if math.hypot(*linear) > self._max_linear or math.hypot(*angular) > self._max_angular:
            return Violation("c", event.at_s, f"{linear}, {angular} is beyond the limits")
        return None


class HighestSpeaks:
    """(e) The multiplexer lets one input through, the highest of those that speak."""

    def __init__(self, inputs: dict[str, tuple[int, float]]) -> None:
        """inputs: from name to (priority, timeout [s]). The higher priority wins."""
        self._inputs = inputs
        self.spoke_s = dict.fromkeys(inputs, -math.inf)

    def take(self, command: Command) -> Violation | None:
        """Take a Command that passed the multiplexer."""
        priority, _ = self._inputs[command.input]
        for name, (other, timeout_s) in self._inputs.items():
            if other > priority and command.at_s < self.spoke_s[name] + timeout_s:
                return Violation("e", command.at_s, f"{command.input} drives while {name} speaks")
        return None


class RestsFirst:
    """(f) No late command of a stick: one that fell silent in a motion rests before it moves."""

    def __init__(self) -> None:
        self.held = self.moving = False
        self.last_s = -math.inf  # the last command, if it was a motion
        self.rests_since_s = math.inf  # the first zero after a motion

    def take(self, velocity: Velocity, now: float) -> bool:
        """Take a command of one sender; return whether it is a motion that must not go through."""
        if self.moving and now - self.last_s > SILENCE_S:
            self.held = True
        if moves(velocity):
            self.held = self.held and now - self.rests_since_s < SILENCE_S
            self.rests_since_s = math.inf
        elif self.moving:
            self.rests_since_s = now
        self.moving = moves(velocity)
        self.last_s = now if self.moving else -math.inf  # only a motion can be broken off
        return self.late(now)

    def late(self, _now: float) -> bool:
        """Return whether no motion of this sender may go through now."""
        return self.held and self.moving


class NeverLate:
    """(f) No late command after a cut: of those that come at once after a silence none moves.

    A command that comes alone may be a slow sender's.
    """

    def __init__(self) -> None:
        self.moving = False
        self.last_s = self.first_s = -math.inf  # the last command; the first after a silence
        self.is_backlog = False  # several came at once since then

    def take(self, velocity: Velocity, now: float) -> bool:
        """Take a command of one sender; return whether it is the first after a silence."""
        since_s, self.last_s = now - self.last_s, now
        is_first = self.moving and since_s > SILENCE_S
        self.moving = moves(velocity)
        if is_first:
            self.first_s, self.is_backlog = now, False
        elif since_s < AT_ONCE_S and now - self.first_s < DELIVERED_S:
            self.is_backlog = True
        return is_first

    def late(self, now: float) -> bool:
        """Return whether no motion of this sender may go through now."""
        return self.is_backlog and now - self.first_s < DELIVERED_S
