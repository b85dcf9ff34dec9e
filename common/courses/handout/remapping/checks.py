"""C27 and C28: remapping, and the launch file for the real TurtleBot."""

from __future__ import annotations

import re
from dataclasses import replace

from tutorial_check import Submission, Wrong, check, last_lines

from ..launching.files import JOY_HINT, REAL, TURTLEBOT, HandoutLaunch, check_launch
from ..launching.record import Plan
from ..launching.runs import OWN_HINT, fault_of, plan_of, topic_of, traced
from ..task import CMD_VEL, JOY
from .record import TELEOP, Remap, real_run, remap_run

EXPECTED = f"Twists on {TELEOP}, none on any other topic"


def remap_of(submission: Submission) -> str:
    return f'<remap from="{submission.task.topic(CMD_VEL)}" to="{TELEOP}"/>'


@check("C27", "joy2twist_turtlebot sends to the multiplexer", "6.1", needs="C16",
       look="rostopic echo /cmd_vel_mux/input/teleop")  # fmt: skip
def remapped(submission: Submission) -> None:
    file, own = check_launch(submission, TURTLEBOT), submission.task.topic(CMD_VEL)
    file.must_start("joy2twist", file.own, OWN_HINT.format(file.student_package))
    joys = topic_of(file.own[0], submission.task.topic(JOY))
    plan = replace(plan_of(file, TELEOP), joys=joys)
    seen = submission.recording(remap_run, plan, own)
    if not seen.good or seen.bad or own in seen.publishers:
        raise _not_remapped(file, plan, seen)
    is_named = any(node["remaps"] or ":=" in node["args"] for node in file.own)
    if not is_named and not re.search(r"<(ros)?param\b", file.text):
        program = file.own[0]["type"]
        expected = "the program as it was, whose topic the launch file renames"
        hint = f'type="joy2twist.py", and in it {remap_of(submission)}'
        raise Wrong(expected, f"{program} publishes on {TELEOP} by itself", file.at(program), hint)


def _not_remapped(file: HandoutLaunch, plan: Plan, seen: Remap) -> Wrong:
    """Return the Wrong for velocities that do not flow where they should, or elsewhere, too."""
    own, hint = file.submission.task.topic(CMD_VEL), remap_of(file.submission)
    remaps = [remap for node in file.own for remap in node["remaps"]]
    where, others = file.at("<remap", "joy2twist.py"), seen.others
    if "Traceback" in seen.run.program.output or seen.run.has_died:
        said = last_lines(seen.run.program.output)
        return traced(file.submission, seen.run, EXPECTED) or Wrong(EXPECTED, said, file.where)
    if seen.bad and not remaps and re.search(r"<param\s+(from|name)=", file.text):
        words, where = "a <param> renames nothing", file.at("<param")
    elif seen.bad and not remaps and "<remap" in file.text:
        words = "the <remap> stands outside of the node, and not before it"
        hint = "a <remap> holds for the node around it, and for those below it: put it between"
        hint += " <node ...> and </node>"
    elif seen.bad and any(f"/{to.strip('/')}" == own for _, to in remaps):
        words, hint = "from and to are swapped", f"from is the name in the program: {hint}"
    elif others:
        sure = seen.bad or others[0] in [to for _, to in remaps]
        return Wrong(EXPECTED, f"it publishes on {others[0]}", where, hint, sure)
    elif not seen.bad and plan.joys not in seen.subscribers:
        hint = "does the node start, and is /joy left as it is?"
        return Wrong(EXPECTED, f"no node listens to {plan.joys}", file.where, hint)
    elif not seen.bad:
        return Wrong(EXPECTED, "no Twist at all", file.where, hint)
    else:
        words = "nothing is remapped"
        words = f"the remap from {remaps[0][0]} fits no topic of the program" if remaps else words
    return Wrong(EXPECTED, f"Twists on {own}: {words}", where, hint, sure=True)


@check("C28", "launch_joy_node_realTurtlebot drives the TurtleBot", "6.1", needs=remapped,
       look="rostopic echo /cmd_vel_mux/active")  # fmt: skip
def real_robot(submission: Submission) -> None:
    file = check_launch(submission, REAL)
    # Its node, with the remap, may stand here once more.
    topics = [f"/{to.strip('/')}" for node in file.own for _, to in node["remaps"]]
    is_included = any(each.endswith(f"/{TURTLEBOT}") for each in file.facts["files"])
    if TELEOP not in topics and not is_included:
        hint = f'<include file="$(find {file.student_package})/launch/{TURTLEBOT}"/>'
        raise Wrong(f"it includes {TURTLEBOT}", "it does not", file.where, hint)
    launcher = '<include file="$(find turtlebot_rviz_launchers)/launch/view_robot.launch"/>'
    file.must_start("RViz", file.of("viewer"), launcher)
    file.must_start("joy_node", file.of("joystick"), JOY_HINT)
    if len(file.own) > 1:
        seen, hint = f"{len(file.own)}: both would drive", f"{TURTLEBOT} starts it already"
        raise Wrong("one joy2twist", seen, file.at("joy2twist.py"), hint)
    has_base = any(node["type"] == "cmd_vel_mux.py" for node in file.nodes)
    plan = plan_of(file, TELEOP)
    run = submission.recording(real_run, plan, has_base)
    if not run.drives:
        expected = "cmd_vel_mux lets teleop through, and the robot moves with the stick"
        raise fault_of(file, plan, run, expected)
    if not any("teleop" in each for each in run.active):
        seen = ", ".join(run.active) or "nothing"
        raise Wrong("cmd_vel_mux/active says teleop", seen, file.where, remap_of(submission))
