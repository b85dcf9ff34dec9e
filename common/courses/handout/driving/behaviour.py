"""Checks of a Joy-to-Twist program: joy2twist.py in section 4.3, the class in 6.2."""

from __future__ import annotations

import re

from tutorial_check import Note, Submission, Wrong, must_pass

from . import answer_diagnoses as answers
from . import connection_diagnoses as connections
from .joy2twist_node import Joy2TwistNode
from .joys import COUNT
from .main_script import main_script
from .record import drive


def _node(submission: Submission, script: str = "") -> Joy2TwistNode:
    """Return the run of the program of section 4.3, or of another script."""
    run = submission.recording(drive, script or main_script(submission))
    return Joy2TwistNode(submission, run)


def _connected(submission: Submission, script: str) -> Joy2TwistNode:
    """Return the run of a program that subscribes to Joys. Raises Wrong."""
    node = _node(submission, script)
    expected = f"it subscribes to {node.names.joy}, sensor_msgs/Joy"
    must_pass(connections.CONNECTED, node, expected)
    has_worked = node.run.numbered.samples or node.run.numbered.displayed
    if not node.graph.connected or (node.run.ending.early and not has_worked):
        must_pass(connections.NOT_CONNECTED, node, expected)
    return node


def displays(submission: Submission, script: str = "", few_are_enough: bool = False) -> Note | None:
    node = _connected(submission, script)
    numbered = node.run.numbered
    if numbered.all_displayed or (numbered.displayed and few_are_enough):
        return None
    expected = "every Joy displayed with its six axes, two decimals, in one line"
    note = must_pass(answers.DISPLAYED, node, expected)
    if note or few_are_enough:
        return note or _few_displayed(node)
    return must_pass(answers.NOT_DISPLAYED, node, expected)


def _few_displayed(node: Joy2TwistNode) -> Note:
    count = node.values_displayed()
    seen = f"a line has {count} of the six values of a message" if count else "it displays nothing"
    return Note(f"{seen}; the handout's {'has all' if count else 'does'}")


def topics(submission: Submission, script: str = "") -> Note | str:
    """Check that it publishes Twists on the robot's topic."""
    node = _connected(submission, script)
    joy, cmd_vel = node.answers.joy, node.answers.cmd_vel
    expected = f"it publishes on {node.names.cmd_vel}, geometry_msgs/Twist"
    note = must_pass(connections.TOPICS, node, expected)
    if cmd_vel not in node.graph.publishers:
        must_pass(connections.NO_TOPIC, node, expected)
    wanted, name = submission.task.values.get("node"), node.graph.subscribers.get(joy, ("",))[0]
    if wanted and not script and not re.fullmatch(rf"/{wanted}(_\d+_\d+)?", name):
        expected, hint = (
            "the name of the node that the task asks for",
            node.source.idioms.named(wanted),
        )
        raise Wrong(expected, f"it is called {name}", node.at_call("init_node"), hint)
    return note or f"{node.names.joy} -> {node.names.cmd_vel}"


def mapping(submission: Submission, script: str = "") -> Note | None:
    """Check that linear.x follows axis 1, and angular.z axis 0; a Wrong names the actual rule."""
    node = _node(submission, script)
    rules = node.names.rules
    expected = f"for each Joy one Twist: linear.x = {rules[1]}, angular.z = {rules[0]}, all else 0"
    if not node.run.has_traceback:
        must_pass([answers.callback_sleeps], node, expected)
    if len(node.run.numbered.samples) < COUNT * 0.9:
        must_pass(answers.ANSWERED, node, expected)
    must_pass(answers.ONCE, node, expected)
    return must_pass(answers.RIGHT_RULE, node, expected)


def rate(submission: Submission, script: str = "") -> Note | str | None:
    expected = "at 50 Joys a second as many Twists, each within 50 ms"
    node = _node(submission, script)
    must_pass([answers.spins_in_callback], node, expected)
    return answers.rate_of(node) if node.run.is_prompt else must_pass(answers.RATE, node, expected)
