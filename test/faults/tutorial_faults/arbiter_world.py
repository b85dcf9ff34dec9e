"""Every state of the multiplexer's rules (Arbiter, Sender), judged by (c) to (f).

Clocks: when each input falls silent; each sender's last command, and its first after a silence.
Thresholds: timeouts of 0.5 s and 0.25 s, SILENCE_S 0.5 s, SETTLING_S 0.25 s. TOGETHER_S lies
between two steps of time. They are asked in the order of the node.
"""

import math
from typing import NamedTuple, Tuple

from fake_turtlebot_sim.mux.arbitration import Arbiter, Publisher, Sender, Verdict
from fake_turtlebot_sim.mux.parameters import Input
from tutorial_faults.events import Command, Through
from tutorial_faults.explore import PASS, TICK, World, key_of, until
from tutorial_faults.invariants import (
    AT_ONCE_S,
    SILENCE_S,
    HighestSpeaks,
    NeverLate,
    RestsFirst,
    WithinLimits,
    judged,
    moves,
)

HORIZON_S = SILENCE_S + 1e-6  # the silence that counts is more than SILENCE_S
ZERO, FORWARD = (0.0,) * 6, (0.5,) + (0.0,) * 5
NOT_FINITE = (math.nan,) + (0.0,) * 5


class Configuration(NamedTuple):
    """Inputs of a multiplexer, and the senders on them."""

    inputs: Tuple[Input, ...]
    speakers: Tuple[Tuple[str, Publisher], ...]  # (input, sender)
    step_s: float = 0.0625  # in which time passes: 0.25 s for three clocks; coarser for two senders

    def events(self):
        """Return the events, by name."""
        commands = {
            f"{sender.name} on {name}: {what}": Command(0.0, name, velocity, sender)
            for name, sender in self.speakers
            for what, velocity in (("zero", ZERO), ("forward", FORWARD), ("NaN", NOT_FINITE))
        }
        return {PASS: PASS, TICK: TICK, **commands}


STICK = Input("stick", "stick", 0.5, 7)
PROGRAM = Input("program", "program", 0.5, 5)
ADA, BOB = Publisher("ada", is_stick=True), Publisher("bob", is_stick=True)
ROBBY = Publisher("robby", is_remote=True)
CONFIGURATIONS = {
    "a stick and a program": Configuration(
        (STICK, PROGRAM), (("stick", ADA), ("program", ROBBY)), step_s=0.25
    ),
    "two sticks on one input": Configuration(
        (STICK,), (("stick", ADA), ("stick", BOB)), step_s=0.25
    ),
    "a stick alone": Configuration((STICK,), (("stick", ADA),)),
    "a program alone": Configuration((PROGRAM,), (("program", ROBBY),)),
}
PAST = {"heard_s", "doubt_s", "last_s", "first_s", "rests_since_s"}
FUTURE = {"late_until_s"}
PARTS = {"_arbiter": {"_expiry_s": {}, "_senders": {}}, "_late": {}, "_speaks": {"spoke_s": {}}}


class ArbiterWorld(World):
    """The real Arbiter, and the invariants that it must keep."""

    def __init__(self, configuration):
        """Take a Configuration."""
        super().__init__(configuration.step_s, PARTS)
        self._inputs = {one.name: one for one in configuration.inputs}
        self._arbiter = Arbiter(configuration.inputs)
        self._sent = ZERO
        self._late = {}  # (input, sender) -> RestsFirst or NeverLate
        self._speaks = HighestSpeaks(
            {one.name: (one.priority, one.timeout) for one in configuration.inputs}
        )
        self._limits = WithinLimits()

    def key(self):
        """Return all that decides what follows."""
        now, arbiter, known = self._now, self._arbiter, self._arbiter._senders

        # Of two senders on one input it does not matter which is which.
        def sender_key(one):
            return key_of(one, now, HORIZON_S, past=PAST, future=FUTURE)

        senders = [
            (key[0], sender_key(known.get(key, Sender(key[1]))), sender_key(one))
            for key, one in self._late.items()
        ]
        spoke_s = self._speaks.spoke_s.items()
        return (
            key_of(arbiter, now, without={"_inputs", "_expiry_s", "_senders"}),
            *[until(now, time) for time in arbiter._expiry_s.values()],
            *[until(now, time + self._inputs[name].timeout) for name, time in spoke_s],
            tuple(sorted(senders, key=repr)),
            self._sent,
        )

    def _happen(self, event):
        if event == TICK:
            return self._tick()
        return self._command(event._replace(at_s=self._now))

    @property
    def _speaking(self):
        """The inputs that speak, by the invariant's own record."""
        return [
            one
            for one in self._inputs.values()
            if self._now < self._speaks.spoke_s[one.name] + one.timeout
        ]

    def _tick(self):
        now = self._now
        waiting = {
            key: one.waiting
            for key, one in self._arbiter._senders.items()
            if one.waiting is not None and now - self._late[key].last_s >= AT_ONCE_S
        }
        for (name, sender), velocity in waiting.items():
            self._speaks.take(Command(now, name, velocity, sender))
        through = list(self._arbiter.waited(now))
        for velocity, sender in through:
            name = next(name for name, one in waiting if one == sender)
            yield from self._through(Command(now, name, velocity, sender))
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
        name, velocity, now = command.input, command.velocity, self._now
        verdict = self._arbiter.command(name, velocity, now, command.sender)
        if not all(map(math.isfinite, velocity)):
            if verdict is not Verdict.REJECTED:
                yield "c", "a command that is not finite is not rejected"
            return
        new = RestsFirst() if command.sender.is_stick else NeverLate()
        guard = self._late.setdefault((name, command.sender), new)
        is_first = guard.take(velocity, now)
        if moves(velocity) and (is_first or guard.late(now)):
            if verdict is Verdict.OBEYED:
                yield "f", f"a late command of {command.sender} is obeyed"
            return
        self._speaks.take(command)
        if verdict is Verdict.OBEYED:
            yield from self._through(command)
        elif self._highest()[0].name == name:
            yield "e", f"{name} is the highest that speaks, and not obeyed"

    def _through(self, command):
        self._sent = command.velocity
        through = Through(self._now, command.input, command.velocity)
        for violation in judged([through], self._limits, self._speaks):
            yield violation.invariant, violation.what
        if moves(command.velocity) and self._late[command.input, command.sender].late(self._now):
            yield "f", f"a late command of {command.sender} is obeyed"
