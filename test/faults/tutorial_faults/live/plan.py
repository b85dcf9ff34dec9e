"""What the hands and the faults of a trial do, drawn from a seed (pure).

Times [s] count from the moment at which the robot, driven by the hands, has begun to move.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Sequence

from tutorial_faults.live.kinds import KINDS
from tutorial_testing.hands import DRIVE, RELEASED, STICK, TURBO, TURN

HELD = (DRIVE, TURN, TURBO)  # shown with LB held
WATCHED_S = 0.8  # after the last fault
UP_S = 1.0  # and so much more for a node that is restarted
# Of two such faults one would spoil the other.
SAME_PART = (
    {"kill_master", "hang_master"},
    {"unplug", "frozen_pad"},
    {"unplug", "radio_silence"},
    {"frozen_pad", "radio_silence"},
)


@dataclass(frozen=True)
class Hand:
    """At a time [s] the hands change to what they show from then on."""

    at_s: float
    shows: str


@dataclass(frozen=True)
class Fault:
    """kind: name of a kinds.Kind. strength: from 0 to 1, used as the kind says."""

    kind: str
    at_s: float
    lasts_s: float
    strength: float

    @property
    def end_s(self) -> float:
        """When it ends [s]."""
        return self.at_s + self.lasts_s


@dataclass(frozen=True)
class Plan:
    """A trial."""

    seed: int
    hands: tuple[Hand, ...]
    faults: tuple[Fault, ...]
    heading_rad: float  # of the robot at the beginning, in a cell

    @property
    def lasts_s(self) -> float:
        """How long it is watched [s]."""
        ends = [0.3] + [hand.at_s for hand in self.hands]
        ends += [f.end_s + (UP_S if KINDS[f.kind].restarts else 0.0) for f in self.faults]
        return max(ends) + WATCHED_S

    @property
    def is_radio(self) -> bool:
        """Whether the gamepad is one that may be out of reach."""
        return any(fault.kind == "radio_silence" for fault in self.faults)

    def __str__(self) -> str:
        """Return the faults in a few words."""
        faults = [f"{f.kind} at {f.at_s:.2f} s for {f.lasts_s:.2f} s" for f in self.faults]
        return " + ".join(faults) or "no fault"


def draw(seed: int, names: Sequence[str]) -> Plan:
    """Return the Plan of a seed, with faults of these kinds; the same for the same arguments."""
    random = Random(seed)
    kinds = [random.choice(names) for _ in range(random.choice((1, 2)))]
    if len(kinds) == 2 and _same_part(*kinds):
        kinds.pop()
    faults, at_s = [], random.uniform(0.05, 0.3)
    for kind in kinds:
        faults.append(Fault(kind, at_s, random.uniform(*KINDS[kind].lasts_s), random.random()))
        at_s += random.uniform(0.0, 0.6)
    return Plan(seed, _hands(random), tuple(faults), random.uniform(-math.pi, math.pi))


def _same_part(one: str, other: str) -> bool:
    a, b = KINDS[one], KINDS[other]
    return one == other or a.part == b.part != "" or {a.family, b.family} in SAME_PART


def _hands(random: Random) -> tuple[Hand, ...]:
    """Return mostly hands that hold on; some let go, and some of these take hold again."""
    hands = [Hand(0.0, DRIVE)]
    if random.random() < 0.3:
        hands.append(Hand(random.uniform(0.1, 0.6), random.choice((TURN, TURBO))))
    if random.random() < 0.4:
        at_s = random.uniform(0.65, 1.6)
        hands.append(Hand(at_s, random.choice((RELEASED, STICK))))
        if random.random() < 0.4:
            hands.append(Hand(at_s + random.uniform(0.3, 0.7), RELEASED))
            hands.append(Hand(hands[-1].at_s + random.uniform(0.3, 0.7), DRIVE))
    return tuple(hands)
