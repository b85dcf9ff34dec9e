"""C27 and C28: remapping, and the launch file for the real TurtleBot."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Sequence

from tutorial_check import Submission, Wrong, check, last_lines, must_pass

from ..launch_runs.handout_launch import (
    JOY_HINT,
    REAL,
    TURTLEBOT,
    HandoutLaunch,
    check_launch,
    program_name,
)
from ..launch_runs.plans import fault_of, plan_of, topic_of, traced
from ..launch_runs.record import Plan
from ..task import CMD_VEL, JOY
from .record import TELEOP, Remap, real_run, remap_run

EXPECTED = f"Twists on {TELEOP}, none on any other topic"


@dataclass(frozen=True)
class Remapping:
    """joy2twist_turtlebot, and a run of it in which velocities do not arrive as they should."""

    file: HandoutLaunch
    plan: Plan
    seen: Remap

    @property
    def own(self) -> str:
        """The program's own topic for velocities."""
        return str(self.file.submission.task.topic(CMD_VEL))

    @property
    def remap(self) -> str:
        return f'<remap from="{self.own}" to="{TELEOP}"/>'

    @property
    def remaps(self) -> list[Sequence[str]]:
        return [remap for node in self.file.own for remap in node["remaps"]]

    def wrong(self, why: str, words: str = "<remap", hint: str = "") -> Wrong:
        """Return the Wrong for velocities on the program's own topic. words: in its line."""
        where = self.file.at(words, self.file.own[0]["type"])
        return Wrong(EXPECTED, f"Twists on {self.own}: {why}", where, hint or self.remap, sure=True)


def program_failed(case: Remapping) -> Wrong | None:
    run = case.seen.run
    if "Traceback" not in run.program.output and not run.has_died:
        return None
    wrong = Wrong(EXPECTED, last_lines(run.program.output), case.file.where)
    return traced(case.file.submission, run, EXPECTED) or wrong


def param_in_place_of_remap(case: Remapping) -> Wrong | None:
    is_param = re.search(r"<param\s+(from|name)=", case.file.text)
    if not case.seen.bad or case.remaps or not is_param:
        return None
    return case.wrong("a <param> renames nothing", "<param")


def remap_outside(case: Remapping) -> Wrong | None:
    if not case.seen.bad or case.remaps or "<remap" not in case.file.text:
        return None
    hint = "a <remap> applies to the node around it, and to those below it: put it between"
    why = "the <remap> is outside of the node, and not before it"
    return case.wrong(why, hint=f"{hint} <node ...> and </node>")


def swapped(case: Remapping) -> Wrong | None:
    if not case.seen.bad or not any(f"/{to.strip('/')}" == case.own for _, to in case.remaps):
        return None
    hint = f"from is the name in the program: {case.remap}"
    return case.wrong("from and to are swapped", hint=hint)


def published_elsewhere(case: Remapping) -> Wrong | None:
    for topic in case.seen.others:
        where = case.file.at("<remap", case.file.own[0]["type"])
        sure = case.seen.bad or topic in [to for _, to in case.remaps]
        return Wrong(EXPECTED, f"it publishes on {topic}", where, case.remap, sure)
    return None


def no_velocity(case: Remapping) -> Wrong | None:
    if case.seen.bad:
        return None
    if case.plan.joys not in case.seen.subscribers:
        hint = "does the node start, and is /joy left as it is?"
        return Wrong(EXPECTED, f"no node listens to {case.plan.joys}", case.file.where, hint)
    return Wrong(EXPECTED, "no Twist at all", case.file.where, case.remap)


def not_remapped(case: Remapping) -> Wrong:
    if not case.remaps:
        return case.wrong("nothing is remapped")
    return case.wrong(f"the remap from {case.remaps[0][0]} matches no topic of the program")


def remapped_by_itself(case: Remapping) -> Wrong | None:
    is_named = any(node["remaps"] or ":=" in node["args"] for node in case.file.own)
    if is_named or re.search(r"<(ros)?param\b", case.file.text):
        return None
    program, hint = (
        case.file.own[0]["type"],
        f'type="{program_name(case.file.submission)}", and in it {case.remap}',
    )
    expected = "the unchanged program, whose topic the launch file remaps"
    seen, where = f"{program} publishes on {TELEOP} by itself", case.file.at(program)
    return Wrong(expected, seen, where, hint)


NOT_REMAPPED = (
    program_failed, param_in_place_of_remap, remap_outside, swapped, published_elsewhere,
    no_velocity, not_remapped,
)  # fmt: skip


@check("C27", "joy2twist_turtlebot sends to the multiplexer", "6.1", needs="C16",
       look="rostopic echo /cmd_vel_mux/input/teleop")  # fmt: skip
def remapped(submission: Submission) -> None:
    file, own = check_launch(submission, TURTLEBOT), submission.task.topic(CMD_VEL)
    file.must_start("joy2twist", file.own, file.own_node)
    joys = topic_of(file.own[0], submission.task.topic(JOY))
    plan = replace(plan_of(file, TELEOP), joys=joys)
    seen = submission.recording(remap_run, plan, own)
    is_wrong = not seen.good or seen.bad or own in seen.publishers
    must_pass(NOT_REMAPPED if is_wrong else (remapped_by_itself,), Remapping(file, plan, seen))


@check("C28", "launch_joy_node_realTurtlebot drives the TurtleBot", "6.1", needs=remapped,
       look="rostopic echo /cmd_vel_mux/active")  # fmt: skip
def real_robot(submission: Submission) -> None:
    file = check_launch(submission, REAL)
    # The node may be here instead of in the included file.
    topics = [f"/{to.strip('/')}" for node in file.own for _, to in node["remaps"]]
    is_included = any(path.endswith(f"/{TURTLEBOT}") for path in file.facts["files"])
    if TELEOP not in topics and not is_included:
        hint = f'<include file="$(find {file.student_package})/launch/{TURTLEBOT}"/>'
        raise Wrong(f"it includes {TURTLEBOT}", "it does not", file.where, hint)
    launcher = '<include file="$(find turtlebot_rviz_launchers)/launch/view_robot.launch"/>'
    file.must_start("RViz", file.of("viewer"), launcher)
    file.must_start("joy_node", file.of("joystick"), JOY_HINT)
    if len(file.own) > 1:
        seen, hint = f"{len(file.own)}: both would drive", f"{TURTLEBOT} starts it already"
        raise Wrong("one joy2twist", seen, file.at(file.own[0]["type"]), hint)
    has_base = any(node["type"] == "cmd_vel_mux.py" for node in file.nodes)
    plan = plan_of(file, TELEOP)
    run = submission.recording(real_run, plan, has_base)
    if not run.drives:
        expected = "cmd_vel_mux lets teleop through, and the robot moves with the stick"
        raise fault_of(file, plan, run, expected)
    if not any("teleop" in name for name in run.active):
        seen = ", ".join(run.active) or "nothing"
        hint = f'<remap from="{submission.task.topic(CMD_VEL)}" to="{TELEOP}"/>'
        raise Wrong("cmd_vel_mux/active shows teleop", seen, file.where, hint)
