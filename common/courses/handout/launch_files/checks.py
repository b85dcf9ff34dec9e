"""C22 to C26: which nodes the launch files of section 5 start, and the files at work."""

from __future__ import annotations

import os
import re
from pathlib import Path

from tutorial_check import (
    ODOM,
    Node,
    Note,
    Submission,
    Wrong,
    attribute,
    cause_of,
    check,
    first_traceback,
)

from ..driving.bag_checks import check_recording
from ..task import CMD_VEL, JOY, PACKAGE
from .files import BAG, JOY_HINT, STICK, LaunchFile, copy_bag
from .record import BAG_S, Plan, Run, bag_run, stick_run

ROBOT_HINT = '<include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>'
# {} is the student's package.
OWN_HINT = '<node pkg="{}" type="joy2twist.py" name="myjoystick2twist"/>'
BAG_HINT = '<node pkg="rosbag" type="play" name="rosbag" args="--loop $(find {})/bag/joy.bag"/>'
VIEWER_HINT = '<node pkg="rviz" type="rviz" name="my_rviz" args="-d $(find rbx1_nav)/sim.rviz"/>'
# Of rosbag play; as letters after one hyphen none of these words makes sense.
LONG_OPTIONS = "loop|clock|rate|quiet|delay|start|pause|immediate|queue|hz|keep-alive|topics"
ONCE_S = 60.0  # a recording that is not repeated lasts until the others have started
LOOP = re.compile(r"--l(oop|oo|o)?|-[a-z]*l[a-z]*")  # rosbag play's option, as it may be written
ERRORS = re.compile(r"^(?!.*(?:rviz|INFO)).*(?:ERROR|died|Invalid|cannot|Unable)", re.MULTILINE)
COLOUR = re.compile(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07")


def is_there(submission: Submission, path: str) -> bool:
    """Return whether a file that a launch file names is there, for the student's programs, too."""
    return submission.may_see(path) and os.path.isfile(path)


def check_viewer(file: LaunchFile) -> Note | None:
    """Return a Note about RViz, or None. Raises Wrong if its configuration does not exist."""
    node = file.demand("RViz", file.of("viewer"), VIEWER_HINT)
    words = file.words_of(node)
    options = zip(words, words[1:])
    config = next((word for option, word in options if option in ("-d", "--display-config")), "")
    where = file.at(Path(config).name, *attribute("type", node["type"]))
    hint = "-d $(find rbx1_nav)/sim.rviz"
    if config and config != "auto" and not is_there(file.submission, config):
        seen = f"no file {config} on this machine"
        raise Wrong("-d FILE names a file that exists", seen, where, hint)
    if not config and node["type"] == "rviz":
        return Note("RViz opens without -d FILE: its view is the last one used", where, hint)
    return None


def check_one_driver(file: LaunchFile) -> None:
    """Raise Wrong if two programs of the student's send velocities to the same place."""
    programs, topic = file.submission.scripts(PACKAGE).items(), file.submission.task.topic(CMD_VEL)
    calls = ((path, one) for path, facts in programs for one in facts.calls.get("Publisher", []))
    words = ((path, " ".join([*one.words, *one.names.values()])) for path, one in calls)
    of_twists = {Path(path).name for path, each in words if "Twist" in each}
    drivers = [node for node in file.own if topic_of(node, topic) == CMD_VEL]
    drivers = [node for node in drivers if node["type"] in of_twists]
    drivers = [node for node in drivers if node["namespace"] == drivers[0]["namespace"]]
    if len(drivers) > 1:
        names = " and ".join(node["type"] for node in drivers)
        where = file.at(*attribute("name", drivers[1]["name"]))
        hint = "keep one of these nodes: /cmd_vel has one publisher"
        raise Wrong("one joy2twist", f"{len(drivers)}, {names}: all would drive", where, hint)


def topic_of(node: Node, topic: str) -> str:
    """Return the name that a topic of a node has where a launch file starts it."""
    renamed = (*node["remaps"], *re.findall(r"(\S+):=(\S+)", node["args"]))
    names = {source.strip("/"): to for source, to in renamed}
    return f"/{names.get(topic.strip('/'), topic).strip('/')}"


def bag_of(submission: Submission) -> tuple[str, str]:
    """Return (the recording that launch_bag plays, where that is written). Raises Wrong."""
    file = LaunchFile(submission, BAG)
    play = BAG_HINT.format(file.package)
    node = file.demand("rosbag play", file.of("player"), play)
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
    if not is_there(submission, bags[0]) and str(submission.layout.root) not in bags[0]:
        seen = f"no file {bags[0]} on this machine"
        raise Wrong("a recording that exists", seen, where, copy_bag(submission))
    if bags[0].startswith(f"{submission.source}/"):
        check_recording(submission, os.path.relpath(bags[0], submission.source))
    return bags[0], where


def _check_items(file: LaunchFile) -> Note | None:
    """Look at what both files start; return a Note about it, or None."""
    note = check_viewer(file)
    odd = [node["name"] for node in file.nodes if " " in node["name"]]
    if odd and not note:
        hint = f'the PDF shows _ as a gap: name="{odd[0].replace(" ", "_")}"'
        seen = f'name="{odd[0]}": the name of a node has no space'
        note = Note(seen, file.at(*attribute("name", odd[0])), hint)
    file.demand("the simulated robot", file.of("simulator"), ROBOT_HINT)
    file.demand("joy2twist", file.own, OWN_HINT.format(file.package))
    check_one_driver(file)
    return note


@check("C22", "launch_bag starts the four items", "5.1", needs="C21",
       look="roslaunch --nodes {n.package} launch_bag.launch", timeless=True)  # fmt: skip
def bag_nodes(submission: Submission) -> Note | str | None:
    file = LaunchFile(submission, BAG)
    note = _check_items(file)
    bag, where = bag_of(submission)
    if file.of("joystick"):
        seen, hint = "it starts a joystick, too: both would drive", "take the joy_node out:"
        raise Wrong("a recording only", seen, f"launch/{BAG}", f"{hint} {STICK} has it")
    if bag.startswith(str(submission.source)):
        return note
    is_portable = is_there(submission, bag) and "$(find" in file.text.split("play", 1)[-1]
    hint = f"$(find {file.package})/bag/joy.bag goes wherever the package goes"
    return Note(f"the recording is not in your package: {bag}", where, "" if is_portable else hint)


@check("C25", "launch_joy_node starts the four items", "5.1", needs="C21",
       look="roslaunch --nodes {n.package} launch_joy_node.launch", timeless=True)  # fmt: skip
def stick_nodes(submission: Submission) -> Note | str | None:
    file = LaunchFile(submission, STICK)
    note = _check_items(file)
    sender, first = file.demand("joy_node", file.of("joystick"), JOY_HINT), file.own[0]
    own, sends = submission.task.topic(JOY), topic_of(sender, JOY)
    listens = [topic_of(node, own) for node in file.own]
    if sends not in listens:
        seen = f"{sender['type']} sends them on {sends}, {first['type']} listens to {listens[0]}"
        remaps = (*sender["remaps"], *first["remaps"])
        named = [to for source, to in remaps if source.strip("/") in ("joy", own.strip("/"))]
        where = file.at(*(each for to in named for each in attribute("to", to)))
        hint = "leave that <remap> out, or give both nodes the same"
        raise Wrong("the Joys go to joy2twist, on /joy", seen, where, hint)
    if file.of("player"):
        seen = "it plays a recording, too: both would drive"
        raise Wrong("a joystick only", seen, f"launch/{STICK}", "take the rosbag node out")
    return note


def plan_of(file: LaunchFile, twists: str = CMD_VEL) -> Plan:
    """Return how a launch file is run. twists: the topic on which the velocities should come."""
    senders, sticks = file.of("joystick", "player"), file.of("joystick")
    viewers = file.of("viewer")
    devices = [node["device"] for node in sticks if node["device"].startswith("/dev/input/")]
    return Plan(
        os.path.relpath(file.path, file.submission.source),
        topic_of(senders[0], JOY) if senders else JOY,
        twists,
        tuple(node["namespace"] + node["name"] for node in file.nodes if node not in viewers),
        tuple(node["namespace"] + node["name"] for node in sticks),
        next(iter(devices), ""),
    )


def traced(submission: Submission, run: Run, expected: str) -> Wrong | None:
    """Return the Wrong for the first traceback that was printed, or None."""
    output = COLOUR.sub("", run.program.output)
    trace = first_traceback(output, str(submission.package(PACKAGE).folder))
    if not trace:
        return None
    return Wrong(expected, trace.error, *cause_of(submission, PACKAGE, trace))


def fault_of(file: LaunchFile, plan: Plan, run: Run, expected: str) -> Wrong:
    """Return the Wrong for a launch that does not do what it should, with its first cause."""
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
    return traced(file.submission, run, expected) or Wrong(
        expected, seen, f"launch/{file.name}", hint
    )


def _bag_run(submission: Submission) -> tuple[LaunchFile, Plan, Run]:
    """Return launch_bag and what came of it, with a recording of the checker's own."""
    bag, _ = bag_of(submission)
    file = LaunchFile(submission, BAG)
    plan = plan_of(file)
    inside = (
        os.path.relpath(bag, submission.source) if bag.startswith(str(submission.source)) else ""
    )
    player = file.of("player")[0]
    is_looped = any(LOOP.fullmatch(word) for word in file.words_of(player))
    length_s = BAG_S if is_looped or player["respawn"] else ONCE_S
    return file, plan, submission.recording(bag_run, plan, inside, length_s, is_looped)


@check("C23", "launch_bag drives the robot", "5.1", needs=(bag_nodes, "C16"),
       look="roslaunch {n.package} launch_bag.launch")  # fmt: skip
def bag_drives(submission: Submission) -> None:
    file, plan, run = _bag_run(submission)
    if not run.drives or not run.counts[plan.joys]:
        expected = "/joy, /cmd_vel and /odom flow, and the robot drives more than 0.3 m"
        raise fault_of(file, plan, run, expected)


@check("C24", "the recording begins again at its end", "5.1", needs=bag_drives,
       look="rostopic hz /joy")  # fmt: skip
def bag_loops(submission: Submission) -> None:
    file, _, run = _bag_run(submission)
    if not run.loops and not file.of("player")[0]["respawn"]:
        expected = "/joy flows on after the end of the recording"
        hint = "rosbag play --loop: in args= of that node"
        raise Wrong(expected, "it falls silent", bag_of(submission)[1], hint)


@check("C26", "launch_joy_node drives the robot", "5.1", needs=(stick_nodes, "C16"),
       look="roslaunch {n.package} launch_joy_node.launch")  # fmt: skip
def stick_drives(submission: Submission) -> None:
    file = LaunchFile(submission, STICK)
    plan = plan_of(file)
    run = submission.recording(stick_run, plan)
    if not run.drives:
        raise fault_of(file, plan, run, "the robot moves with the stick")
    if not run.rests:
        raise Wrong("released, the robot stands", "it drives on", f"launch/{STICK}")
