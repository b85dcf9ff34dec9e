"""The multiplexer (Arbiter, BacklogFilter), called as the node calls it, judged by (c) to (f)."""

import math
from typing import Any, NamedTuple

from fake_turtlebot_sim.mux.arbitration import Arbiter, Ruling
from tutorial_faults.worlds import TICK, World, beyond, moves

ZERO = (0.0,) * 6
# A sender that is silent for longer while it drives may be cut off [s]. The commands that the
# network then delayed arrive this close together, and this soon after the first one [s].
SILENCE_S, AT_ONCE_S, DELIVERED_S = 0.5, 0.02, 0.25


class Command(NamedTuple):
    """A velocity at an input of the multiplexer, of a sender that has no other input."""

    input: str
    velocity: tuple
    sender: Any


class Lateness:
    """(f) Which commands of one sender are late after a silence in a motion.

    Commands that arrive at once must not move the robot; one alone may be a slow sender's. A stick
    must rest before it moves.
    """

    def __init__(self, is_stick):
        self._is_stick = is_stick
        self._moving = self._is_held = self._is_backlog = False
        self.last_s = self._first_s = -math.inf  # the last command; the first after a silence
        self._rests_since_s = math.inf  # the first zero after a motion

    def take(self, velocity, now):
        """Take a command; return whether it must not go through at once."""
        since_s, self.last_s = now - self.last_s, now
        was_moving, self._moving = self._moving, moves(velocity)
        is_first = was_moving and since_s > SILENCE_S
        if self._is_stick:
            rested = now - self._rests_since_s >= SILENCE_S
            self._is_held = (self._is_held or is_first) and not (self._moving and rested)
            if self._moving:
                self._rests_since_s = math.inf
            elif was_moving:
                self._rests_since_s = now
        elif is_first:
            self._first_s, self._is_backlog = now, False
        elif since_s < AT_ONCE_S and now - self._first_s < DELIVERED_S:
            self._is_backlog = True
        return self._moving and (is_first or self.is_late(now))

    def is_late(self, now):
        """Return whether no motion of this sender may go through now."""
        return self._is_held or (self._is_backlog and now - self._first_s < DELIVERED_S)


class ArbiterWorld(World):
    """The real Arbiter, and the invariants that it must keep."""

    def __init__(self, inputs):
        self._inputs = sorted(inputs, key=lambda source: source.priority, reverse=True)
        self._spoke_s = {source.name: -math.inf for source in inputs}
        self._arbiter = Arbiter(inputs)
        self._waiting = {}  # sender -> its Command that waits
        self._lateness = {}  # sender -> Lateness
        self._sent = ZERO

    def happen(self, event):
        return self._tick() if event == TICK else self._command(event)

    def _speaking(self):
        """Return the inputs that send, the highest first."""
        spoke_s = self._spoke_s
        inputs = self._inputs
        return [source for source in inputs if self.now < spoke_s[source.name] + source.timeout]

    def _is_highest(self, name):
        return [name] == [source.name for source in self._speaking()[:1]]

    def _tick(self):
        due = {
            sender: command
            for sender, command in self._waiting.items()
            if self.now - self._lateness[sender].last_s >= AT_ONCE_S
        }
        for sender, command in due.items():
            self._spoke_s[command.input] = self.now
            del self._waiting[sender]
        through = list(self._arbiter.waited(self.now))
        for velocity, sender in through:
            if sender in due and due[sender].velocity == velocity:
                yield from self._through(due[sender])
            else:
                yield "f", f"{velocity} goes through, and did not wait"
        if not through and any(self._is_highest(command.input) for command in due.values()):
            yield "e", "the highest that sends has waited, and does not go through"
        if self._arbiter.must_stop(self.now):
            self._sent = ZERO
        yield from self._must_look_in_time()

    def _must_look_in_time(self):
        ends_s = [self._spoke_s[s.name] + s.timeout - self.now for s in self._speaking()]
        if moves(self._sent) and not ends_s:
            yield "d", "no stop, though all inputs are silent"
        lull_s = self._arbiter.lull(self.now)
        shortest_s = min(source.timeout for source in self._inputs)
        if not 0 < lull_s <= shortest_s or (moves(self._sent) and lull_s > max(ends_s, default=0)):
            yield "d", f"sleeping for {lull_s} s, and something is due sooner"

    def _command(self, command):
        name, velocity, sender = command
        ruling = self._arbiter.command(name, velocity, self.now, sender)
        if not all(map(math.isfinite, velocity)):
            if ruling is not Ruling.REJECTED:
                yield "c", "a command that is not finite is not rejected"
            return
        self._waiting.pop(sender, None)
        if ruling is Ruling.WAITS:
            self._waiting[sender] = command
        lateness = self._lateness.setdefault(sender, Lateness(sender.is_stick))
        if lateness.take(velocity, self.now):
            if ruling is Ruling.OBEYED:
                yield "f", f"a late command of {sender} is obeyed"
            return
        self._spoke_s[name] = self.now
        if ruling is Ruling.OBEYED:
            yield from self._through(command)
        elif self._is_highest(name):
            yield "e", f"{name} is the highest that sends, and not obeyed"

    def _through(self, command):
        self._sent = command.velocity
        yield from beyond(command.velocity)
        if not self._is_highest(command.input):
            yield "e", f"{command.input} drives while a higher one sends"
        if moves(command.velocity) and self._lateness[command.sender].is_late(self.now):
            yield "f", f"a late command of {command.sender} is obeyed"
