"""What the hands and the faults of a trial do, drawn from a seed (pure).

Times [s] count from the moment at which the robot, driven by the hands, has begun to move.
"""

from __future__ import annotations

from random import Random
from typing import NamedTuple, Sequence

from tutorial_faults.live.table import FAULTS
from tutorial_testing.hands import DRIVE, RELEASED, STICK, TURBO, TURN

WATCHED_S = 1.8  # after all, as a node that is restarted needs a second


class Plan(NamedTuple):
    """A trial. hands: (time, what they show from then on). hits: (time, end, name of a Fault)."""

    seed: int
    hands: list[tuple[float, str]]
    hits: list[tuple[float, float, str]]
    ends_s: float


def draw(seed: int, names: Sequence[str]) -> Plan:
    """Return the Plan of a seed, with faults of these names; the same for the same arguments.

    Mostly the hands hold on; some let go, and some of these take hold again.
    """
    random = Random(seed)
    hands, hits, at_s = [(0.0, DRIVE)], [], random.uniform(0.05, 0.3)
    chosen = random.choices(names, k=random.choice((1, 2)))
    if len({FAULTS[name].part for name in chosen}) < len(chosen):
        chosen.pop()  # two faults of one part would disturb each other
    for name in chosen:
        hits.append((at_s, at_s + random.uniform(*FAULTS[name].lasts_s), name))
        at_s += random.uniform(0.0, 0.6)
    if random.random() < 0.3:
        hands.append((random.uniform(0.1, 0.6), random.choice((TURN, TURBO))))
    if random.random() < 0.4:
        hands.append((random.uniform(0.65, 1.6), random.choice((RELEASED, STICK))))
        if random.random() < 0.4:
            hands.append((hands[-1][0] + random.uniform(0.3, 0.7), RELEASED))
            hands.append((hands[-1][0] + random.uniform(0.3, 0.7), DRIVE))
    return Plan(seed, hands, hits, max(hands[-1][0], *(hit[1] for hit in hits)) + WATCHED_S)
