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
from tutorial_faults.events import Command, Through, Violation
from tutorial_faults.explore import Moment, copy_of, key_of, until
from tutorial_faults.invariants import REST_S, HighestSpeaks, NeverLate, WithinLimits, moves

HORIZON_S = REST_S + 1e-6  # the silence that counts is more than REST_S
ZERO, FORWARD = (0.0,) * 6, (0.5,) + (0.0,) * 5
NOT_FINITE = (math.nan,) + (0.0,) * 5
PASS, LOOK, SUSPENDED = "time passes", "look", "suspended"


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
        others = (PASS, LOOK, SUSPENDED) if self.is_suspended else (PASS, LOOK)
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


class ArbiterWorld:
    """The real Arbiter, and the invariants that it must keep."""

    def __init__(self, configuration):
        """Take a Configuration."""
        self._step_s = configuration.step_s
        self._inputs = {one.name: one for one in configuration.inputs}
        self._arbiter = Arbiter(configuration.inputs)
        self._resumption = Resumption()
        self._now = Moment(0)
        self._sent = ZERO
        self._settled_s = -math.inf  # what comes before was sent during a suspension
        self._late = {}  # (input, sender) -> NeverLate
        self._speaks = HighestSpeaks(
            {one.name: (one.priority, one.timeout) for one in configuration.inputs}
        )
        self._limits = WithinLimits()

    def copy(self):
        """Return a copy that shares what does not change."""
        new = copy_of(self)
        new._arbiter = arbiter = copy_of(self._arbiter)
        arbiter._expiry_s = dict(arbiter._expiry_s)
        arbiter._senders = {key: copy_of(one) for key, one in arbiter._senders.items()}
        new._resumption = copy_of(self._resumption)
        new._late = {key: copy_of(one) for key, one in self._late.items()}
        new._speaks = copy_of(self._speaks)
        new._speaks.spoke_s = dict(self._speaks.spoke_s)
        return new

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

    def take(self, event):
        """Let an event happen (a number: seconds pass); return the Violations."""
        if event == PASS or isinstance(event, float):
            self._now += self._step_s if event == PASS else event
            return []
        if event == LOOK:
            return self._look()
        if event == SUSPENDED:
            assert self._resumption.notice(self._resumption._seen + 1, self._now)
            self._sent, self._settled_s = ZERO, self._now + SETTLING_S
            self._arbiter.lost()
            for one in self._late.values():
                one.lost(self._now)
            return []
        return self._command(event._replace(at_s=self._now))

    @property
    def _speaking(self):
        """The inputs that speak, by the invariant's own record."""
        return [
            one
            for one in self._inputs.values()
            if self._now < self._speaks.spoke_s[one.name] + one.timeout
        ]

    def _look(self):
        if self._arbiter.must_stop(self._now):
            self._sent = ZERO
        wrong = []
        if moves(self._sent) and not self._speaking:
            wrong.append(("d", "no stop, though all inputs are silent"))
        lull_s = self._arbiter.lull(self._now)
        shortest_s = min(one.timeout for one in self._inputs.values())
        spoke_s = self._speaks.spoke_s
        ends_s = [spoke_s[one.name] + one.timeout - self._now for one in self._speaking]
        if not 0 < lull_s <= shortest_s or (moves(self._sent) and lull_s > max(ends_s, default=0)):
            wrong.append(("d", f"asleep for {lull_s} s, and something is due sooner"))
        return [Violation(letter, self._now, what) for letter, what in wrong]

    def _command(self, command):
        name, velocity, now = command.input, command.velocity, self._now
        if self._resumption.is_old(now):
            return []
        verdict = self._arbiter.command(name, velocity, now, command.sender)
        counts = all(map(math.isfinite, velocity)) and not self._is_late(command)
        if counts:
            self._speaks.take(command)
        if verdict is not Verdict.OBEYED:
            highest = max(self._speaking, key=lambda one: one.priority, default=None)
            if counts and highest.name == name:
                return [Violation("e", now, f"{name} is the highest that speaks, and not obeyed")]
            return []
        self._sent = velocity
        through = Through(now, name, velocity)
        found = [self._limits.take(through), self._speaks.take(through)]
        if moves(velocity) and (not counts or now < self._settled_s):
            found.append(Violation("f", now, f"a late command of {command.sender} is obeyed"))
        return [violation for violation in found if violation]

    def _is_late(self, command):
        if not self._inputs[command.input].rearm_on_zero:
            return False
        guard = self._late.setdefault((command.input, command.sender), NeverLate())
        return guard.late(command.velocity, self._now)
