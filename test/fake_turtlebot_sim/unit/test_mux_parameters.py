"""Parameters of cmd_vel_mux: a TurtleBot's own file works, each mistake is one clear line."""

import pytest
import yaml

from fake_turtlebot_sim.mux.parameters import Input, parse_mux_parameters
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("A TurtleBot's own mux.yaml works; a mistake is one line")
OURS = REPOSITORY / "fake_turtlebot_sim/config/cmd_vel_mux.yaml"
TELEOP = {"name": "teleop", "topic": "input/teleop", "timeout": 1.0, "priority": 7}
NAVI = {"name": "navi", "topic": "input/navi", "timeout": 1.0, "priority": 5}

# As in turtlebot_bringup's param/mux.yaml, with its names of inputs.
OF_A_TURTLEBOT = """
subscribers:
  - {name: "Safe reactive controller", topic: "input/safety_controller", timeout: 0.2, priority: 10}
  - {name: "Teleoperation", topic: "input/teleop", timeout: 1.0, priority: 7}
  - {name: "Navigation", topic: "input/navi", timeout: 1.0, priority: 5}
"""


def with_teleop(**changes):
    return {"subscribers": [{**TELEOP, **changes}, NAVI]}


def test_a_turtlebots_own_file_works_as_it_is():
    parameters = parse_mux_parameters(yaml.safe_load(OF_A_TURTLEBOT))
    assert parameters.publisher == "output"
    assert parameters.subscribers[1] == Input("Teleoperation", "input/teleop", 1.0, 7)
    numbers = {entry.topic: (entry.timeout, entry.priority) for entry in parameters.subscribers}
    ours = parse_mux_parameters(yaml.safe_load(OURS.read_text())).subscribers
    numbers["input/switch"] = (1.0, 6)  # a TurtleBot has no such input
    assert {entry.topic: (entry.timeout, entry.priority) for entry in ours} == numbers
    assert hash(parse_mux_parameters(with_teleop(priority=0, timeout=60.0)))  # everything is frozen


@pytest.mark.parametrize(("given", "parts"), [
    ({}, ["~subscribers: missing", "input/teleop"]),
    ({"subscribers": TELEOP}, ["~subscribers: {'name': 'teleop'", "list of inputs"]),
    ({"subscribers": ["teleop"]}, ["entry 1: 'teleop'", "must be as in"]),
    (with_teleop(name="navi"), ["name: 'navi'", "twice"]),
    (with_teleop(priority=5), ["priority: 5", "twice"]),
    (with_teleop(name="idle"), ["entry 1: name: 'idle'", "no input is active"]),
    (with_teleop(topic="input teleop"), ["entry 1: topic: 'input teleop'"]),
    (with_teleop(priority=-1), ["entry 1: priority: -1", "whole number"]),
    ({"subscribers": [TELEOP], "publisher": ""}, ["~publisher: ''", "name of a topic"]),
    (with_teleop(topic="output"), ["~publisher: 'output'", "topic of an input"]),
    (with_teleop(timeout=0.01), ["entry 1: timeout: 0.01", "from 0.02 to 60 s"]),
])  # fmt: skip
def test_a_mistake_is_named_with_its_value_and_what_is_allowed(given, parts):
    with pytest.raises(ValueError) as caught:
        parse_mux_parameters(given)
    assert str(caught.value).startswith("~") and "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)
