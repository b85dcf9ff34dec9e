"""Every reachable state of the rules is gone through; and bugs put in on purpose are found so.

With -s it prints how many states there are, and how deep they lie.
"""

import importlib.util
from pathlib import Path

import pytest

from tutorial_faults import (
    arbiter_world,
    driver_world,
    teleoperation_alphabet,
    teleoperation_world,
)
from tutorial_faults.broken import broken
from tutorial_faults.explore import Moment, explore, key_of

_rows = importlib.util.spec_from_file_location(
    "lines_of_defence", Path(__file__).with_name("lines_of_defence.py")
)
lines_of_defence = importlib.util.module_from_spec(_rows)
_rows.loader.exec_module(lines_of_defence)
LINES = lines_of_defence.LINES


def worlds():
    """From the name of an exploration to how it begins (made anew each time), and its events."""
    for name, given in teleoperation_alphabet.CONFIGURATIONS.items():
        yield (
            name,
            lambda given=given: teleoperation_world.TeleoperationWorld(**given),
            teleoperation_alphabet.events_of(name),
        )
    for name, inputs in arbiter_world.CONFIGURATIONS.items():
        yield name, lambda inputs=inputs: arbiter_world.ArbiterWorld(inputs), inputs.events()
    yield "driver", driver_world.DriverWorld, driver_world.EVENTS


WORLDS = {name: (start, events) for name, start, events in worlds()}


@pytest.mark.parametrize("name", WORLDS)
def test_exploration_finds_no_violation_in_any_state(name):
    start, events = WORLDS[name]
    explored = explore(start(), events)
    print(f"\n{name}: {explored}")
    assert not explored.violations, explored
    assert explored.states > 100


@pytest.mark.parametrize(
    ("module", "right", "wrong", "world"), [line[1:] for line in LINES], ids=[x[0] for x in LINES]
)
def test_exploration_finds_a_bug(module, right, wrong, world):
    start, events = WORLDS[world]
    with broken(module, right, wrong):
        explored = explore(start(), events)
    print(f"\n{explored}")
    assert explored.violations, explored


def test_a_bug_is_gone_with_its_test():
    def opened():
        start, _ = WORLDS["driver"]
        return start().take("open: of the kernel")

    bug = ("gamepad.driver.schedule", "self.due = math.inf", "1 / 0")
    with broken(*bug), pytest.raises(ZeroDivisionError):
        opened()
    assert opened() == []


def test_a_bug_that_is_not_put_in_is_an_error():
    with pytest.raises(ValueError, match="0 times"), broken("gamepad.driver.driver", "no line", ""):
        pass


class Counter:
    """Counts to a number, and is then wrong; or counts for ever."""

    def __init__(self, number, most=None):
        self.number, self.most = number, most

    def copy(self):
        return Counter(self.number, self.most)

    def key(self):
        return self.number

    def take(self, event):
        self.number += event
        if self.number == self.most:
            raise ArithmeticError("too many")
        return []


def test_the_shortest_way_to_a_violation_is_told():
    explored = explore(Counter(0, 7), {"one": 1, "two": 2})
    assert [way for _, way in explored.violations] == [("one", "two", "two", "two")]
    assert "too many" in str(explored)


def test_states_without_end_are_told():
    with pytest.raises(RuntimeError, match="grows for ever"):
        explore(Counter(0), {"one": 1}, most_states=100)


def test_an_attribute_that_is_shared_is_told():
    one = Counter(0)
    one.parts = []
    with pytest.raises(TypeError, match=r"Counter\.parts is new"):
        key_of(one, Moment(0))


def test_a_moment_is_exact():
    moment = Moment(0)
    for _ in range(10):
        moment += 0.1
    assert moment - Moment(0) == 1.0
    assert moment + float("inf") == float("inf")
    assert moment - 0.5 == Moment(500_000)
    assert float("inf") - moment == float("inf")
