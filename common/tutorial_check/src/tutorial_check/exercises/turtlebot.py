"""C27 and C28: remapping, and the launch file for the real TurtleBot."""

import re

from tutorial_check.exercises import check, launch_files, launch_nodes, launch_runs
from tutorial_check.exercises.driving import CMD_VEL, JOY, PACKAGE
from tutorial_check.exercises.launch_files import REAL, TURTLEBOT
from tutorial_check.exercises.launch_text import place_of, read
from tutorial_check.exercises.robot import held, rest
from tutorial_check.model import CannotCheck, Wrong

TELEOP, ACTIVE = "/cmd_vel_mux/input/teleop", "/cmd_vel_mux/active"
REMAP = '<remap from="/cmd_vel" to="/cmd_vel_mux/input/teleop"/>'


@check(
    "C27",
    "joy2twist_turtlebot sends to the multiplexer",
    "6.1",
    "C16",
    look="rostopic echo /cmd_vel_mux/input/teleop",
)
def remapped(session):
    """Joy2twist_turtlebot sends to the multiplexer."""
    path = launch_files.check_file(session, TURTLEBOT)
    text = read(path)
    where = f"launch/{TURTLEBOT}"
    launch_nodes.demand(session, TURTLEBOT, "joy2twist", launch_nodes.is_own, launch_nodes.OWN_HINT)
    expected = f"Twists on {TELEOP}, none on {CMD_VEL}"
    with session.stage() as stage:
        stage.call("listen", CMD_VEL, "Twist")
        stage.call("advertise", JOY, "Joy")
        launch = launch_runs.Launch(session, TURTLEBOT, stage, TELEOP)
        launch.wait(
            lambda: (
                stage.call("listeners", JOY) > 1  # one is ours
                and (
                    stage.call("speakers", TELEOP)
                    or stage.call("speakers", CMD_VEL)
                    or _other_topics(stage.call("state")[0])
                )
            )
        )
        rest(stage, TELEOP, CMD_VEL)
        stage.call("stream", JOY, [held(0.2, 0.3)], 20.0, True)

        def moving(topic):
            return any(abs(value[0]) > 0.01 for _, _, value in stage.call("heard", topic))

        stage.wait(lambda: moving(TELEOP) or moving(CMD_VEL) or launch.is_over(), 3.0)
        good, bad = moving(TELEOP), moving(CMD_VEL)
        publishers, subscribers = stage.call("state")
        output, has_died = launch.program.output, launch_runs.has_died(launch)
    own = [node for node in launch_nodes.nodes_of(session, TURTLEBOT) if launch_nodes.is_own(node)]
    remaps = [remap for node in own for remap in node["remaps"]]
    line = place_of(where, text, "<remap", "joy2twist.py")
    if good and not bad and CMD_VEL not in publishers:
        by_file = (
            remaps
            or any(":=" in node["args"] for node in own)
            or re.search(r"<(ros)?param\b", text)
        )
        if not by_file:
            raise Wrong(
                "the program as it was, whose topic the launch file renames",
                f"{own[0]['type']} publishes on {TELEOP} by itself",
                where=place_of(where, text, own[0]["type"]),
                hint=f'type="joy2twist.py", and in it {REMAP}',
            )
        return None
    if "Traceback" in output or has_died:
        from tutorial_check.causes import explain  # noqa: PLC0415
        from tutorial_check.tracebacks import first_traceback, last_lines  # noqa: PLC0415

        trace = first_traceback(output, str(session.package(PACKAGE).folder))
        raise Wrong(
            expected,
            trace.error if trace else last_lines(output),
            where=trace.where if trace else where,
            hint=explain(trace.error) if trace else "",
        )
    if bad and re.search(r"<param\s+(from|name)=", text) and not remaps:
        raise Wrong(
            expected,
            "Twists on /cmd_vel: a <param> renames nothing",
            where=place_of(where, text, "<param"),
            hint=REMAP,
            sure=True,
        )
    if bad and not remaps and "<remap" in text:
        raise Wrong(
            expected,
            "Twists on /cmd_vel: the <remap> stands outside of the node, and not before it",
            where=line,
            hint="a <remap> holds for the node around it, and for those below it: put it between"
            " <node ...> and </node>",
            sure=True,
        )
    if bad and any(to.strip("/") == "cmd_vel" for _, to in remaps):
        raise Wrong(
            expected,
            "Twists on /cmd_vel: from and to are swapped",
            where=line,
            hint=f"from is the name in the program: {REMAP}",
            sure=True,
        )
    others = _other_topics(publishers)
    if others:
        is_meant = others[0] in [to for _, to in remaps]
        raise Wrong(expected, f"it publishes on {others[0]}", line, REMAP, sure=bad or is_meant)
    if bad:
        seen = "Twists on /cmd_vel" + ("" if remaps else ": nothing is remapped")
        if remaps:
            seen += f": the remap from {remaps[0][0]} fits no topic of the program"
        raise Wrong(expected, seen, where=line, hint=REMAP, sure=True)
    if JOY not in subscribers:
        raise Wrong(
            expected,
            "nobody listens to /joy",
            where=where,
            hint="does the node start, and is /joy left as it is?",
        )
    raise Wrong(expected, "no Twist at all", where=where, hint=REMAP)


def _other_topics(publishers):
    return sorted(
        topic
        for topic in publishers
        if re.search("vel|teleop|mux", topic) and topic not in (TELEOP, CMD_VEL)
    )


@check(
    "C28",
    "launch_joy_node_realTurtlebot drives the TurtleBot",
    "6.1",
    "C27",
    look="rostopic echo /cmd_vel_mux/active",
)
def real_robot(session):
    """Launch_joy_node_realTurtlebot drives the TurtleBot."""
    path = launch_files.check_file(session, REAL)
    text = read(path)
    where = f"launch/{REAL}"
    own = [node for node in launch_nodes.nodes_of(session, REAL) if launch_nodes.is_own(node)]
    # Its node, with the remap, may stand here once more.
    is_remapped = any(f"/{to.strip('/')}" == TELEOP for node in own for _, to in node["remaps"])
    files = launch_files.facts(session, REAL)["files"]
    if not is_remapped and not any(each.endswith(f"/{TURTLEBOT}") for each in files):
        raise Wrong(
            f"it includes {TURTLEBOT}",
            "it does not",
            where=where,
            hint=f'<include file="$(find {PACKAGE})/launch/{TURTLEBOT}"/>',
        )
    launch_nodes.demand(
        session,
        REAL,
        "RViz",
        launch_nodes.is_viewer,
        '<include file="$(find turtlebot_rviz_launchers)/launch/view_robot.launch"/>',
    )
    launch_nodes.demand(session, REAL, "joy_node", launch_nodes.is_joystick, launch_nodes.JOY_HINT)
    if len(own) > 1:
        raise Wrong(
            "one joy2twist",
            f"{len(own)}: both would drive",
            where=place_of(where, text, "joy2twist.py"),
            hint=f"{TURTLEBOT} starts it already",
        )
    has_base = any(
        node["type"] == "cmd_vel_mux.py" for node in launch_nodes.nodes_of(session, REAL)
    )
    with session.stage() as stage:
        stage.call("listen", ACTIVE, "String")
        pad = launch_runs.plug_in_for(session, stage, REAL)
        base = None
        if not has_base:
            base = stage.launch(
                ["roslaunch", "fake_turtlebot_sim", "minimal.launch", "model:=false"], trusted=True
            )
        launch = launch_runs.Launch(session, REAL, stage, TELEOP)
        pushed = launch_runs.push_when_ready(stage, pad, launch, ACTIVE)
        stage.wait(lambda: launch.moved() > 0.15 or launch.is_over(), 4.0 if pushed else 0.0)
        if base and base.ended:
            raise CannotCheck(f"the simulated TurtleBot does not start: {base.output[-200:]}")
        moved = launch.moved() > 0.15
        active = {value for _, _, value in stage.call("heard", ACTIVE)}
        if not moved:
            raise launch.wrong(
                "cmd_vel_mux lets teleop through, and the robot moves with the stick"
            )
    if not any("teleop" in each for each in active):
        raise Wrong(
            "cmd_vel_mux/active says teleop",
            f"{', '.join(sorted(active)) or 'nothing'}",
            where=where,
            hint=REMAP,
        )
