"""Every reachable state of the rules is judged; and each defence that is taken away is missed.

With -s it prints how many states there are, and how deep they lie.
"""

import importlib.util
from pathlib import Path

import pytest

from tutorial_faults import arbiter_world, driver_world, teleoperation_alphabet
from tutorial_faults.explore import Moment, explore, key_of
from tutorial_faults.teleoperation_world import TeleoperationWorld

_rows = importlib.util.spec_from_file_location("defences", Path(__file__).with_name("defences.py"))
defences = importlib.util.module_from_spec(_rows)
_rows.loader.exec_module(defences)


def worlds():
    """Yield the name of an exploration, a function that makes its World, and its events."""
    for name, given in teleoperation_alphabet.CONFIGURATIONS.items():
        events = teleoperation_alphabet.events_of(name)
        yield name, lambda given=given: TeleoperationWorld(**given), events
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
    ("where", "name", "instead", "world"),
    [row[1:] for row in defences.DEFENCES],
    ids=[row[0] for row in defences.DEFENCES],
)
def test_exploration_misses_a_defence(where, name, instead, world, monkeypatch):
    monkeypatch.setattr(where, name, instead)
    start, events = WORLDS[world]
    explored = explore(start(), events)
    print(f"\n{explored}")
    assert explored.violations, explored


class Counter:
    """Counts to a number, and is then wrong; or counts forever."""

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


def test_the_shortest_way_to_a_violation_is_reported():
    explored = explore(Counter(0, 7), {"one": 1, "two": 2})
    assert [way for _, way in explored.violations] == [("one", "two", "two", "two")]
    assert "too many" in str(explored)


def test_states_without_end_are_an_error():
    with pytest.raises(RuntimeError, match="grows forever"):
        explore(Counter(0), {"one": 1}, most_states=100)


def test_an_attribute_that_is_shared_is_an_error():
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
