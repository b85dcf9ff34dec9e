"""The answers to the probes, compared with those to the numbered Joys."""

from __future__ import annotations

from functools import cached_property
from typing import Iterable, Iterator, NamedTuple, Sequence, Tuple

from ..task import HANDOUT, LB, Joy, JoystickTask
from .evidence import FIELDS, RIGHT, SMALL, Evidence, JoySample, TwistField, is_near, no_number
from .joys import pressed

ProbeAnswer = Tuple[Joy, Sequence[float]]  # (Joy, six values of its Twist)

SLOWEST = 0.25  # an axis below this may be in a dead zone


def other_button(task: JoystickTask, joy: Joy) -> str:
    """Return the button that is pressed besides LB, or ""."""
    numbers = (index for index, value in enumerate(joy[1]) if value and index != LB)
    return next((f"buttons[{task.buttons.get(index, index)}]" for index in numbers), "")


class Silence(NamedTuple):
    """A Joy without an answer, the Joy before it, and the last Twist."""

    joy: Joy
    before: Joy
    last: Sequence[float]
    task: JoystickTask = HANDOUT


class ProbeReply(NamedTuple):
    """A field of an answer, compared with the previous answer and the first to the same Joy."""

    name: str
    axis: int
    joy: Joy
    value: float
    before: float
    again: float
    last_button: str
    task: JoystickTask

    @property
    def differs(self) -> bool:
        return not is_near(self.value, self.again)

    @property
    def stays(self) -> bool:
        return is_near(self.value, self.before) and abs(self.value) > SMALL

    @property
    def drives_on(self) -> bool:
        """Whether the robot moves where it should not."""
        given = self.joy[0][self.axis]
        # A button may reverse the direction while held, but at rest the robot must stand.
        against = self.value * given < 0 and not other_button(self.task, self.joy)
        is_odd = not given or against or (self.stays and self.differs)
        return abs(self.value) > SMALL and is_odd


class Replies:
    """The answers to the probes of a program whose rule is otherwise right."""

    def __init__(
        self, evidence: Evidence, answers: Iterable[ProbeAnswer], needs_button: bool
    ) -> None:
        """needs_button: LB must be held to drive."""
        self.evidence, self.answers, self.needs_button = evidence, [*answers], needs_button
        self.samples: list[JoySample] = [(axes, twist) for (axes, _), twist in self.answers]

    @property
    def is_right(self) -> bool:
        is_odd = no_number(self.samples) or self.odd or self.still_alone or self.drives_released
        return not is_odd and self.whole.is_right

    @cached_property
    def odd(self) -> ProbeReply | None:
        """The first answer against its Joy, or different from an earlier answer."""
        return next((reply for reply in self._replies() if reply.drives_on or reply.differs), None)

    def _replies(self) -> Iterator[ProbeReply]:
        task, samples = self.evidence.task, self.evidence.samples
        known = {(tuple(axes), pressed(LB)): twist for axes, twist in samples}
        before, last_button = samples[-1][1], ""
        for joy, twist in self.answers:
            again = known.setdefault(joy, twist)
            last_button = other_button(task, joy) or last_button
            for field, axis in RIGHT.items():
                values = twist[field], before[field], again[field]
                yield ProbeReply(FIELDS[field], axis, joy, *values, last_button, task)
            before = twist

    @property
    def _held(self) -> list[JoySample]:
        """The answers to Joys with only LB held, at rest or beyond a dead zone."""
        return [
            (axes, twist)
            for (axes, buttons), twist in self.answers
            if buttons == pressed(LB) and (not any(axes) or max(map(abs, axes)) > SLOWEST)
        ]

    @property
    def still_alone(self) -> TwistField | None:
        """The first field that is 0 when only its axis is moved."""
        still = {tuple(map(bool, axes[:2])) for axes, twist in self._held if not any(twist)}
        alone = {field: tuple(i == field.axis for i in (0, 1)) for field in self.evidence.fields}
        return next((field for field, moved in alone.items() if moved in still), None)

    @property
    def drives_released(self) -> bool:
        """Whether it drives with LB released, although the task wants it held."""
        moving = (any(twist) for (_, buttons), twist in self.answers if not buttons[LB])
        return self.needs_button and any(moving)

    @cached_property
    def whole(self) -> Evidence:
        """All answers with LB held."""
        evidence, samples = self.evidence, [*self.evidence.samples, *self._held]
        return Evidence(samples, factors=evidence.factors, task=evidence.task)
