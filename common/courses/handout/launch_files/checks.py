"""C21 to C26: the nodes of the launch files of section 5, and what they do when launched."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

from tutorial_check import (
    LaunchNode,
    Note,
    Script,
    SourceFacts,
    Submission,
    Wrong,
    attribute,
    check,
    must_pass,
)

from ..driving.bag_checks import check_recording
from ..launch_runs.handout_launch import BAG, JOY_HINT, STICK, HandoutLaunch, check_launch, copy_bag
from ..launch_runs.plans import ROBOT_HINT, fault_of, plan_of, topic_of
from ..launch_runs.record import LaunchRun, Plan
from ..task import CMD_VEL, JOY, PACKAGE
from .record import BAG_S, bag_run, stick_run

BAG_HINT = '<node pkg="rosbag" type="play" name="rosbag" args="--loop $(find {})/bag/joy.bag"/>'
VIEWER_HINT = '<node pkg="rviz" type="rviz" name="my_rviz" args="-d $(find rbx1_nav)/sim.rviz"/>'
# Of rosbag play. After a single hyphen, none of these words makes sense as letters.
LONG_OPTIONS = "loop|clock|rate|quiet|delay|start|pause|immediate|queue|hz|keep-alive|topics"
ONCE_S = 60.0  # a bag that is not repeated lasts until the other nodes have started
LOOP = re.compile(r"--l(oop|oo|o)?|-[a-z]*l[a-z]*")  # ways to write rosbag play's option


def is_there(submission: Submission, path: str) -> bool:
    """Return whether a file exists, and the student's programs may read it."""
    return submission.may_see(path) and os.path.isfile(path)


def check_viewer(file: HandoutLaunch) -> Note | None:
    """Return a Note about RViz, or None. Raises Wrong if its configuration does not exist."""
    node = file.must_start("RViz", file.of("viewer"), VIEWER_HINT)
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


def sends_twists(facts: SourceFacts) -> bool:
    calls = facts.calls.get("Publisher", [])
    return any("Twist" in word for call in calls for word in (*call.words, *call.names.values()))


def several_drivers(file: HandoutLaunch) -> Wrong | None:
    """Find two of the student's programs that send velocities to the same topic."""
    submission = file.submission
    topic, programs = submission.task.topic(CMD_VEL), submission.programs(PACKAGE)
    of_twists = {
        Script(submission, PACKAGE, path).name
        for path, facts in programs.items()
        if sends_twists(facts)
    }
    nodes = [node for node in file.own if topic_of(node, topic) == CMD_VEL]
    drivers = [node for node in nodes if node["type"] in of_twists]
    drivers = [node for node in drivers if node["namespace"] == drivers[0]["namespace"]]
    if len(drivers) < 2:
        return None
    names = " and ".join(node["type"] for node in drivers)
    where = file.at(*attribute("name", drivers[1]["name"]))
    hint = "keep one of these nodes: /cmd_vel has one publisher"
    return Wrong("one joy2twist", f"{len(drivers)}, {names}: all would drive", where, hint)


@dataclass(frozen=True)
class BagPlayer:
    """The node of launch_bag that plays the bag."""

    file: HandoutLaunch
    node: LaunchNode
    words: Sequence[str]  # its arguments

    @property
    def bag(self) -> str:
        return next((word for word in self.words if word.endswith(".bag")), "")

    @property
    def hint(self) -> str:
        return BAG_HINT.format(self.file.student_package)

    @property
    def where(self) -> str:
        return self.file.at(*attribute("type", "play"))


def short_hyphens(player: BagPlayer) -> Wrong | None:
    odd = (word for word in player.words if re.fullmatch(rf"[-–—]({LONG_OPTIONS})", word))
    for word in odd:
        seen, hint = f"{word}, which it does not know", f"two plain hyphens: --{word[1:]}"
        return Wrong("options that rosbag play knows", seen, player.file.at(word), hint)
    return None


def no_recording(player: BagPlayer) -> Wrong | None:
    if player.bag:
        return None
    seen = f"args: {player.node['args'] or 'none'}"
    return Wrong("rosbag play with the recording", seen, player.where, player.hint)


def relative_path(player: BagPlayer) -> Wrong | None:
    if os.path.isabs(player.bag):
        return None
    hint = f"roslaunch starts rosbag in a folder of its own: $(find {player.file.student_package})"
    hint += f"/bag/{Path(player.bag).name}"
    return Wrong("a whole path to the recording", player.bag, player.where, hint)


def lost_recording(player: BagPlayer) -> Wrong | None:
    submission = player.file.submission
    if is_there(submission, player.bag) or str(submission.layout.root) in player.bag:
        return None
    seen, hint = f"no file {player.bag} on this machine", copy_bag(submission)
    return Wrong("a recording that exists", seen, player.where, hint)


def player_of(submission: Submission) -> BagPlayer:
    """Return the BagPlayer of launch_bag, whose bag can be played. Raises Wrong."""
    file = HandoutLaunch(submission, BAG)
    hint = BAG_HINT.format(file.student_package)
    node = file.must_start("rosbag play", file.of("player"), hint)
    words = [word for word in file.words_of(node) if not word.startswith("_")]
    player = BagPlayer(file, node, words)
    must_pass((short_hyphens, no_recording, relative_path, lost_recording), player)
    if player.bag.startswith(f"{submission.source}/"):
        check_recording(submission, os.path.relpath(player.bag, submission.source))
    return player


def _check_items(file: HandoutLaunch) -> Note | None:
    """Check what both files must start; return a Note, or None. Raises Wrong."""
    note = check_viewer(file)
    odd = [node["name"] for node in file.nodes if " " in node["name"]]
    if odd and not note:
        hint = f'the PDF shows _ as a gap: name="{odd[0].replace(" ", "_")}"'
        seen = f'name="{odd[0]}": the name of a node has no space'
        note = Note(seen, file.at(*attribute("name", odd[0])), hint)
    file.must_start("the simulated robot", file.of("simulator"), ROBOT_HINT)
    file.must_start("joy2twist", file.own, file.own_node)
    must_pass([several_drivers], file)
    return note


@check("C21", "the two launch files can be read, and what they name is there", "5.1", needs="C12",
       look="roslaunch --nodes {n.package} launch_bag.launch", timeless=True)  # fmt: skip
def are_readable(submission: Submission) -> Note | str | None:
    return ", ".join(check_launch(submission, name).where for name in (BAG, STICK))


@check("C22", "launch_bag starts the four items", "5.1", needs=are_readable,
       look="roslaunch --nodes {n.package} launch_bag.launch", timeless=True)  # fmt: skip
def bag_nodes(submission: Submission) -> Note | str | None:
    file = HandoutLaunch(submission, BAG)
    note = _check_items(file)
    player = player_of(submission)
    if file.of("joystick"):
        seen, hint = "it starts a joystick, too: both would drive", "take the joy_node out:"
        raise Wrong("a recording only", seen, f"launch/{BAG}", f"{hint} {STICK} has it")
    if player.bag.startswith(str(submission.source)):
        return note
    is_portable = is_there(submission, player.bag) and "$(find" in file.text.split("play", 1)[-1]
    hint = f"$(find {file.student_package})/bag/joy.bag goes wherever the package goes"
    seen = f"the recording is not in your package: {player.bag}"
    return Note(seen, player.where, "" if is_portable else hint)


@check("C25", "launch_joy_node starts the four items", "5.1", needs=are_readable,
       look="roslaunch --nodes {n.package} launch_joy_node.launch", timeless=True)  # fmt: skip
def stick_nodes(submission: Submission) -> Note | str | None:
    file = HandoutLaunch(submission, STICK)
    note = _check_items(file)
    sender, first = file.must_start("joy_node", file.of("joystick"), JOY_HINT), file.own[0]
    own, sends = submission.task.topic(JOY), topic_of(sender, JOY)
    listens = [topic_of(node, own) for node in file.own]
    if sends not in listens:
        seen = f"{sender['type']} sends them on {sends}, {first['type']} listens to {listens[0]}"
        remaps = (*sender["remaps"], *first["remaps"])
        named = [to for source, to in remaps if source.strip("/") in ("joy", own.strip("/"))]
        where = file.at(*(word for to in named for word in attribute("to", to)))
        hint = "leave that <remap> out, or give both nodes the same"
        raise Wrong("the Joys go to joy2twist, on /joy", seen, where, hint)
    if file.of("player"):
        seen = "it plays a recording, too: both would drive"
        raise Wrong("a joystick only", seen, f"launch/{STICK}", "take the rosbag node out")
    return note


def _bag_run(submission: Submission) -> tuple[BagPlayer, Plan, LaunchRun]:
    """Return launch_bag, its plan, and its run with the checker's own bag."""
    player, source = player_of(submission), submission.source
    is_own, plan = player.bag.startswith(str(source)), plan_of(player.file)
    inside = os.path.relpath(player.bag, source) if is_own else ""
    is_looped = any(map(LOOP.fullmatch, player.words))
    length_s = BAG_S if is_looped or player.node["respawn"] else ONCE_S
    return player, plan, submission.recording(bag_run, plan, inside, length_s, is_looped)


@check("C23", "launch_bag drives the robot", "5.1", needs=(bag_nodes, "C16"),
       look="roslaunch {n.package} launch_bag.launch")  # fmt: skip
def bag_drives(submission: Submission) -> None:
    player, plan, run = _bag_run(submission)
    if not run.drives or not run.counts[plan.joys]:
        expected = "/joy, /cmd_vel and /odom flow, and the robot drives more than 0.3 m"
        raise fault_of(player.file, plan, run, expected)


@check("C24", "the recording begins again at its end", "5.1", needs=bag_drives,
       look="rostopic hz /joy")  # fmt: skip
def bag_loops(submission: Submission) -> None:
    player, _, run = _bag_run(submission)
    if not run.loops and not player.node["respawn"]:
        expected = "/joy continues after the end of the recording"
        hint = "rosbag play --loop: in args= of that node"
        raise Wrong(expected, "it falls silent", player.where, hint)


@check("C26", "launch_joy_node drives the robot", "5.1", needs=(stick_nodes, "C16"),
       look="roslaunch {n.package} launch_joy_node.launch")  # fmt: skip
def stick_drives(submission: Submission) -> None:
    file = HandoutLaunch(submission, STICK)
    plan = plan_of(file)
    run = submission.recording(stick_run, plan)
    if not run.drives:
        raise fault_of(file, plan, run, "the robot moves with the stick")
    if not run.rests:
        raise Wrong("released, the robot stands", "it drives on", f"launch/{STICK}")
