"""C22 and C25: which nodes the launch files of section 5 start."""

import os
import re
import shlex
from pathlib import Path

from tutorial_check.exercises import check
from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.exercises.launch_files import BAG, STICK, copy_bag, facts, find_launch, relative
from tutorial_check.exercises.launch_text import attribute, place_of, read
from tutorial_check.exercises.robot import check_recording
from tutorial_check.model import Note, Wrong

ROBOT_HINT = '<include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>'
OWN_HINT = '<node pkg="joy2twist" type="joy2twist.py" name="myjoystick2twist"/>'
BAG_HINT = (
    '<node pkg="rosbag" type="play" name="rosbag" args="--loop $(find joy2twist)/bag/joy.bag"/>'
)
JOY_HINT = '<node pkg="joy" type="joy_node" name="joy_node"/>'


# Of rosbag play; as letters after one hyphen none of these words makes sense.
LONG_OPTIONS = "loop|clock|rate|quiet|delay|start|pause|immediate|queue|hz|keep-alive|topics"


def nodes_of(session, name):
    """Those of a launch file, as launch_facts has them."""
    return facts(session, name)["nodes"]


def is_viewer(node):
    """Whether RViz, or what starts it."""
    return node["type"] in ("rviz", "view_robot")


def is_simulator(node):
    """Whether the simulated robot."""
    return (
        node["package"] == "fake_turtlebot_sim" and node["type"] == "fake_turtlebot.py"
    ) or node["package"].startswith("arbotix")


def is_player(node):
    """Whether it plays a recording."""
    return (node["package"], node["type"]) == ("rosbag", "play")


def is_joystick(node):
    """Whether a driver of joysticks."""
    return (
        node["type"] in ("joy_node", "joy_node.py", "joystick.py") and node["package"] != "rosbag"
    )


def is_own(node):
    """Whether the student's joy2twist."""
    return node["package"] == PACKAGE


def demand(session, name, what, test, hint):
    """The node of a launch file of which test() is true, or Wrong."""
    path = find_launch(session, name)
    found = [node for node in nodes_of(session, name) if test(node)]
    if not found:
        raise Wrong(
            f"{name} starts {what}", "it does not", where=relative(session, path), hint=hint
        )
    return found[0]


def words_of(session, name, node):
    """The arguments of a node, as a shell would part them. Raises Wrong."""
    try:
        return shlex.split(node["args"])
    except ValueError as error:
        path = find_launch(session, name)
        raise Wrong(
            "a second quote for each one in args",
            f"{node['args']} ({error})",
            where=place_of(relative(session, path), read(path), *attribute("type", node["type"])),
            hint="leave the ' out: a path without spaces needs none",
        ) from None


def check_viewer(session, name):
    """RViz with a configuration that exists."""
    node = demand(
        session,
        name,
        "RViz",
        is_viewer,
        '<node pkg="rviz" type="rviz" name="my_rviz" args="-d $(find rbx1_nav)/sim.rviz"/>',
    )
    words = words_of(session, name, node)
    config = next(
        (words[i + 1] for i, word in enumerate(words[:-1]) if word in ("-d", "--display-config")),
        None,
    )
    path = find_launch(session, name)
    text, where = read(path), relative(session, path)
    where = place_of(
        where, text, Path(config).name if config else "", *attribute("type", node["type"])
    )
    if config and config != "auto" and not os.path.isfile(config):
        raise Wrong(
            "-d FILE names a file that exists",
            f"no file {config} on this machine",
            where=where,
            hint="-d $(find rbx1_nav)/sim.rviz",
        )
    if not config and node["type"] == "rviz":
        return Note(
            "RViz opens without -d FILE: its view is the last one used",
            where,
            "-d $(find rbx1_nav)/sim.rviz",
        )
    return None


def odd_name(session, name):
    """A Note about a node whose name has a space; None if there is none."""
    for node in nodes_of(session, name):
        if " " in node["name"]:
            path = find_launch(session, name)
            return Note(
                f'name="{node["name"]}": the name of a node has no space',
                place_of(relative(session, path), read(path), *attribute("name", node["name"])),
                f'the PDF shows _ as a gap: name="{node["name"].replace(" ", "_")}"',
            )
    return None


def check_one_driver(session, name):
    """No two programs of the student's send velocities to the same place, or Wrong."""
    drivers = [node for node in nodes_of(session, name) if is_own(node) and _drives(session, node)]
    if drivers:
        drivers = [node for node in drivers if node["namespace"] == drivers[0]["namespace"]]
    if len(drivers) > 1:
        path = find_launch(session, name)
        raise Wrong(
            "one joy2twist",
            f"{len(drivers)}, {' and '.join(node['type'] for node in drivers)}: all would drive",
            where=place_of(
                relative(session, path), read(path), *attribute("name", drivers[1]["name"])
            ),
            hint="keep one of these nodes: /cmd_vel has one publisher",
        )


def _drives(session, node):
    """Whether a program publishes Twist, and not on a topic of another name."""
    is_renamed = any(source.strip("/") == "cmd_vel" for source, _ in node["remaps"])
    return (
        not is_renamed
        and "cmd_vel:=" not in node["args"]
        and any(
            Path(script).name == node["type"]
            and "Twist" in " ".join([*call.words, *call.names.values()])
            for script, facts in session.scripts(PACKAGE).items()
            for call in facts.calls.get("Publisher", [])
        )
    )


def check_joy(session, name, sender):
    """What sends the Joys sends them where joy2twist listens, or Wrong. sender: its node."""
    renamed = [to for source, to in sender["remaps"] if source.strip("/") == "joy"]
    own = [node for node in nodes_of(session, name) if is_own(node)]
    listens = [to.strip("/") for node in own for source, to in node["remaps"]]
    if renamed and renamed[0].strip("/") not in ("joy", *listens):
        path = find_launch(session, name)
        raise Wrong(
            "the Joys go to joy2twist, on /joy",
            f"{sender['type']} sends them on {renamed[0]}",
            where=place_of(relative(session, path), read(path), *attribute("to", renamed[0])),
            hint=f"leave that <remap> out of the node {sender['name']}",
        )


def bag_of(session):
    """The recording that launch_bag plays: its path."""
    node = demand(session, BAG, "rosbag play", is_player, BAG_HINT)
    path = find_launch(session, BAG)
    where = place_of(relative(session, path), read(path), *attribute("type", "play"))
    words = [word for word in words_of(session, BAG, node) if not word.startswith("_")]
    dashed = [word for word in words if re.fullmatch(rf"[-–—]({LONG_OPTIONS})", word)]
    if dashed:
        raise Wrong(
            "options that rosbag play knows",
            f"{dashed[0]}, which it does not",
            where=place_of(where, read(path), dashed[0]),
            hint=f"two plain hyphens: --{dashed[0][1:]}",
        )
    bags = [word for word in words if word.endswith(".bag")]
    if not bags:
        raise Wrong(
            "rosbag play with the recording",
            f"args: {node['args'] or 'none'}",
            where=where,
            hint=BAG_HINT,
        )
    if not os.path.isabs(bags[0]):
        raise Wrong(
            "a whole path to the recording",
            bags[0],
            where=where,
            hint=f"roslaunch starts rosbag in a folder of its own: $(find joy2twist)/bag/{Path(bags[0]).name}",
        )
    if not os.path.isfile(bags[0]) and str(session.layout.root) not in bags[0]:
        raise Wrong(
            "a recording that exists",
            f"no file {bags[0]} on this machine",
            where=where,
            hint=copy_bag(session),
        )
    if bags[0].startswith(f"{session.source}/"):
        check_recording(bags[0], os.path.relpath(bags[0], session.source))
    return bags[0], where


@check(
    "C22",
    "launch_bag starts the four items",
    "5.1",
    "C21",
    look="roslaunch --nodes joy2twist launch_bag.launch",
    timeless=True,
)
def bag_nodes(session):
    """Launch_bag starts the four items."""
    note = check_viewer(session, BAG) or odd_name(session, BAG)
    demand(session, BAG, "the simulated robot", is_simulator, ROBOT_HINT)
    demand(session, BAG, "joy2twist", is_own, OWN_HINT)
    check_one_driver(session, BAG)
    bag, where = bag_of(session)
    if any(is_joystick(node) for node in nodes_of(session, BAG)):
        raise Wrong(
            "a recording only",
            "it starts a joystick, too: both would drive",
            where=f"launch/{BAG}",
            hint=f"take the joy_node out: {STICK} has it",
        )
    if not bag.startswith(str(session.source)):
        if (
            not os.path.isfile(bag)
            or "$(find" not in read(find_launch(session, BAG)).split("play", 1)[-1]
        ):
            return Note(
                f"the recording is not in your package: {bag}",
                where,
                "$(find joy2twist)/bag/joy.bag goes wherever the package goes",
            )
        return Note(f"the recording is not in your package: {bag}", where)
    return note


@check(
    "C25",
    "launch_joy_node starts the four items",
    "5.1",
    "C21",
    look="roslaunch --nodes joy2twist launch_joy_node.launch",
    timeless=True,
)
def stick_nodes(session):
    """Launch_joy_node starts the four items."""
    note = check_viewer(session, STICK) or odd_name(session, STICK)
    demand(session, STICK, "the simulated robot", is_simulator, ROBOT_HINT)
    demand(session, STICK, "joy2twist", is_own, OWN_HINT)
    check_one_driver(session, STICK)
    check_joy(session, STICK, demand(session, STICK, "joy_node", is_joystick, JOY_HINT))
    if any(is_player(node) for node in nodes_of(session, STICK)):
        raise Wrong(
            "a joystick only",
            "it plays a recording, too: both would drive",
            where=f"launch/{STICK}",
            hint="take the rosbag node out",
        )
    return note
