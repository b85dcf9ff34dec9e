"""Exercises 3 and 4: the background of turtlesim, and a turtle that mimics another one."""

import math
from dataclasses import dataclass
from typing import Any, Tuple

from tutorial_course.common import (
    PACKAGE,
    POSE,
    START_S,
    TWIST,
    moves,
    path_of,
    recorded,
    start_turtles,
)

from tutorial_check.course import check
from tutorial_check.course_kit.client import Client
from tutorial_check.course_kit.launches import Launch, Launched, launch_file
from tutorial_check.isolation.program import Ran
from tutorial_check.judge.scripts import crash
from tutorial_check.model import Wrong

BACKGROUND, MIMIC = "background.py", "turtlemimic.launch"
RGB, SENSOR = (10, 200, 30), "/turtle1/color_sensor"
FIRST, SECOND = "/turtlesim1/turtle1", "/turtlesim2/turtle1"
ARC = {"linear": {"x": 2.0}, "angular": {"z": -1.8}}
NEAR_M = 0.3  # the second begins a moment later
COUNTS = {"turtlesim_node": 2, "mimic": 1}


@dataclass(frozen=True)
class Background:
    """The parameters /turtlesim/background_*, those of older pages, and what turtle1 sees."""

    program: Ran
    rgb: Tuple[Any, ...]
    older: Tuple[Any, ...]
    seen: Tuple[int, ...]


@dataclass(frozen=True)
class Mimic:
    """The path of both turtles, once the first was sent off."""

    launched: Launched
    first: Tuple[Tuple[float, ...], ...]
    second: Tuple[Tuple[float, ...], ...]


def change(ground, script) -> Background:
    """Start the program beside turtlesim."""
    with ground.stage() as stage:
        client = Client(stage)
        start_turtles(stage, client)
        program = stage.start(PACKAGE, script, *map(str, RGB))
        stage.wait_for_start(lambda: program.ended)
        client.listen(SENSOR, "turtlesim/Color")
        stage.wait(lambda: client.count(SENSOR), START_S)
        names = [[f"{where}/background_{each}" for each in "rgb"] for where in ("/turtlesim", "")]
        rgb, older = (tuple(map(client.parameter, each)) for each in names)
        return Background(program.ran, rgb, older, tuple(client.heard(SENSOR)[0][2].values()))


def launch_mimic(ground, path) -> Mimic:
    """Start the launch file, and send the first turtle off."""
    with ground.stage() as stage:
        client, topics = Client(stage), (f"{FIRST}/pose", f"{SECOND}/pose")
        for topic in topics:
            client.listen(topic, POSE)
        client.advertise(f"{FIRST}/cmd_vel", TWIST)
        launch = Launch(stage, path)
        stage.wait(lambda: launch.is_over or all(map(client.count, topics)), 3 * START_S)
        if client.meet(launch.program, f"{FIRST}/cmd_vel"):
            client.send(f"{FIRST}/cmd_vel", ARC)
            stage.wait(lambda: moves(client, topics[0]), START_S)
            stage.wait(lambda: not any(moves(client, topic) for topic in topics), START_S)
        return Mimic(launch.launched, *(path_of(client, topic) for topic in topics))


@check("W8", "the background changes", "3", look="rosparam get /turtlesim/background_r")
def background(session):
    """Compare parameters and color."""
    found, blame = recorded(session, PACKAGE, BACKGROUND, change)
    expected = f"/turtlesim/background_r, _g and _b are {RGB}"
    if "Traceback" in found.program.output:
        raise crash(session, PACKAGE, found.program, expected)
    if found.older == RGB:
        seen, hint = "/background_r, _g and _b are", "they are turtlesim's: /turtlesim/background_r"
        raise blame.wrong("set_param", expected, seen, hint)
    if found.rgb != RGB:
        hint = "an argument is a text: int(sys.argv[1])"
        raise blame.wrong("set_param", expected, found.rgb, hint)
    if found.seen != RGB:
        hint = "turtlesim reads them when its service clear is called, so call it after that"
        raise blame.wrong("ServiceProxy( set_param", f"turtle1 sees {RGB}", found.seen, hint)


@check("W9", "turtlemimic.launch", "4", look=f"roslaunch --nodes {PACKAGE} {MIMIC}")
def mimic_file(session):
    """Look at the nodes."""
    file = launch_file(session, PACKAGE, MIMIC)
    for kind, count in COUNTS.items():
        there = [node for node in file.nodes if node["type"] == kind]
        if len(there) != count:
            raise Wrong(f"{count} of {kind}", f"{len(there)}", file.at(kind, "<launch"))
    spaces = sorted(node["namespace"] for node in file.nodes if node["type"] == "turtlesim_node")
    if spaces != ["/turtlesim1/", "/turtlesim2/"]:
        hint = '<group ns="turtlesim1"> around one node, <group ns="turtlesim2"> around the other'
        expected = "a turtlesim_node in turtlesim1, one in turtlesim2"
        raise Wrong(expected, f"in {' and '.join(spaces)}", file.at("ns=", "turtlesim_node"), hint)
    mimic = next(node for node in file.nodes if node["type"] == "mimic")
    remaps = {old.rpartition("/")[2]: new for old, new in mimic["remaps"]}
    for old, new in (("input", FIRST), ("output", SECOND)):
        if f"/{remaps.get(old, old).strip('/')}" != new:
            hint = f'<remap from="{old}" to="{new[1:]}"/> within the <node> of mimic'
            seen = remaps.get(old, "not remapped")
            raise Wrong(f"{old} is {new[1:]}", seen, file.at(f'"{old}"', '"mimic"'), hint)


@check("W10", "the second turtle mimics the first", "4", "W9", look=f"rostopic echo {SECOND}/pose")
def mimics(session):
    """Compare where both are."""
    file = launch_file(session, PACKAGE, MIMIC)
    found = session.recording(launch_mimic, file.path)
    if found.launched.died or not (found.first and found.second):
        seen = f"died: {', '.join(found.launched.died) or 'none'}"
        raise Wrong("two turtles", f"{seen}; nodes: {', '.join(found.launched.nodes)}", file.where)
    gap = math.dist(found.first[-1][:2], found.second[-1][:2])
    if gap > NEAR_M or found.first[0][:2] == found.first[-1][:2]:
        where = file.at("cmd_vel", "<remap", '"mimic"')
        raise Wrong("both drive the same arc", f"{gap:.1f} m apart", where)
