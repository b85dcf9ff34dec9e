"""C27 and C28: remapping, and the launch file for the real TurtleBot."""

from __future__ import annotations

import re
from typing import Any

from tutorial_check.course import check
from tutorial_check.exercises import launch_nodes, launch_runs
from tutorial_check.exercises.driving import CMD_VEL, JOY
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.exercises.launch_files import JOY_HINT, REAL, TURTLEBOT, LaunchFile, check_file
from tutorial_check.exercises.robot import held, rest
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.rows import Row, demand
from tutorial_check.session import Session
from tutorial_check.stage import Stage
from tutorial_check.tracebacks import last_lines

TELEOP, ACTIVE = "/cmd_vel_mux/input/teleop", "/cmd_vel_mux/active"
EXPECTED = f"Twists on {TELEOP}, none on any other topic"
REMAP = "{f.remap}"  # in hints


def remap_of(session: Session) -> str:
    return f'<remap from="{session.task.topic(CMD_VEL)}" to="{TELEOP}"/>'


class Remapped:
    """What joy2twist_turtlebot did, beside its text: the facts of the rows below."""

    def __init__(self, file: LaunchFile) -> None:
        self.file = file
        self.twists = twists = file.session.task.topic(CMD_VEL)  # as the program has it
        self.remap = remap_of(file.session)
        with file.session.stage(renamed=False) as stage:
            stage.call("listen", twists, "Twist")
            self.joys = joys = launch_nodes.topic_of(file.own[0], file.session.task.topic(JOY))
            stage.call("advertise", joys, "Joy")
            self.launch = launch = launch_runs.Launch(file, stage, TELEOP)
            topics = (TELEOP, twists)

            def is_up() -> bool:
                speak = any(stage.call("speakers", each) for each in topics)
                # One of the listeners is ours.
                return stage.call("listeners", joys) > 1 and bool(speak or self._others(stage))

            launch.wait(is_up)
            rest(stage, *topics, joys=joys)
            stage.call("stream", joys, [held(file.session, 0.2, 0.3)], 20.0, True)

            def moving(topic: str) -> bool:
                return any(abs(value[0]) > 0.01 for _, _, value in stage.call("heard", topic))

            stage.wait(lambda: any(map(moving, topics)) or launch.is_over(), 3.0)
            self.good, self.bad = map(moving, topics)
            self.publishers, self.subscribers = stage.call("state")
            self.others = self._others(stage)
            self.has_failed = "Traceback" in launch.program.output or launch.has_died
        self.remaps = [remap for node in file.own for remap in node["remaps"]]
        self.topics_meant = [to for _, to in self.remaps]
        self.where, self.at_remap = file.where, file.at("<remap", "joy2twist.py")
        self.at_param, self.at_type = file.at("<param"), file.at(file.own[0]["type"])

    def _others(self, stage: Stage) -> Any:
        topics = (each for each in stage.call("state")[0] if each not in (TELEOP, self.twists))
        return sorted(topic for topic in topics if re.search("vel|teleop|mux", topic))

    @property
    def is_right(self) -> Any:
        """Return whether the velocities flow where they should, and there alone."""
        return self.good and not self.bad and self.twists not in self.publishers

    @property
    def by_itself(self) -> Any:
        """The program that knows the other topic by itself; empty if the launch file names it."""
        is_named = bool(self.remaps or re.search(r"<(ros)?param\b", self.file.text))
        is_named = is_named or any(":=" in node["args"] for node in self.file.own)
        return "" if is_named else self.file.own[0]["type"]

    def failed(self) -> Any:
        said = last_lines(self.launch.program.output)
        return self.launch.traced(EXPECTED) or Wrong(EXPECTED, said, self.where)


NOT_REMAPPED = (
    Row(lambda r: r.has_failed, lambda r: r.failed()),
    Row(lambda r: r.bad and not r.remaps and re.search(r"<param\s+(from|name)=", r.file.text),
        "Twists on {f.twists}: a <param> renames nothing", REMAP, "{f.at_param}", sure=True),
    Row(lambda r: r.bad and not r.remaps and "<remap" in r.file.text,
        "Twists on {f.twists}: the <remap> stands outside of the node, and not before it",
        "a <remap> holds for the node around it, and for those below it: put it between <node ...>"
        " and </node>", "{f.at_remap}", sure=True),
    Row(lambda r: r.bad and any(f"/{to.strip('/')}" == r.twists for to in r.topics_meant),
        "Twists on {f.twists}: from and to are swapped",
        "from is the name in the program: " + REMAP, "{f.at_remap}", sure=True),
    Row(lambda r: (r.bad or set(r.others[:1]) & set(r.topics_meant)) and r.others,
        "it publishes on {found[0]}", REMAP, "{f.at_remap}", sure=True),
    Row(lambda r: r.others, "it publishes on {found[0]}", REMAP, "{f.at_remap}"),
    Row(lambda r: r.bad and r.remaps,
        "Twists on {f.twists}: the remap from {found[0][0]} fits no topic of the program", REMAP,
        "{f.at_remap}", sure=True),
    Row(lambda r: r.bad, "Twists on {f.twists}: nothing is remapped", REMAP, "{f.at_remap}",
        sure=True),
    Row(lambda r: r.joys not in r.subscribers, "no node listens to {f.joys}",
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
    """Start joy2twist_turtlebot and look at both topics."""
    file = check_file(session, TURTLEBOT)
    file.demand("joy2twist", file.own.__contains__, launch_nodes.OWN_HINT)
    found = Remapped(file)
    if found.is_right:
        demand(BY_ITSELF, found, "the program as it was, whose topic the launch file renames")
    else:
        demand(NOT_REMAPPED, found, EXPECTED)


@check("C28", "launch_joy_node_realTurtlebot drives the TurtleBot", "6.1", "C27",
       look="rostopic echo /cmd_vel_mux/active")  # fmt: skip
def real_robot(session: Session) -> None:
    """Start it beside a simulated TurtleBot, and push the stick."""
    file = check_file(session, REAL)
    _check_items(file)
    has_base = any(node["type"] == "cmd_vel_mux.py" for node in file.nodes)
    with session.stage(renamed=False) as stage:
        stage.call("listen", ACTIVE, "String")
        pad, base = launch_runs.plug_in_for(file, stage), None
        if not has_base:
            command = ["roslaunch", "fake_turtlebot_sim", "minimal.launch", "model:=false"]
            base = stage.launch(command, trusted=True)
        launch = launch_runs.Launch(file, stage, TELEOP)
        drives = launch_runs.drives_forwards(stage, pad, launch, ACTIVE)
        if base and base.ended:
            raise CannotCheck(f"the simulated TurtleBot does not start: {base.output[-200:]}")
        if not drives:
            expected = "cmd_vel_mux lets teleop through, and the robot moves with the stick"
            raise launch.wrong(expected)
        active = {value for _, _, value in stage.call("heard", ACTIVE)}
    if not any("teleop" in each for each in active):
        seen = ", ".join(sorted(active)) or "nothing"
        raise Wrong("cmd_vel_mux/active says teleop", seen, file.where, remap_of(session))


def _check_items(file: LaunchFile) -> None:
    """Raise Wrong unless it starts and includes what it should."""
    # Its node, with the remap, may stand here once more.
    topics = [f"/{to.strip('/')}" for node in file.own for _, to in node["remaps"]]
    is_included = any(each.endswith(f"/{TURTLEBOT}") for each in file.facts["files"])
    if TELEOP not in topics and not is_included:
        hint = f'<include file="$(find {PACKAGE})/launch/{TURTLEBOT}"/>'
        raise Wrong(f"it includes {TURTLEBOT}", "it does not", file.where, hint)
    launcher = '<include file="$(find turtlebot_rviz_launchers)/launch/view_robot.launch"/>'
    file.demand("RViz", launch_nodes.is_viewer, launcher)
    file.demand("joy_node", launch_nodes.is_joystick, JOY_HINT)
    if len(file.own) > 1:
        seen, hint = f"{len(file.own)}: both would drive", f"{TURTLEBOT} starts it already"
        raise Wrong("one joy2twist", seen, file.at("joy2twist.py"), hint)
