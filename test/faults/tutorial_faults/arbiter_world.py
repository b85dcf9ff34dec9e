"""Every state of the multiplexer's rules (Arbiter, Arming, Resumption), judged by (c) to (f).

Clocks: when each input falls silent, one for each sender, the end of a suspension's settling.
Thresholds: timeouts of 0.5 s and 0.25 s, REARM_S 0.5 s, SETTLING_S 0.25 s. They are asked in the
order of the node.
"""

import math
from typing import NamedTuple, Tuple

from fake_turtlebot_sim.mux.arbitration import REARM_S, Arbiter, Verdict
from fake_turtlebot_sim.mux.parameters import Input
from node_kit.arming import SETTLING_S, Arming, Resumption
from tutorial_faults.events import Command, Through
from tutorial_faults.explore import PASS, SUSPENDED, TICK, World, key_of, until
from tutorial_faults.invariants import (
    REST_S,
    HighestSpeaks,
    NeverLate,
    WithinLimits,
    judged,
    moves,
)

HORIZON_S = REST_S + 1e-6  # the silence that counts is more than REST_S
ZERO, FORWARD = (0.0,) * 6, (0.5,) + (0.0,) * 5
NOT_FINITE = (math.nan,) + (0.0,) * 5


class Configuration(NamedTuple):
    """Inputs of a multiplexer, and the senders on them."""

    inputs: Tuple[Input, ...]
    speakers: Tuple[Tuple[str, str], ...]  # (input, sender)
    step_s: float = 0.05  # in which time passes: 0.25 s for four clocks
    is_suspended: bool = True  # now and then

    def events(self):
        """Return the events, by name."""
        commands = {
            f"{sender} on {name}: {what}": Command(0.0, name, velocity, sender)
            for name, sender in self.speakers
            for what, velocity in (("zero", ZERO), ("forward", FORWARD), ("NaN", NOT_FINITE))
        }
        others = (PASS, TICK, SUSPENDED) if self.is_suspended else (PASS, TICK)
        return {**{name: name for name in others}, **commands}


STICK = Input("stick", "stick", 0.5, 7, rearm_on_zero=True)
PROGRAM = Input("program", "program", 0.5, 5)
OTHER = Input("other", "other", 0.25, 1)
CONFIGURATIONS = {
    "a stick and a program": Configuration((STICK, PROGRAM), (("stick", "ada"), ("program", "-"))),
    "two sticks on one input": Configuration(
        (STICK,), (("stick", "ada"), ("stick", "bob")), step_s=0.125, is_suspended=False
    ),
    "three programs": Configuration(
        (Input("top", "top", 0.5, 9), PROGRAM, OTHER),
        (("top", "-"), ("program", "-"), ("other", "-")),
        step_s=0.0625,
        is_suspended=False,
    ),
}


PARTS = {
    "_arbiter": {"_expiry_s": {}, "_senders": {}}, "_resumption": {}, "_late": {},
    "_speaks": {"spoke_s": {}},
}  # fmt: skip


class ArbiterWorld(World):
    """The real Arbiter, and the invariants that it must keep."""

    def __init__(self, configuration):
        """Take a Configuration."""
        super().__init__(configuration.step_s, PARTS)
        self._inputs = {one.name: one for one in configuration.inputs}
        self._arbiter = Arbiter(configuration.inputs)
        self._resumption = Resumption()
        self._sent = ZERO
        self._settled_s = -math.inf  # what comes before was sent during a suspension
        self._late = {}  # (input, sender) -> NeverLate
        self._speaks = HighestSpeaks(
            {one.name: (one.priority, one.timeout) for one in configuration.inputs}
        )
        self._limits = WithinLimits()

    def key(self):
        """Return all that decides what follows."""
        now, arbiter, known = self._now, self._arbiter, self._arbiter._senders
        parts = {"_inputs", "_expiry_s", "_senders"}
        # Of two senders on one input it does not matter which is which.
        new = Arming(rest_s=REARM_S)
        past = {"since", "last_s", "rests_since_s"}

        def sender_key(one):
            return key_of(one, now, HORIZON_S, past=past, without={"_rest_s"})

        senders = [
            (key[0], sender_key(known.get(key, new)), sender_key(one))
            for key, one in self._late.items()
        ]
        spoke_s = self._speaks.spoke_s.items()
        return (
            key_of(arbiter, now, without=parts),
            *[until(now, time) for time in arbiter._expiry_s.values()],
            *[until(now, time + self._inputs[name].timeout) for name, time in spoke_s],
            tuple(sorted(senders, key=repr)),
            until(now, self._resumption._settled_at),
            until(now, self._settled_s),
            self._resumption._needs_stop,
            self._sent,
        )

    def _happen(self, event):
        if event == TICK:
            return self._tick()
        if event != SUSPENDED:
            return self._command(event._replace(at_s=self._now))
        assert self._resumption.notice(self._resumption._seen + 1, self._now)
        self._sent, self._settled_s = ZERO, self._now + SETTLING_S
        self._arbiter.lost()
        for one in self._late.values():
            one.lost(self._now)
        return ()

    @property
    def _speaking(self):
        """The inputs that speak, by the invariant's own record."""
        return [
            one
            for one in self._inputs.values()
            if self._now < self._speaks.spoke_s[one.name] + one.timeout
        ]

    def _tick(self):
        if self._arbiter.must_stop(self._now):
            self._sent = ZERO
        if moves(self._sent) and not self._speaking:
            yield "d", "no stop, though all inputs are silent"
        lull_s = self._arbiter.lull(self._now)
        shortest_s = min(one.timeout for one in self._inputs.values())
        spoke_s = self._speaks.spoke_s
        ends_s = [spoke_s[one.name] + one.timeout - self._now for one in self._speaking]
        if not 0 < lull_s <= shortest_s or (moves(self._sent) and lull_s > max(ends_s, default=0)):
            yield "d", f"asleep for {lull_s} s, and something is due sooner"

    def _command(self, command):
        name, velocity, now = command.input, command.velocity, self._now
        if self._resumption.is_old(now):
            return
        verdict = self._arbiter.command(name, velocity, now, command.sender)
        counts = all(map(math.isfinite, velocity)) and not self._is_late(command)
        if counts:
            self._speaks.take(command)
        if verdict is not Verdict.OBEYED:
            highest = max(self._speaking, key=lambda one: one.priority, default=None)
            if counts and highest.name == name:
                yield "e", f"{name} is the highest that speaks, and not obeyed"
            return
        self._sent = velocity
        for violation in judged([Through(now, name, velocity)], self._limits, self._speaks):
            yield violation.invariant, violation.what
        if moves(velocity) and (not counts or now < self._settled_s):
            yield "f", f"a late command of {command.sender} is obeyed"

    def _is_late(self, command):
        if not self._inputs[command.input].rearm_on_zero:
            return False
        guard = self._late.setdefault((command.input, command.sender), NeverLate())
        return guard.late(command.velocity, self._now)
