"""Which Joys a check sends, and what is wrong with the answers that come for them. Pure."""

from __future__ import annotations

import collections
import math
import re
from typing import Iterable, NamedTuple, Sequence, Tuple

from tutorial_check import Row, find

from ..task import AXES, HANDOUT, LB, Joy, JoystickTask
from . import rules
from .evidence import FIELDS, RIGHT, SMALL, Evidence, is_near, no_number

Answer = Tuple[Joy, Sequence[float]]  # and the six values of its Twist

BUTTONS = 12
REST = (0.0,) * AXES
FAST = (0.6, 0.7, *REST[2:])
BACK = tuple(-axis for axis in FAST)
SLOWEST = 0.25  # an axis below this may be in a dead zone, and is no measure of a factor


def _pressed(*pressed: int) -> tuple[int, ...]:
    return tuple(int(index in pressed) for index in range(BUTTONS))


NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
SLOW, STEP = 0.3, 0.005  # start and step of rising_joys()
ROUNDED = 0.0056  # to two decimals a value is off by no more
EARLY_S = 0.06  # by which a Twist may seem to come before its Joy
AT_REST: Joy = (REST, _pressed(LB))


def numbered_joys(count: int) -> list[Joy]:
    """Return Joys of which no two are alike, nor any two axes, with LB held.

    Signs change, so that a rule which is right only forwards or to the left is found out. In the
    last two an axis is pushed as far as it goes, which int() alone leaves as it is.
    """
    joys = []
    for k in range(count):
        forwards = (0.30 + 0.021 * k if k < count - 1 else 1.0) * (1 if k % 2 == 0 else -1)
        left = (0.25 + 0.017 * k if k != count - 2 else 1.0) * (1 if k % 4 < 2 else -1)
        # Each in an order of its own, so that none is in proportion to another, or to a difference.
        rest = [0.03 + 0.05 * n + 0.002 * (step * k % 20) for n, step in enumerate((7, 3, 9, 1))]
        joys.append(((left, forwards, *rest), _pressed(LB)))
    return joys


def rising_joys(count: int) -> list[Joy]:
    """Return Joys that come one after another at once; each drives, a little faster than before."""
    return [((0.2 + 0.002 * k, SLOW + STEP * k, *REST[2:]), _pressed(LB)) for k in range(count)]


def low_joys() -> list[Joy]:
    """Return Joys below most limits, for a program that the numbered ones do not prove right."""
    pairs = ((0.05, 0.06), (-0.08, 0.09), (0.11, -0.12), (-0.14, -0.15), (0.17, 0.18))
    return [((*pair, *REST[2:]), _pressed(LB)) for pair in pairs]


def probes(joys: Sequence[Joy]) -> list[Joy]:
    """Return Joys after the numbered ones: rest, the same twice, one axis alone, LB released."""
    slow = (0.36, 0.40, *REST[2:])
    alone = [
        tuple(axis if index == moved else 0.0 for index, axis in enumerate(axes))
        for axes in (FAST, BACK)
        for moved in RIGHT.values()
    ]
    held = [FAST, REST, REST, *alone, slow, FAST, FAST, slow]
    return [
        *((axes, _pressed(LB)) for axes in held),
        *(joys[index] for index in (7, 2)),
        *((axes, _pressed()) for axes in (FAST, BACK, REST)),
        (FAST, _pressed(LB)),
    ]


def small_and_button_probes() -> list[Joy]:
    """Return the Joys after those: small values, and each button pressed and released."""
    smalls = [(0.05, 0.06, *REST[2:]), (0.02, 0.03, *REST[2:]), (0.01, 0.01, *REST[2:])]
    from_rest = [axes for small in smalls for axes in (REST, small)]
    slower = [FAST, *smalls, REST, FAST, smalls[-1], REST, FAST]
    joys = [(axes, _pressed(LB)) for axes in [*from_rest, *slower]]
    for button in range(BUTTONS):
        held, free = _pressed(LB, button), _pressed(*{LB} - {button})
        joys += [(FAST, held), (REST, held), (BACK, held), (REST, free), (FAST, _pressed(LB))]
    return joys


def _other_button(task: JoystickTask, buttons: Sequence[int]) -> str:
    """Return which button is pressed besides LB, or an empty text."""
    pressed = (index for index, value in enumerate(buttons) if value and index != LB)
    return next((f"buttons[{task.buttons.get(index, index)}]" for index in pressed), "")


class Silence(NamedTuple):
    """A Joy that no Twist answered, the one before it, and the last Twist that came."""

    joy: Joy
    before: Joy
    last: Sequence[float]
    task: JoystickTask = HANDOUT

    @property
    def still_axis(self) -> str:
        axes = self.task.names.axes
        return next((axes[axis] for axis in RIGHT.values() if not self.joy[0][axis]), "")


ALWAYS = "publish for every Joy, with no `if` around it"
SILENCES = (
    Row(lambda s: not s.joy[1][LB] and not s.before[1][LB] and not any(s.last),
        "only one zero after {f.task.names.lb} is released, and then silence",
    "without {f.task.answers.lb} publish Twist(), all zero, for every Joy, not only for the first"),
    Row(lambda s: s.joy == s.before, "no Twist for the same Joy again",
        ALWAYS + ": not only for a new one"),
    Row(lambda s: _other_button(s.task, s.joy[1]),
        "no Twist for a Joy with {found} pressed: the robot drives on",
        "silence stops no robot: to stop it publish Twist(), all zero, before return"),
    Row(lambda s: not s.joy[1][LB],
        "no Twist for a Joy with {f.task.names.lb} released ({f.task.names.button} = 0):"
        " the robot drives on",
        "silence stops no robot: with {f.task.answers.lb} released publish Twist(), all zero"),
    Row(lambda s: not any(s.joy[0]), "no Twist for a Joy at rest, all axes 0: the robot drives on",
        ALWAYS + ": zero is what stops the robot"),
    Row(lambda s: s.still_axis, "no Twist for a Joy with {found} = 0", ALWAYS),
    Row(lambda s: True, "no Twist for a Joy of another size", ALWAYS),
)  # fmt: skip


class Reply(NamedTuple):
    """One field of an answer, with that to the Joy before, and to the same Joy the first time."""

    name: str
    axis: int
    joy: Joy
    value: float
    before: float
    again: float
    last_button: str
    task: JoystickTask

    @property
    def other(self) -> str:
        return _other_button(self.task, self.joy[1])

    @property
    def differs(self) -> bool:
        return not is_near(self.value, self.again)

    @property
    def drives_on(self) -> str:
        """Return how the robot moves where it should not; empty if it does not."""
        given = self.joy[0][self.axis]
        keeps = is_near(self.value, self.before) and abs(self.value) > SMALL
        # A button may turn the direction while it is held, but at rest the robot stands.
        against = self.value * given < 0 and not self.other
        if abs(self.value) <= SMALL or not (not given or against or (keeps and self.differs)):
            return ""
        return "stays" if keeps else "is"

    @property
    def when(self) -> str:
        names = self.task.names
        lb = "" if self.joy[1][LB] else f" and {names.lb} released"
        other = f" and {self.other} pressed" if self.other else ""
        return f"{names.axes[self.axis]} is {self.joy[0][self.axis]:.2f}{lb}{other}"


REPLIES = (
    Row(lambda r: r.drives_on, "{f.name} {found} {f.value:.2f} when {f.when}: the robot drives on",
        "{f.name} comes from this Joy alone, zero as well: a new Twist() in the callback,"
        " no += and no `if` around the line"),
    Row(lambda r: r.differs and not r.other and r.last_button,
        "the same Joy gives {f.name} = {f.again:.2f} and, once {found} was pressed, {f.value:.2f}",
        "a button changes the speed only while it is held: set the factor again in the callback"),
    Row(lambda r: r.differs,
        "{f.name} depends on earlier Joys: the same Joy gives {f.again:.2f} and {f.value:.2f}",
        rules.ONLY_THIS),
)  # fmt: skip


def judge_probes(
    evidence: Evidence, answers: Iterable[Answer], needs_button: bool = False
) -> tuple[str, str]:
    """Return (complaint, hint), as rules.judge() does, about the answers to the probes.

    evidence: the numbered Joys, whose rule is right. needs_button: LB must be held to drive.
    """
    answers, samples, task = list(answers), evidence.samples, evidence.task
    odd = no_number([(axes, twist) for (axes, _), twist in answers])
    if odd:
        return odd, "look at what it is calculated from"
    known = {(tuple(axes), _pressed(LB)): twist for axes, twist in samples}
    before, last_button = samples[-1][1], ""
    for joy, twist in answers:
        again = known.setdefault(joy, twist)
        last_button = _other_button(task, joy[1]) or last_button
        for field, axis in RIGHT.items():
            values = twist[field], before[field], again[field]
            wrong = find(REPLIES, Reply(FIELDS[field], axis, joy, *values, last_button, task))
            if wrong:
                return wrong.seen, wrong.hint
        before = twist
    held = [
        (axes, twist)
        for (axes, buttons), twist in answers
        if buttons == _pressed(LB) and (not any(axes) or max(map(abs, axes)) > SLOWEST)
    ]
    for field, axis in RIGHT.items():
        if any(axes[axis] and not axes[1 - axis] and not any(twist) for axes, twist in held):
            seen = f"{FIELDS[field]} is 0 when {task.names.axes[axis]} alone is moved"
            hint = f"{FIELDS[field]} = {task.answers.rules[axis]}, whatever the other axis is"
            return seen, hint
    if needs_button and any(any(twist) for (_, buttons), twist in answers if not buttons[LB]):
        hint = f"publish Twist(), all zero, unless {task.answers.lb} is held"
        return f"the robot drives with {task.names.lb} released", hint
    whole = Evidence([*samples, *held], factors=evidence.factors, task=task)
    complaint, hint = rules.judge(whole)
    return (complaint, hint) if complaint else ("", "")


def delays(
    sent: Sequence[float],
    received: Sequence[tuple[float, str, Sequence[float]]],
    factor: float | None,
) -> list[float]:
    """Return [s] from each Joy to its Twist: the next, or if some are missing that of its value.

    sent: times of rising_joys(); received: [(when, sender, six values)]; factor: linear.x, or None.
    """
    received = [each for each in received if math.isfinite(each[2][0])]
    if len(received) == len(sent):
        return [when - asked for (when, _, _), asked in zip(received, sent)]
    found = []
    often = collections.Counter(round(twist[0], 6) for _, _, twist in received)
    for when, _, twist in received:
        if often[round(twist[0], 6)] > 1:
            continue  # at a limit, or repeated: that does not say which
        k = round((twist[0] / factor - SLOW) / STEP) if factor else -1
        # No answer is older than its Joy: then the value answers another one.
        if 0 <= k < len(sent) and when > sent[k] - EARLY_S:
            found.append(when - sent[k])
    return found


def strays(moving: Sequence[bool]) -> int:
    """Return how many Twists are zero after the first that moves, as all for rising_joys() do."""
    return list(moving[moving.index(True) :]).count(False) if any(moving) else 0


def displayed(joys: Sequence[Joy], output: str) -> list[Joy]:
    """Return the Joys of which a line has all axes, with two decimals or more."""
    return [joy for joy, count in zip(joys, _shown(joys, output)) if count == len(joy[0])]


def values_shown(joys: Iterable[Joy], output: str, within: float = ROUNDED) -> int:
    """Return how many axes of a Joy a line has, as for three Joys; one may be there by chance."""
    counts = sorted(_shown(joys, output, within))
    return counts[-3] if counts[-3] > 1 else counts[len(counts) // 2]


def _shown(joys: Iterable[Joy], output: str, within: float = ROUNDED) -> list[int]:
    """Return for each Joy how many of its axes are in one line. No two of a Joy are as near."""
    lines = [[float(word) for word in NUMBER.findall(line)] for line in output.splitlines()]

    def count(line: list[float], axes: Sequence[float]) -> int:
        return sum(any(abs(axis - seen) < within for seen in line) for axis in axes)

    return [max((count(line, joy[0]) for line in lines), default=0) for joy in joys]
