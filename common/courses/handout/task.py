"""What a variant of the handout's task changes: axes, buttons, topics, factors, names.

Checks use the handout's axes and buttons; a Joy is rearranged when it is sent. Messages take what a
variant may change from a Words.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable, Mapping, Sequence, Tuple, TypeVar

from tutorial_check import Task, Variant

BEGINNER, PACKAGE, NAME = "beginner_tutorials", "joy2twist", "joy2twist.py"
JOY, CMD_VEL = "/joy", "/cmd_vel"
LB = 4  # the dead-man button of the handout's memo
FIELDS = {"axis_linear": (1, "scale_linear"), "axis_angular": (0, "scale_angular")}
AXES = 6
NEUTRAL = ((0.0,) * AXES, (0,) * 12)  # a Joy at rest
OF_ALL = ("/rosout", "/rosout_agg", "/clock")  # topics that every node has
TOPICS = {"joy": JOY, "cmd_vel": CMD_VEL}

T = TypeVar("T")
Joy = Tuple[Tuple[float, ...], Tuple[int, ...]]  # (axes, buttons)


@dataclass(frozen=True)
class Words:
    """Names of a task's values for messages; for hints, the values themselves."""

    joy: str
    cmd_vel: str
    package: str
    lb: str
    button: str  # LB in a program
    axes: tuple[str, ...]  # in a program, by the handout's index
    sticks: tuple[str, ...]  # likewise, elsewhere
    rules: Mapping[int, str]  # {axis that drives: the expression for its field}


def order(places: Mapping[int, int]) -> dict[int, int]:
    """Return a permutation, {from: to}, with these places."""
    left = [place for place in places.values() if place not in places]
    free = [place for place in places if place not in places.values()]
    return {**places, **dict(zip(left, free))}


def moved(values: Sequence[T], places: Mapping[int, int]) -> tuple[T, ...]:
    by_place = {places.get(index, index): value for index, value in enumerate(values)}
    return tuple(by_place[index] for index in range(len(values)))


class JoystickTask(Task):
    """A variant of the handout's task."""

    def __init__(self, values: Variant) -> None:
        """values: see course.yaml."""
        super().__init__(values)
        self.axes = order({index: values.get(name, index) for name, (index, _) in FIELDS.items()})
        self.buttons = order({LB: values.get("enable_button", LB)})
        self.topics = {TOPICS[key]: values[key] for key in TOPICS if key in values}
        # {index of linear.x or angular.z in a Twist: factor}; if there is none, any is right.
        given = (values.get(scale) for _, scale in FIELDS.values())
        self.factors = {i: abs(scale) for i, scale in zip((0, 5), given) if scale is not None}
        # For a negative factor the axis is sent negated, so that checks see a positive factor.
        self.signs = {i: -1 if values.get(scale, 1) < 0 else 1 for i, scale in FIELDS.values()}
        self.needs_button = "enable_button" in values
        scales = [scale for _, scale in FIELDS.values()]
        self.names = self._words({key: key if key in scales else f"<{key}>" for key in values})
        self.answers = self._words(values)

    def _words(self, said: Mapping[str, object]) -> Words:
        """Return the Words for {value's name: its name or value in messages}."""
        axes = [f"axes[{self.axes.get(index, index)}]" for index in range(AXES)]
        sticks, rules = [f"axis {index}" for index in range(AXES)], {}
        for key, (index, scale) in FIELDS.items():
            if isinstance(said.get(key), str):
                axes[index] = sticks[index] = f"axes[{key}]"
            rules[index] = f"{said[scale]} * {axes[index]}" if scale in said else axes[index]
        number = said.get("enable_button", LB)
        button = number if isinstance(number, str) else f"buttons[{number}]"
        lb = button if "enable_button" in said else "LB"
        plain = {**TOPICS, "package": PACKAGE}
        joy, cmd_vel, package = (str(said.get(key, plain[key])) for key in plain)
        return Words(joy, cmd_vel, package, lb, button, tuple(axes), tuple(sticks), rules)

    def joy(self, joy: Joy) -> Joy:
        """Return the (axes, buttons) to send to this program instead of the handout's Joy."""
        axes = [self.signs.get(index, 1) * value for index, value in enumerate(joy[0])]
        return moved(axes, self.axes), moved(joy[1], self.buttons)

    def held(self, left: float, forwards: float) -> Joy:
        """Return the Joy for this program with LB held and the stick at these positions."""
        buttons = tuple(int(index == LB) for index in range(12))
        return self.joy(((left, forwards, 0.0, 0.0, 0.0, 0.0), buttons))

    def product(self, factor: float, axis: int) -> str:
        """Return words for a program's product of factor and axis."""
        return f"{self.signs.get(axis, 1) * factor:.2f} * {self.names.axes[axis]}"

    def topic(self, name: str) -> str:
        return self.topics.get(name, name)

    def name_of(self, package: str) -> str:
        return self.values.get("package", package) if package == PACKAGE else package

    def in_messages(self, package: str) -> str:
        return self.names.package if package == PACKAGE else package

    def fill(self, text: str) -> str:
        return text.format(n=self.names)


HANDOUT = JoystickTask({})


def other_topic(topics: Iterable[str], wanted: str, types: Mapping[str, str], kind: str) -> str:
    """Return a topic other than the wanted one, with its type if that differs, too; or ""."""
    topic = min(set(topics) - {wanted, *OF_ALL}, default="")
    return topic if types.get(topic, kind) == kind else f"{topic}, of type {types[topic]}"
