"""C27 and C28: remapping, and the launch file for the real TurtleBot."""

from __future__ import annotations

import re
from dataclasses import replace

from tutorial_check.course import check
from tutorial_check.handout.s4_3.record import CMD_VEL, JOY
from tutorial_check.handout.s5 import launch_nodes
from tutorial_check.handout.s5.launch_files import JOY_HINT, REAL, TURTLEBOT, LaunchFile, check_file
from tutorial_check.handout.s5.launch_runs import fault_of, plan_of, traced
from tutorial_check.handout.s6_1.record import TELEOP, real_run, remap_run
from tutorial_check.judge.rows import Row, demand
from tutorial_check.model import Wrong
from tutorial_check.record.session import Session
from tutorial_check.source.tracebacks import last_lines

EXPECTED = f"Twists on {TELEOP}, none on any other topic"
REMAP = "{f.remap}"  # in hints


def remap_of(session: Session) -> str:
    return f'<remap from="{session.task.topic(CMD_VEL)}" to="{TELEOP}"/>'


class Remapped:
    """What joy2twist_turtlebot did, beside its text: the facts of the rows below."""

    def __init__(self, file: LaunchFile) -> None:
        self.file, task = file, file.session.task
        self.twists = task.topic(CMD_VEL)  # as the program has it
        self.remap = remap_of(file.session)
        plan = plan_of(file, TELEOP)
        self.joys = launch_nodes.topic_of(file.own[0], task.topic(JOY))
        plan = replace(plan, joys=self.joys)
        self.seen = seen = file.session.recording(remap_run, plan, self.twists)
        self.has_failed = "Traceback" in seen.run.program.output or seen.run.has_died
        self.remaps = [remap for node in file.own for remap in node["remaps"]]
        self.topics_meant = [to for _, to in self.remaps]
        self.where, self.at_remap = file.where, file.at("<remap", "joy2twist.py")
        self.at_param, self.at_type = file.at("<param"), file.at(file.own[0]["type"])

    @property
    def is_right(self) -> bool:
        """Return whether the velocities flow where they should, and there alone."""
        return self.seen.good and not self.seen.bad and self.twists not in self.seen.publishers

    @property
    def by_itself(self) -> str:
        """The program that knows the other topic by itself; empty if the launch file names it."""
        is_named = bool(self.remaps or re.search(r"<(ros)?param\b", self.file.text))
        is_named = is_named or any(":=" in node["args"] for node in self.file.own)
        return "" if is_named else self.file.own[0]["type"]

    def failed(self) -> Wrong:
        run = self.seen.run
        said = last_lines(run.program.output)
        return traced(self.file.session, run, EXPECTED) or Wrong(EXPECTED, said, self.where)


NOT_REMAPPED = (
    Row(lambda r: r.has_failed, lambda r: r.failed()),
    Row(lambda r: r.seen.bad and not r.remaps and re.search(r"<param\s+(from|name)=", r.file.text),
        "Twists on {f.twists}: a <param> renames nothing", REMAP, "{f.at_param}", sure=True),
    Row(lambda r: r.seen.bad and not r.remaps and "<remap" in r.file.text,
        "Twists on {f.twists}: the <remap> stands outside of the node, and not before it",
        "a <remap> holds for the node around it, and for those below it: put it between <node ...>"
        " and </node>", "{f.at_remap}", sure=True),
    Row(lambda r: r.seen.bad and any(f"/{to.strip('/')}" == r.twists for to in r.topics_meant),
        "Twists on {f.twists}: from and to are swapped",
        "from is the name in the program: " + REMAP, "{f.at_remap}", sure=True),
    Row(lambda r: (r.seen.bad or set(r.seen.others[:1]) & set(r.topics_meant)) and r.seen.others,
        "it publishes on {found[0]}", REMAP, "{f.at_remap}", sure=True),
    Row(lambda r: r.seen.others, "it publishes on {found[0]}", REMAP, "{f.at_remap}"),
    Row(lambda r: r.seen.bad and r.remaps,
        "Twists on {f.twists}: the remap from {found[0][0]} fits no topic of the program", REMAP,
        "{f.at_remap}", sure=True),
    Row(lambda r: r.seen.bad, "Twists on {f.twists}: nothing is remapped", REMAP, "{f.at_remap}",
        sure=True),
    Row(lambda r: r.joys not in r.seen.subscribers, "no node listens to {f.joys}",
        "does the node start, and is /joy left as it is?", "{f.where}"),
    Row(lambda r: True, "no Twist at all", REMAP, "{f.where}"),
)  # fmt: skip
BY_ITSELF = (
    Row(lambda r: r.by_itself, f"{{found}} publishes on {TELEOP} by itself",
        'type="joy2twist.py", and in it ' + REMAP, "{f.at_type}"),
)  # fmt: skip


@check("C27", "joy2twist_turtlebot sends to the multiplexer", "6.1", "C16",
       look="rostopic echo /cmd_vel_mux/input/teleop")  # fmt: skip
def remapped(session: Session) -> None:
    file = check_file(session, TURTLEBOT)
    start = launch_nodes.OWN_HINT.format(file.package)
    file.demand("joy2twist", file.own.__contains__, start)
    found = Remapped(file)
    if found.is_right:
        demand(BY_ITSELF, found, "the program as it was, whose topic the launch file renames")
    else:
        demand(NOT_REMAPPED, found, EXPECTED)


@check("C28", "launch_joy_node_realTurtlebot drives the TurtleBot", "6.1", "C27",
       look="rostopic echo /cmd_vel_mux/active")  # fmt: skip
def real_robot(session: Session) -> None:
    file = check_file(session, REAL)
    _check_items(file)
    has_base = any(node["type"] == "cmd_vel_mux.py" for node in file.nodes)
    plan = plan_of(file, TELEOP)
    run = session.recording(real_run, plan, has_base)
    if not run.drives:
        expected = "cmd_vel_mux lets teleop through, and the robot moves with the stick"
        raise fault_of(file, plan, run, expected)
    if not any("teleop" in each for each in run.active):
        seen = ", ".join(run.active) or "nothing"
        raise Wrong("cmd_vel_mux/active says teleop", seen, file.where, remap_of(session))


def _check_items(file: LaunchFile) -> None:
    # Its node, with the remap, may stand here once more.
    topics = [f"/{to.strip('/')}" for node in file.own for _, to in node["remaps"]]
    is_included = any(each.endswith(f"/{TURTLEBOT}") for each in file.facts["files"])
    if TELEOP not in topics and not is_included:
        hint = f'<include file="$(find {file.package})/launch/{TURTLEBOT}"/>'
        raise Wrong(f"it includes {TURTLEBOT}", "it does not", file.where, hint)
    launcher = '<include file="$(find turtlebot_rviz_launchers)/launch/view_robot.launch"/>'
    file.demand("RViz", launch_nodes.is_viewer, launcher)
    file.demand("joy_node", launch_nodes.is_joystick, JOY_HINT)
    if len(file.own) > 1:
        seen, hint = f"{len(file.own)}: both would drive", f"{TURTLEBOT} starts it already"
        raise Wrong("one joy2twist", seen, file.at("joy2twist.py"), hint)
