"""C23, C24 and C26: the launch files of section 5 at work."""

from __future__ import annotations

import os
import re
from pathlib import Path

from tutorial_check.course import check
from tutorial_check.handout.s4_3.record import CMD_VEL, JOY
from tutorial_check.handout.s5 import launch_nodes
from tutorial_check.handout.s5.launch_facts import Node
from tutorial_check.handout.s5.launch_files import BAG, STICK, LaunchFile
from tutorial_check.handout.s5.record import BAG_S, Plan, Run, bag_run, stick_run
from tutorial_check.handout.task import PACKAGE
from tutorial_check.judge.scripts import cause_of
from tutorial_check.model import Wrong
from tutorial_check.record.session import Session
from tutorial_check.record.simulated_robot import ODOM
from tutorial_check.source.tracebacks import first_traceback

ONCE_S = 60.0  # a recording that is not repeated lasts until the others have started
LOOP = re.compile(r"--l(oop|oo|o)?|-[a-z]*l[a-z]*")  # rosbag play's option, as it may be written
ERRORS = re.compile(r"^(?!.*(?:rviz|INFO)).*(?:ERROR|died|Invalid|cannot|Unable)", re.MULTILINE)
COLOUR = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07")


def plan_of(file: LaunchFile, twists: str = CMD_VEL) -> Plan:
    """Return how a launch file is run. twists: the topic on which the velocities should come."""
    kinds = (launch_nodes.is_joystick, launch_nodes.is_player)
    senders = [node for node in file.nodes if any(is_one(node) for is_one in kinds)]
    sticks = list(filter(launch_nodes.is_joystick, file.nodes))
    devices = [node["device"] for node in sticks if node["device"].startswith("/dev/input/")]
    return Plan(
        os.path.relpath(file.path, file.session.source),
        launch_nodes.topic_of(senders[0], JOY) if senders else JOY,
        twists,
        tuple(_whole(node) for node in file.nodes if not launch_nodes.is_viewer(node)),
        tuple(map(_whole, sticks)),
        next(iter(devices), ""),
    )


def _whole(node: Node) -> str:
    return f"{node['namespace']}{node['name']}"


def traced(session: Session, run: Run, expected: str) -> Wrong | None:
    """Return the Wrong for the first traceback that was printed, or None."""
    output = COLOUR.sub("", run.program.output)
    trace = first_traceback(output, str(session.package(PACKAGE).folder))
    if not trace:
        return None
    where, hint = cause_of(session, PACKAGE, Path(trace.where.rpartition(":")[0]).name, trace)
    return Wrong(expected, trace.error, where, hint)


def fault_of(file: LaunchFile, plan: Plan, run: Run, expected: str) -> Wrong:
    """Return the Wrong for a launch that does not do what it should, with the first cause there is."""
    found = traced(file.session, run, expected)
    if found:
        return found
    hints = {
        plan.joys: "does the recording, or joy_node, run? rostopic hz /joy",
        plan.twists: f"does joy2twist run, and publish on {plan.twists}? rosnode list",
        ODOM: f"does the simulated robot run? {launch_nodes.ROBOT_HINT}",
    }
    silent = [topic for topic in hints if not run.counts[topic]]
    seen, hint = f"the robot moved {run.moved_m:.2f} m", "rostopic echo /cmd_vel"
    if silent:
        seen, hint = f"nothing on {', '.join(silent)}", hints[silent[0]]
    for error in (ERRORS.findall(run.program.output) or run.last_words)[:1]:
        seen += f"; {error.strip()[:200]}"
    return Wrong(expected, seen, f"launch/{file.name}", hint)


def _bag_run(session: Session) -> tuple[LaunchFile, Plan, Run]:
    """Return launch_bag and what came of it, with a recording of the checker's own."""
    bag, _ = launch_nodes.bag_of(session)
    file = LaunchFile(session, BAG)
    plan = plan_of(file)
    inside = os.path.relpath(bag, session.source) if bag.startswith(str(session.source)) else ""
    player = next(filter(launch_nodes.is_player, file.nodes))
    is_looped = any(LOOP.fullmatch(word) for word in file.words_of(player))
    length_s = BAG_S if is_looped or player["respawn"] else ONCE_S
    return file, plan, session.recording(bag_run, plan, inside, length_s, is_looped)


@check("C23", "launch_bag drives the robot", "5.1", "C22 C16",
       look="roslaunch {n.package} launch_bag.launch")  # fmt: skip
def bag_drives(session: Session) -> None:
    file, plan, run = _bag_run(session)
    if not run.drives or not run.counts[plan.joys]:
        expected = "/joy, /cmd_vel and /odom flow, and the robot drives more than 0.3 m"
        raise fault_of(file, plan, run, expected)


@check("C24", "the recording begins again at its end", "5.1", "C23", look="rostopic hz /joy")
def bag_loops(session: Session) -> None:
    file, _, run = _bag_run(session)
    player = next(filter(launch_nodes.is_player, file.nodes))
    if not run.loops and not player["respawn"]:
        expected = "/joy flows on after the end of the recording"
        hint = "rosbag play --loop: in args= of that node"
        raise Wrong(expected, "it falls silent", launch_nodes.bag_of(session)[1], hint)


@check("C26", "launch_joy_node drives the robot", "5.1", "C25 C16",
       look="roslaunch {n.package} launch_joy_node.launch")  # fmt: skip
def stick_drives(session: Session) -> None:
    file = LaunchFile(session, STICK)
    plan = plan_of(file)
    run = session.recording(stick_run, plan)
    if not run.drives:
        raise fault_of(file, plan, run, "the robot moves with the stick")
    if not run.rests:
        raise Wrong("released, the robot stands", "it drives on", f"launch/{STICK}")
