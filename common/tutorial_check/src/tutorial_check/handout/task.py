"""What a variant of the handout's task changes: axes, buttons, topics, factors, names. Pure.

Checks think of the handout's values; a Joy is rearranged as it is sent, a topic renamed as a program
is started, and the words are put back. So each check, and each diagnosis, serves all variants.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any, Callable, Mapping, Sequence, Tuple, TypeVar

from tutorial_check.model import Result
from tutorial_check.variants import UNASKED, Task, Variant

PACKAGE = "joy2twist"
LB = 4  # the dead-man button of the handout's memo
FIELDS = {"axis_linear": (1, "scale_linear"), "axis_angular": (0, "scale_angular")}
TOPICS = {"joy": "/joy", "cmd_vel": "/cmd_vel"}
SOURCE = "   in: "  # what follows it is a line of the student's
LAUNCHES = ("handout 5", "handout 6.1")  # whose topics are those outside of the program
# How a value of the handout stands in the words of a check; a package not within a path.
WORDS = {
    rf"buttons\[{LB}\]|\bLB\b": "enable_button",
    rf"(?<![\w/]){PACKAGE}(?![\w.])": "package",
    "about 10 times a second": "rate",
    **{rf"(?<![\w/]){topic}(?![\w/])": key for key, topic in TOPICS.items()},
}

T = TypeVar("T")
Joy = Tuple[Tuple[float, ...], Tuple[int, ...]]  # (axes, buttons)


def order(places: Mapping[int, int]) -> dict[int, int]:
    """Return a rearrangement with these places, {from: to}, in which nothing gets lost."""
    left = [each for each in places.values() if each not in places]
    free = [each for each in places if each not in places.values()]
    return {**places, **dict(zip(left, free))}


def moved(values: Sequence[T], places: Mapping[int, int]) -> tuple[T, ...]:
    found = {places.get(index, index): value for index, value in enumerate(values)}
    return tuple(found[index] for index in range(len(values)))


class JoystickTask(Task):
    """A variant of the handout's task."""

    def __init__(self, values: Variant) -> None:
        """values: see course.yaml."""
        super().__init__(values)
        self.axes = order({index: values.get(name, index) for name, (index, _) in FIELDS.items()})
        self.buttons = order({LB: values.get("enable_button", LB)})
        self.topics = {TOPICS[key]: values[key] for key in TOPICS if key in values}
        # Of linear.x and angular.z, by the index of the Twist's values; without one any is right.
        scales = (values.get(scale) for _, scale in FIELDS.values())
        self.factors = {index: abs(each) for index, each in zip((0, 5), scales) if each is not None}
        # For a factor below 0 the axis is sent with the other sign: the checks see one above 0.
        self.signs = {i: -1 if values.get(scale, 1) < 0 else 1 for i, scale in FIELDS.values()}
        self.needs_button = "enable_button" in values

    def joy(self, joy: Joy) -> Joy:
        """Return the Joy, (axes, buttons), that is to this program what a Joy is to the handout's."""
        axes = [self.signs.get(index, 1) * value for index, value in enumerate(joy[0])]
        return moved(axes, self.axes), moved(joy[1], self.buttons)

    def topic(self, name: str) -> str:
        return self.topics.get(name, name)

    def known_as(self, package: str) -> str:
        return {PACKAGE: f"not_{PACKAGE}", self.named(PACKAGE): PACKAGE}.get(package, package)

    def named(self, package: str) -> str:
        return self.values.get("package", package) if package == PACKAGE else package

    def words(self, result: Result) -> Result:
        """Return a result as of this task. Values stand in hints alone; else they have their names."""
        if not self.values:
            return result
        launches = result.section.startswith(LAUNCHES)
        ways = {"expected": self._scaled_name, "hint": self._value}
        texts: dict[str, Any] = {
            name: self._translated(getattr(result, name), ways.get(name, self._name), launches)
            for name in ("title", "expected", "seen", "look", "hint")
        }
        return replace(result, **texts)

    def _translated(self, text: str, say: Callable[[str], str], launches: bool) -> str:
        """Return a text in which say(name of a value) stands for what the handout has."""
        keys = {i: key for key, (i, scale) in FIELDS.items() if {key, scale} & set(self.values)}

        def axis(found: re.Match[str]) -> str:
            number = int(found[1] or found[2])
            if number in keys:
                return say(keys[number])
            return found[0].replace(found[1] or found[2], str(self.axes.get(number, number)))

        def factor(found: re.Match[str]) -> str:
            return f"{self.signs.get(int(found[2]), 1) * float(found[1]):.2f}{found[0][len(found[1]) :]}"

        ours, source, own = text.partition(SOURCE)
        ours = re.sub(r"(-?\d+\.\d\d) \* axes\[(\d)\]", factor, ours)
        ours = re.sub(r"axes\[(\d)\]|\baxis (\d)\b", axis, ours)
        for pattern, key in WORDS.items():
            if key in self.values and not (launches and key in TOPICS):
                ours = re.sub(pattern, say(key), ours)
        ours = re.sub(rf"{UNASKED}(?=/)|\bnot_(?={PACKAGE}\b)", "", ours)
        return ours + source + own

    def _name(self, key: str) -> str:
        """Return what stands for a value where it is not to be given away."""
        given = self.values
        places = {key: f"axes[{key if key in given else i}]" for key, (i, _) in FIELDS.items()}
        return {**places, "rate": "as often as rate says"}.get(key, f"<{key}>")

    def _scaled_name(self, key: str) -> str:
        scale = FIELDS.get(key, (0, ""))[1]
        return f"{scale} * {self._name(key)}" if scale in self.values else self._name(key)

    def _value(self, key: str) -> str:
        value = self.values.get(key, FIELDS.get(key, (None,))[0])
        if key in FIELDS:
            scale = self.values.get(FIELDS[key][1])
            return f"axes[{value}]" if scale is None else f"{scale} * axes[{value}]"
        buttons = {"enable_button": f"buttons[{value}]", "rate": f"{value} times a second"}
        return buttons.get(key, str(value))
