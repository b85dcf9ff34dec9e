"""What never happens, whatever fails: the invariants (a) to (h) of FAULTS.md (pure).

Each is a class of a few lines that is shown what happens, in the order of time, by take(), and says
what is wrong with it: a Violation, or None. They know nothing of the code that they judge. Who
watches from the side, and not in the thread that decides, allows for the way of the messages with
slack_s; the exploration allows for nothing.
"""

import math
from typing import Callable, Dict, Iterable, List, Optional

from tutorial_faults.events import Command, Joy, Loss, Through, Twist, Violation, Wheels

# A base that hears nothing for this time stops by itself [s]: fake_turtlebot's ~cmd_vel_timeout,
# and that of a TurtleBot's own base.
BASE_TIMEOUT_S = 0.6
# A sender that fell silent while it drove must rest as long before it moves the robot again [s].
REST_S = 0.5
# Rounding of a float64, as part of a limit.
ROUNDING = 1e-9


def moves(velocity) -> bool:
    """Whether a velocity is other than zero; NaN is, too."""
    return any(part != 0 for part in velocity)


def judged(events: Iterable, *invariants) -> List[Violation]:
    """All violations of the invariants in a record, which is put in the order of time."""
    found = []
    for event in sorted(events, key=lambda event: event.at_s):
        found += [violation for one in invariants for violation in [one.take(event)] if violation]
    return found


class HeldDeadMan:
    """(a) Nothing moves without a dead-man held in a message younger than joy_timeout, of a
    joystick that has changed within vigilance_timeout.
    """

    def __init__(
        self,
        joy_timeout_s: float,
        holds: Callable[[Joy], bool],
        slack_s: float = 0.0,
        vigilance_s: float = 0.0,
        is_good: Callable[[Joy], bool] = lambda joy: True,
    ):
        """joy_timeout_s, vigilance_s: [s], 0 for none. holds: whether a Joy is good and holds the
        dead-man. is_good: whether it is good.
        """
        self._lasts_s = joy_timeout_s or math.inf
        self._vigilance_s = vigilance_s or math.inf
        self._holds, self._is_good = holds, is_good
        self._slack_s = slack_s
        self.held_s = -math.inf  # the robot may move before this time, if the joystick changes
        self.still_s = -math.inf  # and before this one
        self.shown = None  # axes and buttons of the newest good message
        self.settled_s = -math.inf  # what comes before is old

    @property
    def until_s(self):
        """The robot may move before this time."""
        return min(self.held_s, self.still_s)

    def take(self, event) -> Optional[Violation]:
        """Take a Joy, a Twist or a Loss; after one that settles nothing counts that came before."""
        if isinstance(event, Loss) and event.settles_s:
            self.held_s = min(self.held_s, event.at_s + self._slack_s)
            self.settled_s = max(self.settled_s, event.at_s + event.settles_s)
        elif isinstance(event, Joy) and event.at_s >= self.settled_s:
            if self._is_good(event):
                shown, self.shown = self.shown, (event.axes, event.buttons)
                if shown != self.shown:
                    self.still_s = event.at_s + self._vigilance_s + self._slack_s
            if self._holds(event):
                self.held_s = event.at_s + self._lasts_s + self._slack_s
            else:
                self.held_s = min(self.held_s, event.at_s + self._slack_s)
        elif isinstance(event, Twist) and moves(event.velocity) and event.at_s >= self.until_s:
            return Violation("a", event.at_s, f"{event.velocity} without a dead-man held")
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
        slack_s: float = 0.0,
    ):
        """joy_timeout_s: [s], 0 for none. is_good, is_released: what a Joy means."""
        self._timeout_s = joy_timeout_s or math.inf
        self._is_good = is_good
        self._is_released = is_released
        self._slack_s = slack_s
        self.armed = False
        self.sender = None
        self.heard_s = -math.inf  # the last good message
        self.settled_s = -math.inf  # what comes before is old
        self.disarmed_s = -math.inf

    def take(self, event) -> Optional[Violation]:
        """Take a Joy, a Twist or a Loss of what drives."""
        if isinstance(event, Loss):
            self._disarm(event.at_s)
            self.settled_s = max(self.settled_s, event.at_s + event.settles_s)
        elif isinstance(event, Joy):
            self._hear(event)
        elif isinstance(event, Twist) and moves(event.velocity) and not self._may_drive(event.at_s):
            return Violation("b", event.at_s, f"{event.velocity} before all was seen released")
        return None

    def _may_drive(self, now):
        return self.armed or now < self.disarmed_s + self._slack_s

    def _hear(self, joy):
        if joy.at_s < self.settled_s or not self._is_good(joy):
            return
        if joy.sender != self.sender or joy.at_s - self.heard_s >= self._timeout_s:
            self._disarm(joy.at_s)
        self.sender, self.heard_s = joy.sender, joy.at_s
        self.armed = self.armed or self._is_released(joy)

    def _disarm(self, now):
        if self.armed:
            self.armed, self.disarmed_s = False, now


class WithinLimits:
    """(c) Every velocity is finite and within the limits."""

    def __init__(self, max_linear: float = math.inf, max_angular: float = math.inf):
        """max_linear: [m/s], max_angular: [rad/s], of the vectors' lengths."""
        self._max_linear = max_linear * (1 + ROUNDING)
        self._max_angular = max_angular * (1 + ROUNDING)

    def take(self, event) -> Optional[Violation]:
        """Take a Twist, a Through or the Wheels."""
        if isinstance(event, (Twist, Through)):
            linear, angular = event.velocity[:3], event.velocity[3:]
        elif isinstance(event, Wheels):
            linear, angular = (event.v,), (event.w,)
        else:
            return None
        if not all(map(math.isfinite, (*linear, *angular))):
            return Violation("c", event.at_s, f"{linear}, {angular} is not finite")
        if math.hypot(*linear) > self._max_linear or math.hypot(*angular) > self._max_angular:
            return Violation("c", event.at_s, f"{linear}, {angular} is beyond the limits")
        return None


class SoonAtRest:
    """(d) From the loss of any single part to wheels at rest at most 0.6 s and one period."""

    def __init__(self, limit_s: float):
        """limit_s: BASE_TIMEOUT_S and one period [s]."""
        self._limit_s = limit_s
        self._lost = None  # the Loss after which the wheels still turn
        self.worst_s = 0.0  # the longest time from a loss to rest

    def take(self, event) -> Optional[Violation]:
        """Take a Loss or the Wheels of the one robot; one loss at a time."""
        if isinstance(event, Loss):
            self._lost = event
        elif isinstance(event, Wheels) and self._lost:
            elapsed_s = event.at_s - self._lost.at_s
            if not moves((event.v, event.w)):
                self.worst_s = max(self.worst_s, elapsed_s)
                self._lost = None
            elif elapsed_s > self._limit_s:
                lost, self._lost = self._lost, None
                self.worst_s = max(self.worst_s, elapsed_s)
                what = f"turning {elapsed_s:.3f} s after the loss of {lost.part}"
                return Violation("d", event.at_s, f"wheels {what}")
        return None


class HighestSpeaks:
    """(e) The multiplexer lets one input through, the highest of those that speak."""

    def __init__(self, inputs: Dict[str, tuple], slack_s: float = 0.0):
        """inputs: from name to (priority, timeout [s]). The higher priority wins."""
        self._inputs = inputs
        self._slack_s = slack_s
        self.spoke_s = dict.fromkeys(inputs, -math.inf)

    def take(self, event) -> Optional[Violation]:
        """Take a Command that counts (finite, and not late) or what went Through."""
        if isinstance(event, Command) and all(map(math.isfinite, event.velocity)):
            self.spoke_s[event.input] = event.at_s
        elif isinstance(event, Through):
            priority, _ = self._inputs[event.input]
            for name, (other, timeout_s) in self._inputs.items():
                if other > priority and event.at_s < self.spoke_s[name] + timeout_s - self._slack_s:
                    return Violation("e", event.at_s, f"{event.input} drives while {name} speaks")
        return None


class NeverLate:
    """(f) No late command after a cut: who fell silent in the middle of a motion rests first.

    So as to what it may know who stands behind the cut. A watcher who knows when a command was sent
    holds its age against a limit: see is_late().
    """

    def __init__(self, rest_s: float = REST_S):
        """rest_s: silent for longer [s], and so long nothing but zero before it moves again."""
        self._rest_s = rest_s
        self.held = self.moving = False
        self.last_s = -math.inf  # the last command, if it was a motion
        self.rests_since_s = math.inf  # the first zero after a motion

    def late(self, velocity, now: float) -> bool:
        """Take a command of one sender; whether it must not go through."""
        if self.moving and now - self.last_s > self._rest_s:
            self.held = True
        if moves(velocity):
            self.held = self.held and now - self.rests_since_s < self._rest_s
            self.rests_since_s = math.inf
        elif self.moving:
            self.rests_since_s = now
        self.moving = moves(velocity)
        self.last_s = now if self.moving else -math.inf  # only a motion can be broken off
        return self.held and self.moving

    def lost(self, now: float):
        """Whoever listens was suspended: as if the sender had fallen silent while it drove."""
        self.held = self.moving = True
        self.last_s, self.rests_since_s = now, math.inf


def is_late(sent_s: float, obeyed_s: float, longest_s: float) -> bool:
    """(f) Whether a motion was obeyed longer after it was sent than allowed [s]."""
    return obeyed_s - sent_s > longest_s


def unended(asked_s: float, ended_s: Dict[str, Optional[float]], limit_s: float) -> List[Violation]:
    """(g) The nodes that did not end in time, or at all (None), when told to at asked_s [s]."""
    return [
        Violation("g", asked_s, f"{name} did not end within {limit_s} s")
        for name, end_s in ended_s.items()
        if end_s is None or end_s - asked_s > limit_s
    ]


class GoesOn:
    """(h) What is well goes on: a fault elsewhere neither stops nor moves a robot."""

    def __init__(self, robot: str, longest_gap_s: float, drives: bool):
        """longest_gap_s: between two messages of the robot. drives: whether it should move."""
        self._robot = robot
        self._longest_gap_s = longest_gap_s
        self._drives = drives
        self._last_s = None

    def take(self, event) -> Optional[Violation]:
        """Take the Wheels of any robot, as long as this one's driver drives or rests throughout."""
        if not isinstance(event, Wheels) or event.robot != self._robot:
            return None
        last_s, self._last_s = self._last_s, event.at_s
        gap_s = 0.0 if last_s is None else event.at_s - last_s
        if gap_s > self._longest_gap_s:
            return Violation("h", event.at_s, f"{self._robot}: silent for {gap_s:.3f} s")
        if moves((event.v, event.w)) != self._drives:
            what = "stopped" if self._drives else "moved"
            return Violation("h", event.at_s, f"{self._robot}: {what} by a fault elsewhere")
        return None
