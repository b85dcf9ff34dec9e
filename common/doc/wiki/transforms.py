"""Exercise 7: turtle1 as a transform, and a second turtle that follows it."""

import math
from dataclasses import dataclass
from typing import List, Optional, Tuple

from tutorial_course.common import POSE, START_S, must_run, path_of, recorded, start_turtles

from tutorial_check.course import check
from tutorial_check.course_kit.client import Client, Transform
from tutorial_check.course_kit.launches import Launch, launch_file
from tutorial_check.isolation.program import Ran
from tutorial_check.judge.scripts import program_of
from tutorial_check.model import Wrong

# Packages of the pages of tf2 and of tf, and how the names of their programs begin.
PACKAGES = {"learning_tf2": "turtle_tf2", "learning_tf": "turtle_tf"}
DEMO = "start_demo.launch"
PLACES = ((2.0, 3.0, 0.5), (8.0, 6.0, 2.5))  # x, y [m], theta [rad]
NEAR = 0.02  # [m], and of a quaternion
FOLLOWS_S, NEAR_M = 8.0, 1.5


@dataclass(frozen=True)
class Broadcast:
    """For each place of turtle1 its transform; and the last frames, as in TransformStamped."""

    program: Ran
    transforms: Tuple[Optional[Transform], ...]
    frames: Tuple[dict, ...]


@dataclass(frozen=True)
class Following:
    """The program, all turtles, and how far turtle2 was from turtle1 [m], from the start on."""

    program: Ran
    turtles: Tuple[str, ...]
    gaps: List[float]


def teleport(client, place):
    """Move turtle1."""
    values = dict(zip(("x", "y", "theta"), place))
    client.ask("/turtle1/teleport_absolute", "turtlesim/TeleportAbsolute", values)


def broadcast(ground, script, package) -> Broadcast:
    """Move turtle1, and look up its transform."""
    with ground.stage() as stage:
        client, found, frames = Client(stage), [], []
        start_turtles(stage, client)
        client.listen("/tf", "tf2_msgs/TFMessage")
        program = stage.start(package, script, "_turtle:=turtle1")
        stage.wait_for_start(lambda: program.ended or client.count("/tf"))
        for place in PLACES if client.count("/tf") else ():
            teleport(client, place)
            heard = client.count("/tf")
            stage.wait(lambda past=heard + 5: client.count("/tf") > past, START_S)
            found.append(client.lookup("world", "turtle1", 2.0))
            frames = client.heard("/tf", -1)[0][2]["transforms"]
        return Broadcast(program.ran, tuple(found), tuple(frames))


def follow(ground, path, package, broadcaster) -> Following:
    """Start a listener, turtlesim and broadcasters; or, without a broadcaster, a launch file."""
    with ground.stage() as stage:
        client = Client(stage)
        client.listen("/turtle2/pose", POSE)
        if not broadcaster:
            program = Launch(stage, path).program
        else:
            start_turtles(stage, client)
            for turtle in ("turtle1", "turtle2"):
                stage.start(package, broadcaster, f"_turtle:={turtle}", f"__name:={turtle}_tf")
            program = stage.start(package, path)
        stage.wait(lambda: program.ended or client.count("/turtle2/pose"), 2 * START_S)
        if client.count("/turtle2/pose"):
            teleport(client, PLACES[1])
            stage.wait(lambda: _gap(path_of(client, "/turtle2/pose", -1)[0]) < NEAR_M, FOLLOWS_S)
        turtles = (topic for topic in stage.call("state")[0] if topic.endswith("/pose"))
        gaps = map(_gap, path_of(client, "/turtle2/pose"))
        return Following(program.ran, tuple(turtles), list(gaps))


def _gap(pose):
    return math.dist(pose[:2], PLACES[1][:2])


def names(session):
    """Return the package, and the names of broadcaster and listener."""
    package = next(filter(session.has, PACKAGES), "learning_tf2")
    return package, *(f"{PACKAGES[package]}_{each}.py" for each in ("broadcaster", "listener"))


@check("W15", "the broadcaster", "7", look="rosrun tf tf_echo /world /turtle1")
def broadcaster(session):
    """Compare transforms with poses."""
    package, name, _ = names(session)
    found, blame = recorded(session, package, name, broadcast, package)
    expected = "frames: turtle1 in world"
    must_run(session, package, found.program, expected)
    frames = [f"{each['child_frame_id']} in {each['header']['frame_id']}" for each in found.frames]
    if "turtle1 in world" not in frames:
        words = "frame_id sendTransform" if frames else "Subscriber( sendTransform"
        hint = "header.frame_id is world; child_frame_id is the turtle, as in the parameter turtle"
        raise blame.wrong(words, expected, f"frames: {', '.join(frames) or 'none'}", hint)
    for (x, y, theta), one in zip(PLACES, found.transforms):
        wanted = (0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2))
        if one and math.dist(one.translation, (x, y, 0.0)) > NEAR:
            seen = ", ".join(f"{each:.1f}" for each in one.translation)
            raise blame.wrong(
                "translation sendTransform", f"at ({x}, {y}, 0)", seen, "those of the pose"
            )
        if not one or abs(sum(a * b for a, b in zip(one.rotation, wanted))) < 1.0 - NEAR:
            rotation = found.frames[0]["transform"]["rotation"].values()
            seen, meant = (", ".join(f"{each:.2f}" for each in many) for many in (rotation, wanted))
            hint = "quaternion_from_euler(0, 0, theta)"
            raise blame.wrong("rotation quaternion", f"at {theta} rad: {meant}", seen, hint)


def check_following(session, package, found, where, hint):
    """Raise Wrong unless turtle2 has followed."""
    if found.gaps and found.gaps[-1] <= NEAR_M:
        return
    expected = "a turtle2, which comes near turtle1"
    must_run(session, package, found.program, expected)
    seen = f"only {', '.join(found.turtles) or 'no turtle'}"
    if found.gaps:
        seen = f"{found.gaps[-1]:.1f} m apart after {FOLLOWS_S:.0f} s"
    raise Wrong(expected, seen, where, hint)


@check("W16", "turtle2 follows", "7", "W15", look="rosrun tf tf_echo /turtle2 /turtle1")
def follows(session):
    """Look whether it comes near."""
    package, other, name = names(session)
    other = program_of(session, package, other)
    found, blame = recorded(session, package, name, follow, package, other)
    where, hint = blame.line("spawn", "Spawn"), "call the service spawn"
    if found.gaps:
        where, hint = blame.line("lookup_transform"), "lookup_transform('turtle2', 'turtle1', ...)"
    check_following(session, package, found, where, hint)


@check("W17", "the launch file starts it all", "7", "W16", look=f"roslaunch learning_tf2 {DEMO}")
def starts_all(session):
    """Look at the same, started by roslaunch."""
    package, broadcaster, _ = names(session)
    file = launch_file(session, package, DEMO)
    found = session.recording(follow, file.path, package, "")
    hint = "a broadcaster for each turtle, each with its parameter turtle; and the listener"
    check_following(session, package, found, file.at(broadcaster, "<launch"), hint)
