"""What the hands and the faults of a trial do, drawn from a seed (pure).

Times [s] count from the moment at which the robot, driven by the hands, has begun to move.
"""

from dataclasses import dataclass, replace
from random import Random
from typing import Tuple

from tutorial_faults.live.kinds import KINDS, SIMULATED

# What the hands may show: the sticks, and whether LB or RB is held.
DRIVE, TURN, TURBO, STICK, RELEASED = "drive", "turn", "turbo", "stick", "released"
HELD = (DRIVE, TURN, TURBO)

SIMULATED_BLOCK = (
    20  # so many seeds in a row have simulated time, as the nodes must start anew for it
)
BLOCKS = 10  # one block of so many
WATCHED_S = 0.8  # after the last fault
UP_S = 1.0  # and so much more for a node that is started anew


@dataclass(frozen=True)
class Hand:
    """At a time [s] the hands change to what they show from then on."""

    at_s: float
    shows: str


@dataclass(frozen=True)
class Fault:
    """kind: name of a kinds.Kind. strength: from 0 to 1, what the kind makes of it."""

    kind: str
    at_s: float
    lasts_s: float
    strength: float

    @property
    def end_s(self):
        """When it ends [s]."""
        return self.at_s + self.lasts_s


@dataclass(frozen=True)
class Plan:
    """A trial. simulated: whether time is simulated."""

    seed: int
    simulated: bool
    hands: Tuple[Hand, ...]
    faults: Tuple[Fault, ...]

    @property
    def lasts_s(self):
        """How long it is watched [s]."""
        ends = [0.3] + [hand.at_s for hand in self.hands]
        for fault in self.faults:
            anew = KINDS[fault.kind].family in ("kill", "end")
            ends.append(fault.end_s + (UP_S if anew else 0.0))
        return max(ends) + WATCHED_S

    @property
    def is_radio(self):
        """Whether the gamepad is one that may be out of reach."""
        return any(fault.kind == "radio_silence" for fault in self.faults)

    def without(self, number):
        """The same without one of its faults."""
        return replace(self, faults=self.faults[:number] + self.faults[number + 1 :])

    def holding(self):
        """The same with hands that hold LB and the stick throughout."""
        return replace(self, hands=(Hand(0.0, DRIVE),))


def is_simulated(seed):
    """Whether the trial of a seed has simulated time."""
    return (seed // SIMULATED_BLOCK) % BLOCKS == BLOCKS - 1


def draw(seed, names):
    """The Plan of a seed, with faults of these kinds; the same for the same seed and kinds."""
    random = Random(seed)
    clocks = [name for name in names if KINDS[name].needs == SIMULATED]
    others = [name for name in names if KINDS[name].needs != SIMULATED]
    simulated = bool(clocks) and (is_simulated(seed) or not others)
    kinds = [random.choice(others or clocks) for _ in range(random.choice((1, 2)))]
    if simulated:
        kinds[0] = random.choice(clocks)
    if len(kinds) == 2 and _same_part(*kinds):
        kinds.pop()
    faults, at_s = [], random.uniform(0.05, 0.3)
    for kind in kinds:
        faults.append(_fault(random, kind, at_s))
        at_s += random.uniform(0.0, 0.6)
    return Plan(seed, simulated, _hands(random), tuple(faults))


def _same_part(one, other):
    """Whether two kinds hit the same part, one of which would spoil the other."""
    return (
        one == other
        or KINDS[one].part == KINDS[other].part != ""
        or {KINDS[one].family, KINDS[other].family}
        in (
            {"kill_master", "hang_master"},
            {"unplug", "frozen_pad"},
            {"unplug", "radio_silence"},
            {"frozen_pad", "radio_silence"},
            {"stopped_viewer", "slow_viewer"},
        )
    )


def _fault(random, kind, at_s):
    return Fault(kind, at_s, random.uniform(*KINDS[kind].lasts_s), random.random())


def _hands(random):
    """Mostly hands that hold on; some let go, and some of these take hold again."""
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


def in_words(plan):
    """The faults of a plan, in a few words."""
    return " + ".join(f"{f.kind} at {f.at_s:.2f} s for {f.lasts_s:.2f} s" for f in plan.faults) or (
        "no fault"
    )
