"""Exercise 7: turtle1 as a transform, and a second turtle that follows it."""

import math
from pathlib import Path

from tutorial_check import Client, Launch, Script, Seen, check, launch_file, program_of, recorded

from .turtles import KINDS, POSE, START_S, gap, turtles

# {package of the tf2 or tf tutorial: prefix of its programs' names}
PACKAGES = {"learning_tf2": "turtle_tf2", "learning_tf": "turtle_tf"}
DEMO = "start_demo.launch"
TELEPORT = "/turtle1/teleport_absolute", "turtlesim/TeleportAbsolute"
PLACE = {"x": 8.0, "y": 6.0, "theta": 2.5}  # [m], [m], [rad]
NEAR = 0.02  # [m], and of a quaternion
SECOND, FOLLOWS_S, NEAR_M = "/turtle2/pose", 8.0, 1.5


def names(submission):
    """Return (package, broadcaster, listener)."""
    package = next(filter(submission.has, PACKAGES), "learning_tf2")
    return package, *(f"{PACKAGES[package]}_{word}.py" for word in ("broadcaster", "listener"))


def broadcast(workspace, script, package) -> Seen:
    """Move turtle1, and record transforms."""
    with turtles(workspace) as (ros, client):
        client.listen("/tf", "tf2_msgs/TFMessage")
        # The parameter of Python's page, and the argument of the page in C++.
        program = ros.start(package, script, "_turtle:=turtle1", "turtle1")
        ros.wait_for_start(lambda: program.ended or client.count("/tf"))
        client.ask(*TELEPORT, PLACE)
        past = client.count("/tf") + 5
        ros.wait_for_start(lambda: program.ended or client.count("/tf") > past)
        return client.seen(program, "/tf")


@check("W15", "the broadcaster", "7", look="rosrun tf tf_echo /world /turtle1")
def broadcaster(submission):
    package, name, _ = names(submission)
    file, seen = recorded(submission, package, name, broadcast, package)
    expected = "frames: turtle1 in world"
    file.must_run(seen.program, expected)
    frames = seen.heard["/tf"][-1]["transforms"] if seen.heard["/tf"] else []
    given = {
        f"{frame['child_frame_id']} in {frame['header']['frame_id']}": frame for frame in frames
    }
    there, words = ", ".join(given) or "none", "frame_id" if frames else "Subscriber( subscribe"
    hint = "header.frame_id is world; child_frame_id is the turtle, as in the parameter turtle"
    is_there = "turtle1 in world" in given
    file.must(is_there, f"{words} sendTransform", expected, f"frames: {there}", hint)
    parts = given["turtle1 in world"]["transform"].values()
    place, turn = ([round(value, 2) for value in part.values()] for part in parts)
    x, y, theta = PLACE.values()
    words, hint = "translation sendTransform", "those of the pose"
    file.must(math.dist(place, (x, y, 0.0)) < NEAR, words, f"at ({x}, {y}, 0)", place, hint)
    wanted = [0.0, 0.0, round(math.sin(theta / 2), 2), round(math.cos(theta / 2), 2)]
    is_right = abs(abs(sum(a * b for a, b in zip(turn, wanted))) - 1.0) < NEAR
    hint = file.either("quaternion_from_euler(0, 0, theta)", "setRPY(0, 0, theta)")
    words = "rotation quaternion"
    file.must(is_right, words, f"at {theta} rad: {wanted}", turn, hint)


def follow(workspace, path) -> Seen:
    """Start the launch file, and move turtle1."""
    with workspace.ros_session() as ros:
        client = Client(ros)
        client.listen(SECOND, KINDS[POSE])
        program = Launch(ros, path).program
        ros.wait(lambda: program.ended or client.count(SECOND), 3 * START_S)
        if client.count(SECOND):
            client.ask(*TELEPORT, PLACE)
            ros.wait(lambda: gap(client.heard(SECOND, -1)[0][2], PLACE) < NEAR_M, FOLLOWS_S)
        return client.seen(program, SECOND)


@check("W16", "turtle2 follows", "7", needs=broadcaster, look=f"roslaunch learning_tf2 {DEMO}")
def follows(submission):
    package, broadcaster, name = names(submission)
    listener = Script(submission, package, program_of(submission, package, name))
    launch = launch_file(submission, package, DEMO)
    seen = submission.recording(follow, launch.path)
    apart_m = [gap(pose, PLACE) for pose in seen.heard[SECOND][-1:]]
    if apart_m and apart_m[0] < NEAR_M:
        return
    expected, started = "a turtle2, which comes near turtle1", [n["type"] for n in launch.nodes]
    stems, there = [Path(program).stem for program in started], ", ".join(started)
    is_whole = stems.count(Path(broadcaster).stem) > 1 and Path(name).stem in stems
    hint = "a broadcaster for each turtle, each with its parameter turtle; and the listener"
    launch.must(is_whole, f"{broadcaster} <launch", expected, f"only {there}", hint)
    listener.must_run(seen.program, expected)
    words, there, hint = "spawn Spawn", "no turtle2", "call the service spawn"
    if apart_m:
        words, there = "lookup_transform lookupTransform", f"{apart_m[0]:.1f} m apart"
        call = listener.either("lookup_transform", "buffer.lookupTransform")
        hint = f'{call}("turtle2", "turtle1", ...)'
    listener.must(False, words, expected, there, hint)
