"""C22 and C25: which nodes the launch files of section 5 start."""

from __future__ import annotations

import os
import re
from pathlib import Path

from tutorial_check.course import check
from tutorial_check.handout.s4.judge import check_recording
from tutorial_check.handout.s4_3.record import CMD_VEL, JOY
from tutorial_check.handout.s5.launch_facts import Node
from tutorial_check.handout.s5.launch_files import BAG, JOY_HINT, STICK, LaunchFile, copy_bag
from tutorial_check.handout.s5.launch_text import attribute
from tutorial_check.handout.task import PACKAGE
from tutorial_check.model import Note, Wrong
from tutorial_check.record.session import Session

ROBOT_HINT = '<include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>'
# {} is the student's package.
OWN_HINT = '<node pkg="{}" type="joy2twist.py" name="myjoystick2twist"/>'
BAG_HINT = '<node pkg="rosbag" type="play" name="rosbag" args="--loop $(find {})/bag/joy.bag"/>'
VIEWER_HINT = '<node pkg="rviz" type="rviz" name="my_rviz" args="-d $(find rbx1_nav)/sim.rviz"/>'
# Of rosbag play; as letters after one hyphen none of these words makes sense.
LONG_OPTIONS = "loop|clock|rate|quiet|delay|start|pause|immediate|queue|hz|keep-alive|topics"


def is_viewer(node: Node) -> bool:
    return node["type"] in ("rviz", "view_robot")


def is_simulator(node: Node) -> bool:
    is_ours = (node["package"], node["type"]) == ("fake_turtlebot_sim", "fake_turtlebot.py")
    return is_ours or node["package"].startswith("arbotix")


def is_player(node: Node) -> bool:
    return (node["package"], node["type"]) == ("rosbag", "play")


def is_joystick(node: Node) -> bool:
    is_driver = node["type"] in ("joy_node", "joy_node.py", "joystick.py")
    return is_driver and node["package"] != "rosbag"


def is_there(session: Session, path: str) -> bool:
    """Return whether a file that a launch file names is there, for the student's programs, too."""
    return session.may_see(path) and os.path.isfile(path)


def check_viewer(file: LaunchFile) -> Note | None:
    """Return a Note about RViz, or None. Raises Wrong if its configuration does not exist."""
    node = file.demand("RViz", is_viewer, VIEWER_HINT)
    words = file.words_of(node)
    options = zip(words, words[1:])
    config = next((word for option, word in options if option in ("-d", "--display-config")), "")
    where = file.at(Path(config).name, *attribute("type", node["type"]))
    hint = "-d $(find rbx1_nav)/sim.rviz"
    if config and config != "auto" and not is_there(file.session, config):
        seen = f"no file {config} on this machine"
        raise Wrong("-d FILE names a file that exists", seen, where, hint)
    if not config and node["type"] == "rviz":
        return Note("RViz opens without -d FILE: its view is the last one used", where, hint)
    return None


def odd_name(file: LaunchFile) -> Note | None:
    """Return a Note about a node whose name has a space; None if there is none."""
    for name in (node["name"] for node in file.nodes if " " in node["name"]):
        hint = f'the PDF shows _ as a gap: name="{name.replace(" ", "_")}"'
        seen = f'name="{name}": the name of a node has no space'
        return Note(seen, file.at(*attribute("name", name)), hint)
    return None


def check_one_driver(file: LaunchFile) -> None:
    """Raise Wrong if two programs of the student's send velocities to the same place."""
    drivers = [node for node in file.own if _drives(file.session, node)]
    drivers = [node for node in drivers if node["namespace"] == drivers[0]["namespace"]]
    if len(drivers) > 1:
        names = " and ".join(node["type"] for node in drivers)
        where = file.at(*attribute("name", drivers[1]["name"]))
        hint = "keep one of these nodes: /cmd_vel has one publisher"
        raise Wrong("one joy2twist", f"{len(drivers)}, {names}: all would drive", where, hint)


def _drives(session: Session, node: Node) -> bool:
    """Return whether a program publishes Twist, and not on a topic of another name."""
    if topic_of(node, session.task.topic(CMD_VEL)) != CMD_VEL:
        return False
    return any(
        "Twist" in " ".join([*call.words, *call.names.values()])
        for script, facts in session.scripts(PACKAGE).items()
        for call in facts.calls.get("Publisher", [])
        if Path(script).name == node["type"]
    )


def topic_of(node: Node, topic: str) -> str:
    """Return the name that a topic of a node has where a launch file starts it."""
    renamed = (*node["remaps"], *re.findall(r"(\S+):=(\S+)", node["args"]))
    names = {source.strip("/"): to for source, to in renamed}
    return f"/{names.get(topic.strip('/'), topic).strip('/')}"


def check_joy(file: LaunchFile, sender: Node) -> None:
    """Raise Wrong unless the sender, a node, sends its Joys where joy2twist listens."""
    sends, own = topic_of(sender, JOY), file.session.task.topic(JOY)
    listens = [topic_of(node, own) for node in file.own]
    if sends not in listens:
        first = file.own[0]
        seen = f"{sender['type']} sends them on {sends}, {first['type']} listens to {listens[0]}"
        remaps = (*sender["remaps"], *first["remaps"])
        named = [to for source, to in remaps if source.strip("/") in ("joy", own.strip("/"))]
        where = file.at(*(each for to in named for each in attribute("to", to)))
        hint = "leave that <remap> out, or give both nodes the same"
        raise Wrong("the Joys go to joy2twist, on /joy", seen, where, hint)


def bag_of(session: Session) -> tuple[str, str]:
    """Return (the recording that launch_bag plays, where that is written). Raises Wrong."""
    file = LaunchFile(session, BAG)
    play = BAG_HINT.format(file.package)
    node = file.demand("rosbag play", is_player, play)
    where = file.at(*attribute("type", "play"))
    words = [word for word in file.words_of(node) if not word.startswith("_")]
    for word in words:
        if re.fullmatch(rf"[-–—]({LONG_OPTIONS})", word):
            seen, hint = f"{word}, which it does not", f"two plain hyphens: --{word[1:]}"
            raise Wrong("options that rosbag play knows", seen, file.at(word), hint)
    bags = [word for word in words if word.endswith(".bag")]
    if not bags:
        seen = f"args: {node['args'] or 'none'}"
        raise Wrong("rosbag play with the recording", seen, where, play)
    if not os.path.isabs(bags[0]):
        hint = f"roslaunch starts rosbag in a folder of its own: $(find {file.package})/bag/"
        raise Wrong("a whole path to the recording", bags[0], where, hint + Path(bags[0]).name)
    if not is_there(session, bags[0]) and str(session.layout.root) not in bags[0]:
        seen = f"no file {bags[0]} on this machine"
        raise Wrong("a recording that exists", seen, where, copy_bag(session))
    if bags[0].startswith(f"{session.source}/"):
        check_recording(session, os.path.relpath(bags[0], session.source))
    return bags[0], where


def _check_items(file: LaunchFile) -> Note | None:
    """Look at what both files start; return a Note about it, or None."""
    note = check_viewer(file) or odd_name(file)
    file.demand("the simulated robot", is_simulator, ROBOT_HINT)
    file.demand("joy2twist", file.own.__contains__, OWN_HINT.format(file.package))
    check_one_driver(file)
    return note


@check("C22", "launch_bag starts the four items", "5.1", "C21",
       look="roslaunch --nodes {n.package} launch_bag.launch", timeless=True)  # fmt: skip
def bag_nodes(session: Session) -> Note | str | None:
    file = LaunchFile(session, BAG)
    note = _check_items(file)
    bag, where = bag_of(session)
    if any(map(is_joystick, file.nodes)):
        seen, hint = "it starts a joystick, too: both would drive", "take the joy_node out:"
        raise Wrong("a recording only", seen, f"launch/{BAG}", f"{hint} {STICK} has it")
    if bag.startswith(str(session.source)):
        return note
    is_portable = is_there(session, bag) and "$(find" in file.text.split("play", 1)[-1]
    hint = f"$(find {file.package})/bag/joy.bag goes wherever the package goes"
    return Note(f"the recording is not in your package: {bag}", where, "" if is_portable else hint)


@check("C25", "launch_joy_node starts the four items", "5.1", "C21",
       look="roslaunch --nodes {n.package} launch_joy_node.launch", timeless=True)  # fmt: skip
def stick_nodes(session: Session) -> Note | str | None:
    file = LaunchFile(session, STICK)
    note = _check_items(file)
    check_joy(file, file.demand("joy_node", is_joystick, JOY_HINT))
    if any(map(is_player, file.nodes)):
        seen = "it plays a recording, too: both would drive"
        raise Wrong("a joystick only", seen, f"launch/{STICK}", "take the rosbag node out")
    return note
