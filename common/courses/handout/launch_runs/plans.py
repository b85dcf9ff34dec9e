"""Plans for running launch files, and why a run fails."""

from __future__ import annotations

import re

from tutorial_check import ODOM, LaunchNode, Submission, Wrong, cause_of, traceback_of

from ..task import CMD_VEL, JOY, PACKAGE
from .handout_launch import HandoutLaunch
from .record import LaunchRun, Plan

ROBOT_HINT = '<include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>'
ERRORS = re.compile(r"^(?!.*(?:rviz|INFO)).*(?:ERROR|died|Invalid|cannot|Unable)", re.MULTILINE)
COLOUR = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07")


def topic_of(node: LaunchNode, topic: str) -> str:
    """Return the name of a node's topic after the launch file's remaps."""
    renamed = (*node["remaps"], *re.findall(r"(\S+):=(\S+)", node["args"]))
    names = {source.strip("/"): to for source, to in renamed}
    return f"/{names.get(topic.strip('/'), topic).strip('/')}"


def plan_of(file: HandoutLaunch, twists: str = CMD_VEL) -> Plan:
    """Return the Plan of a launch file. twists: the topic for the velocities."""
    senders, sticks = file.of("joystick", "player"), file.of("joystick")
    viewers = file.of("viewer")
    devices = [node["device"] for node in sticks if node["device"].startswith("/dev/input/")]
    return Plan(
        file.path,
        topic_of(senders[0], JOY) if senders else JOY,
        twists,
        tuple(node["namespace"] + node["name"] for node in file.nodes if node not in viewers),
        tuple(node["namespace"] + node["name"] for node in sticks),
        next(iter(devices), ""),
    )


def traced(submission: Submission, run: LaunchRun, expected: str) -> Wrong | None:
    """Return the Wrong for the first traceback in the output, or None."""
    trace = traceback_of(submission, PACKAGE, COLOUR.sub("", run.program.output))
    if not trace:
        return None
    return Wrong(expected, trace.error, *cause_of(submission, PACKAGE, trace))


def fault_of(file: HandoutLaunch, plan: Plan, run: LaunchRun, expected: str) -> Wrong:
    """Return the Wrong for a failed run, with its first cause."""
    hints = {
        plan.joys: "does the recording, or joy_node, run? rostopic hz /joy",
        plan.twists: f"does joy2twist run, and publish on {plan.twists}? rosnode list",
        ODOM: f"does the simulated robot run? {ROBOT_HINT}",
    }
    silent = [topic for topic in hints if not run.counts[topic]]
    seen, hint = f"the robot moved {run.moved_m:.2f} m", "rostopic echo /cmd_vel"
    if silent:
        seen, hint = f"nothing on {', '.join(silent)}", hints[silent[0]]
    for error in (ERRORS.findall(run.program.output) or run.last_words)[:1]:
        seen += f"; {error.strip()[:200]}"
    where = f"launch/{file.name}"
    return traced(file.submission, run, expected) or Wrong(expected, seen, where, hint)
