"""The Joys that a check sends, and the Twists and lines of output that answer them."""

from __future__ import annotations

import collections
import math
import re
from typing import Iterable, Sequence

from ..task import AXES, LB, Joy
from .evidence import RIGHT

COUNT = 20  # of numbered Joys
BUTTONS = 12
REST = (0.0,) * AXES
FAST = (0.6, 0.7, *REST[2:])
BACK = tuple(-axis for axis in FAST)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
SLOW, STEP = 0.3, 0.005  # first speed and step of rising_joys()
ROUNDED = 0.0056  # greatest error of a value rounded to two decimals
EARLY_S = 0.06  # a Twist may seem to come this much before its Joy


def pressed(*buttons: int) -> tuple[int, ...]:
    return tuple(int(index in buttons) for index in range(BUTTONS))


AT_REST: Joy = (REST, pressed(LB))


def numbered_joys(count: int = COUNT) -> list[Joy]:
    """Return Joys with LB held, of which no two are alike, nor any two axes.

    Signs change, to reveal a rule that is right only forwards or to the left. In the last
    two an axis is at its limit of 1, the only value that int() does not change.
    """
    joys = []
    for k in range(count):
        forwards = (0.30 + 0.021 * k if k < count - 1 else 1.0) * (1 if k % 2 == 0 else -1)
        left = (0.25 + 0.017 * k if k != count - 2 else 1.0) * (1 if k % 4 < 2 else -1)
        # Each axis has its own order, so that none is proportional to another, or to a difference.
        rest = [0.03 + 0.05 * n + 0.002 * (step * k % 20) for n, step in enumerate((7, 3, 9, 1))]
        joys.append(((left, forwards, *rest), pressed(LB)))
    return joys


def rising_joys(count: int) -> list[Joy]:
    """Return Joys for a stream; each drives a little faster than the one before."""
    return [((0.2 + 0.002 * k, SLOW + STEP * k, *REST[2:]), pressed(LB)) for k in range(count)]


def low_joys() -> list[Joy]:
    """Return Joys below most limits, for a program whose rule is still unclear."""
    pairs = ((0.05, 0.06), (-0.08, 0.09), (0.11, -0.12), (-0.14, -0.15), (0.17, 0.18))
    return [((*pair, *REST[2:]), pressed(LB)) for pair in pairs]


def probes(joys: Sequence[Joy]) -> list[Joy]:
    """Return Joys for after the numbered ones: rest, repetition, single axes, LB released."""
    slow = (0.36, 0.40, *REST[2:])
    alone = [
        tuple(axis if index == moved else 0.0 for index, axis in enumerate(axes))
        for axes in (FAST, BACK)
        for moved in RIGHT.values()
    ]
    held = [FAST, REST, REST, *alone, slow, FAST, FAST, slow]
    return [
        *((axes, pressed(LB)) for axes in held),
        *(joys[index] for index in (7, 2)),
        *((axes, pressed()) for axes in (FAST, BACK, REST)),
        (FAST, pressed(LB)),
    ]


def small_and_button_probes() -> list[Joy]:
    """Return the Joys for after those: small values, and each button pressed and released."""
    smalls = [(0.05, 0.06, *REST[2:]), (0.02, 0.03, *REST[2:]), (0.01, 0.01, *REST[2:])]
    from_rest = [axes for small in smalls for axes in (REST, small)]
    slower = [FAST, *smalls, REST, FAST, smalls[-1], REST, FAST]
    joys = [(axes, pressed(LB)) for axes in [*from_rest, *slower]]
    for button in range(BUTTONS):
        held, free = pressed(LB, button), pressed(*{LB} - {button})
        joys += [(FAST, held), (REST, held), (BACK, held), (REST, free), (FAST, pressed(LB))]
    return joys


def delays(
    sent: Sequence[float],
    received: Sequence[tuple[float, str, Sequence[float]]],
    factor: float | None,
) -> list[float]:
    """Return the delay [s] from each Joy to its Twist, matched by order, or else by value.

    sent: times of rising_joys(). received: [(time, sender, six values)]. factor: of linear.x.
    """
    received = [answer for answer in received if math.isfinite(answer[2][0])]
    if len(received) == len(sent):
        return [when - sent_s for (when, _, _), sent_s in zip(received, sent)]
    times = []
    often = collections.Counter(round(twist[0], 6) for _, _, twist in received)
    for when, _, twist in received:
        if often[round(twist[0], 6)] > 1:
            continue  # at a limit, or repeated: its Joy is unknown
        k = round((twist[0] / factor - SLOW) / STEP) if factor else -1
        # A Twist older than that Joy answers another one.
        if 0 <= k < len(sent) and when > sent[k] - EARLY_S:
            times.append(when - sent[k])
    return times


def strays(moving: Sequence[bool]) -> int:
    """Return how many Twists after the first moving one are zero; rising_joys() never stop."""
    return list(moving[moving.index(True) :]).count(False) if any(moving) else 0


def displayed(joys: Sequence[Joy], output: str) -> list[Joy]:
    """Return the Joys whose axes are all in one line, with two decimals or more."""
    counts = _axes_in_a_line(joys, output)
    return [joy for joy, count in zip(joys, counts) if count == len(joy[0])]


def values_displayed(joys: Iterable[Joy], output: str, within: float = ROUNDED) -> int:
    """Return how many axes of a Joy its line shows; it takes three Joys, to rule out chance."""
    counts = sorted(_axes_in_a_line(joys, output, within))
    return counts[-3] if counts[-3] > 1 else counts[len(counts) // 2]


def _axes_in_a_line(joys: Iterable[Joy], output: str, within: float = ROUNDED) -> list[int]:
    """Return for each Joy how many of its axes are in one line. No two axes are that close."""
    texts = COLOUR.sub("", output).splitlines()
    lines = [[float(word) for word in NUMBER.findall(text)] for text in texts]

    def count(line: list[float], axes: Sequence[float]) -> int:
        return sum(any(abs(axis - seen) < within for seen in line) for axis in axes)

    return [max((count(line, joy[0]) for line in lines), default=0) for joy in joys]
