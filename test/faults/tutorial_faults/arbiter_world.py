"""The rules of the multiplexer (Arbiter, Sender), judged by (c) to (f), asked as the node asks."""

import math

from fake_turtlebot_sim.mux.arbitration import Arbiter, Verdict
from tutorial_faults.invariants import (
    AT_ONCE_S,
    Command,
    HighestSpeaks,
    NeverLate,
    RestsFirst,
    WithinLimits,
)  # fmt: skip
from tutorial_faults.worlds import TICK, World, moves

ZERO = (0.0,) * 6


class ArbiterWorld(World):
    """The real Arbiter, and the invariants that it must keep."""

    def __init__(self, inputs):
        """Take the parameters.Inputs."""
        self._inputs = {one.name: one for one in inputs}
        self._arbiter = Arbiter(inputs)
        self._waiting = {}  # (input, sender) -> the velocity that waits
        self._sent = ZERO
        self._late = {}  # (input, sender) -> RestsFirst or NeverLate
        self._speaks = HighestSpeaks({one.name: (one.priority, one.timeout) for one in inputs})
        self._limits = WithinLimits()

    def happen(self, event):
        if event == TICK:
            return self._tick()
        return self._command(event._replace(at_s=self.now))

    @property
    def _speaking(self):
        """The inputs that speak, by the invariant's own record."""
        return [
            one
            for one in self._inputs.values()
            if self.now < self._speaks.spoke_s[one.name] + one.timeout
        ]

    def _tick(self):
        now = self.now
        waiting = {
            key: velocity
            for key, velocity in self._waiting.items()
            if now - self._late[key].last_s >= AT_ONCE_S
        }
        for name, sender in waiting:
            self._speaks.spoke_s[name] = now
            del self._waiting[name, sender]
        names = {(velocity, sender): name for (name, sender), velocity in waiting.items()}
        through = list(self._arbiter.waited(now))
        for velocity, sender in through:
            name = names.get((velocity, sender))
            if name:
                yield from self._through(Command(now, name, velocity, sender))
            else:
                yield "f", f"{velocity} goes through, and did not wait"
        if any(name == one.name for name, _ in waiting for one in self._highest()) and not through:
            yield "e", "the highest that speaks has waited, and does not go through"
        if self._arbiter.must_stop(now):
            self._sent = ZERO
        if moves(self._sent) and not self._speaking:
            yield "d", "no stop, though all inputs are silent"
        lull_s = self._arbiter.lull(now)
        shortest_s = min(one.timeout for one in self._inputs.values())
        spoke_s = self._speaks.spoke_s
        ends_s = [spoke_s[one.name] + one.timeout - now for one in self._speaking]
        if not 0 < lull_s <= shortest_s or (moves(self._sent) and lull_s > max(ends_s, default=0)):
            yield "d", f"asleep for {lull_s} s, and something is due sooner"

    def _highest(self):
        return sorted(self._speaking, key=lambda one: one.priority)[-1:]

    def _command(self, command):
        name, velocity, now = command.input, command.velocity, self.now
        verdict = self._arbiter.command(name, velocity, now, command.sender)
        if not all(map(math.isfinite, velocity)):
            if verdict is not Verdict.REJECTED:
                yield "c", "a command that is not finite is not rejected"
            return
        self._waiting.pop((name, command.sender), None)
        if verdict is Verdict.WAITS:
            self._waiting[name, command.sender] = velocity
        new = RestsFirst() if command.sender.is_stick else NeverLate()
        guard = self._late.setdefault((name, command.sender), new)
        is_first = guard.take(velocity, now)
        if moves(velocity) and (is_first or guard.late(now)):
            if verdict is Verdict.OBEYED:
                yield "f", f"a late command of {command.sender} is obeyed"
            return
        self._speaks.spoke_s[name] = now
        if verdict is Verdict.OBEYED:
            yield from self._through(command)
        elif self._highest()[0].name == name:
            yield "e", f"{name} is the highest that speaks, and not obeyed"

    def _through(self, command):
        self._sent = command.velocity
        for violation in filter(None, (self._limits.take(command), self._speaks.take(command))):
            yield violation.invariant, violation.what
        if moves(command.velocity) and self._late[command.input, command.sender].late(self.now):
            yield "f", f"a late command of {command.sender} is obeyed"
