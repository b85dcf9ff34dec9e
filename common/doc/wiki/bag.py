"""Exercise 6: a recording of turtle1, which drives another one."""

import math
from dataclasses import dataclass
from typing import Dict, Tuple

from tutorial_course.common import PACKAGE, POSE, TWIST, moves, path_of, start_turtles

from tutorial_check.course import check
from tutorial_check.course_kit.client import Client
from tutorial_check.judge.packages import package_of
from tutorial_check.model import Wrong
from tutorial_check.source.tracebacks import last_lines

KINDS = {"/turtle1/cmd_vel": TWIST, "/turtle1/pose": POSE}
RECORD = f"rosbag record -O subset {' '.join(KINDS)}, while turtle_teleop_key drives"
LEAST_M, LONGEST_S = 0.5, 120.0


@dataclass(frozen=True)
class Bag:
    """What a recording has: the type of each topic."""

    error: str
    topics: Dict[str, str]


@dataclass(frozen=True)
class Played:
    """What a turtle does while the commands are played."""

    output: str
    path: Tuple[Tuple[float, ...], ...]


def read(ground, path) -> Bag:
    """Read a recording. path: within src."""
    import rosbag  # noqa: PLC0415

    try:
        with rosbag.Bag(str(ground.source / path)) as bag:
            found = bag.get_type_and_topic_info().topics
    except (rosbag.ROSBagException, OSError, ValueError) as error:
        return Bag(str(error) or type(error).__name__, {})
    return Bag("", {topic: one.msg_type for topic, one in found.items()})


def play(ground, path) -> Played:
    """Play the commands of a recording to a turtle."""
    with ground.stage() as stage:
        client = Client(stage)
        start_turtles(stage, client)
        words = ["rosbag", "play", str(ground.source / path), "--topics", "/turtle1/cmd_vel"]
        program = stage.launch(words)
        stage.wait(lambda: program.ended, LONGEST_S)
        stage.wait(lambda: not moves(client), 3.0)
        return Played(program.output, path_of(client))


def bag_of(session):
    """Return the path of the recording within src. Raises Wrong."""
    bags = sorted(package_of(session, PACKAGE).folder.rglob("*.bag*"))
    bags.sort(key=lambda each: (each.suffix != ".bag", each.stem != "subset"))
    name = str(bags[0].relative_to(session.source)) if bags else ""
    if not name.endswith(".bag"):
        expected = f"a recording in {PACKAGE}, as bagfiles/subset.bag"
        raise Wrong(expected, "none that was ended by Ctrl-C" if name else "none", name, RECORD)
    return name


@check("W13", "a recording of a drive", "6", look="rosbag info subset.bag")
def recording(session):
    """Look at its topics."""
    path = bag_of(session)
    bag = session.recording(read, path)
    if bag.error:
        raise Wrong("a recording that rosbag can read", bag.error, path, f"rosbag reindex {path}")
    for topic, kind in KINDS.items():
        if bag.topics.get(topic) != kind:
            seen = ", ".join(f"{each} ({one})" for each, one in sorted(bag.topics.items()))
            raise Wrong(f"{topic} ({kind})", seen or "none", path, RECORD)


@check("W14", "played, it drives a turtle", "6", "W13", look="rosbag play subset.bag")
def drives(session):
    """Look how far a turtle drives."""
    path = bag_of(session)
    found = session.recording(play, path)
    way = sum(math.dist(one[:2], two[:2]) for one, two in zip(found.path, found.path[1:]))
    if way < LEAST_M:
        seen = f"{way:.1f} m; rosbag: {last_lines(found.output, 1)}"
        hint = "keys go to the terminal of turtle_teleop_key, while rosbag records in another one"
        raise Wrong(f"the turtle drives {LEAST_M} m or more", seen, path, hint)
    return f"{way:.1f} m"
