"""Exercises 3 to 6: turtlesim's background, a turtle that mimics, a goal, a bag."""

import math
from contextlib import contextmanager

from tutorial_check import (
    CannotCheck,
    Client,
    Launch,
    Seen,
    Wrong,
    check,
    last_lines,
    launch_file,
    package_of,
    recorded,
)

PACKAGE = "beginner_tutorials"
POSE, COMMAND, START_S = "/turtle1/pose", "/turtle1/cmd_vel", 8.0
KINDS = {POSE: "turtlesim/Pose", COMMAND: "geometry_msgs/Twist"}
# If the real turtlesim is installed, it draws with Qt.
TURTLESIM = ["env", "QT_QPA_PLATFORM=offscreen", "rosrun", "turtlesim", "turtlesim_node"]
MIMIC = "turtlemimic.launch"
RGB, SENSOR = {"r": 10, "g": 200, "b": 30}, "/turtle1/color_sensor"
LEADER, FOLLOWER = "/turtlesim1/turtle1", "/turtlesim2/turtle1"
ARC = {"linear": {"x": 2.0}, "angular": {"z": -1.8}}
NEAR_M = 0.3  # the second turtle starts a moment later
CLEANER = "turtlesim_cleaner"
GOALS = ((9.0, 8.0), (2.0, 4.0), (8.0, 2.5))
TOLERANCE_M, NEARLY_M, LONGEST_S = 0.3, 0.35, 12.0
# The goal, on standard input as on the wiki's page, and as parameters.
TYPED = 'printf "%s\\n%s\\n%s\\n" "$1" "$2" "$3" | "$4" "_x:=$1" "_y:=$2" "_tolerance:=$3"'
RECORD = f"rosbag record -O subset {COMMAND} {POSE}, while turtle_teleop_key drives; Ctrl-C"
LEAST_M, LONGEST_BAG_S = 0.5, 120.0


@contextmanager
def turtles(workspace, *words):
    """Yield a RosSession with turtlesim, and a Client that listens to turtle1."""
    with workspace.ros_session() as ros:
        client = Client(ros)
        ros.launch([*TURTLESIM, *words], trusted=True)
        client.listen(POSE, KINDS[POSE])
        if not ros.wait(lambda: client.count(POSE), START_S):
            raise CannotCheck("turtlesim does not start")
        yield ros, client


def moves(client, topic=POSE):
    """Return whether a turtle has moved within the last second."""
    newest = client.heard(topic, -62)
    return any(pose["linear_velocity"] or pose["angular_velocity"] for *_, pose in newest)


def gap(pose, other):
    """Return the distance between two poses, or places [m]."""
    return math.dist((pose["x"], pose["y"]), (other["x"], other["y"]))


def length(poses):
    """Return the length of a path [m]."""
    return sum(map(gap, poses, poses[1:]))


def change(workspace, script) -> Seen:
    """Start the program beside turtlesim."""
    with turtles(workspace) as (ros, client):
        program = ros.start(PACKAGE, script, *map(str, RGB.values()))
        ros.wait_for_start(lambda: program.ended)
        client.listen(SENSOR, "turtlesim/Color")
        ros.wait(lambda: client.count(SENSOR), START_S)
        return client.seen(program, SENSOR, answers=[client.parameter("/turtlesim")])


@check("W8", "the background changes", "3", look="rosparam get /turtlesim/background_r")
def background(submission):
    file, seen = recorded(submission, PACKAGE, "background.py", change)
    given = {color: seen.answers[0].get(f"background_{color}") for color in RGB}
    expected = f"/turtlesim/background_r, _g and _b are {RGB}"
    file.must_run(seen.program, expected, may_end=True)
    number = file.either("int(sys.argv[1])", "std::atoi(argv[1])")
    hint = f"a number, {number}, as /turtlesim/background_r, not as /background_r"
    file.must(given == RGB, "set_param setParam param::set", expected, given, hint)
    color, words = seen.heard[SENSOR][0], "ServiceProxy( serviceClient< set_param"
    hint = "turtlesim reads them when its service clear is called, so call it after that"
    file.must(color == RGB, words, f"turtle1 sees {RGB}", color, hint)


def launch_mimic(workspace, path) -> Seen:
    """Start the launch file, and drive the first turtle."""
    with workspace.ros_session() as ros:
        client, topics = Client(ros), (f"{LEADER}/pose", f"{FOLLOWER}/pose")
        for topic in topics:
            client.listen(topic, KINDS[POSE])
        client.advertise(f"{LEADER}/cmd_vel", KINDS[COMMAND])
        launch = Launch(ros, path)
        ros.wait(lambda: launch.is_over or all(map(client.count, topics)), 3 * START_S)
        if client.meet(launch.program, f"{LEADER}/cmd_vel"):
            client.send(f"{LEADER}/cmd_vel", ARC)
            ros.wait(lambda: moves(client, topics[0]), START_S)
            ros.wait(lambda: not any(moves(client, topic) for topic in topics), START_S)
        return client.seen(launch.program, *topics)


@check("W9", "turtlemimic.launch", "4", look=f"roslaunch --nodes {PACKAGE} {MIMIC}")
def mimic_file(submission):
    file = launch_file(submission, PACKAGE, MIMIC)
    spaces = sorted(node["namespace"] for node in file.nodes if node["type"] == "turtlesim_node")
    hint = '<group ns="turtlesim1"> around one node, <group ns="turtlesim2"> around the other'
    expected, is_right = "turtlesims in two groups", spaces == ["/turtlesim1/", "/turtlesim2/"]
    file.must(is_right, "ns= turtlesim_node <launch", expected, " and ".join(spaces), hint)
    remaps = [pair for node in file.nodes if node["type"] == "mimic" for pair in node["remaps"]]
    given = {old.rpartition("/")[2]: f"/{new.strip('/')}" for old, new in remaps}
    for old, new in (("input", LEADER), ("output", FOLLOWER)):
        hint = f'<remap from="{old}" to="{new[1:]}"/> within the <node> of mimic'
        words, there = f'"{old}" "mimic" <launch', given.get(old, "not remapped")
        file.must(there == new, words, f"{old} is {new}", there, hint)


@check("W10", "the second mimics the first", "4", needs=mimic_file,
       look=f"rostopic echo {FOLLOWER}/pose")  # fmt: skip
def mimics(submission):
    file = launch_file(submission, PACKAGE, MIMIC)
    seen = submission.recording(launch_mimic, file.path)
    first, second = seen.heard.values()
    file.must(first and second, "", "two turtles", last_lines(seen.program.output))
    apart_m, words = gap(first[-1], second[-1]), 'cmd_vel <remap "mimic"'
    is_right, there = apart_m < NEAR_M and length(first), f"{apart_m:.1f} m apart"
    file.must(is_right, words, "both drive the same arc", there)


def drive(workspace, script, x: float, y: float) -> Seen:
    """Start the program with a goal, and wait until the turtle rests."""
    with turtles(workspace) as (ros, client):
        words = ["bash", "-c", TYPED, "bash", *map(str, (x, y, TOLERANCE_M))]
        program = ros.launch([*words, *workspace.command(CLEANER, script)])
        ros.wait_for_start(lambda: program.ended or moves(client))
        ros.wait(lambda: not moves(client), LONGEST_S)
        return client.seen(program, POSE)


@check("W11", "it reaches the goal, and rests", "5", look=f"rostopic echo {POSE}")
def reaches(submission):
    for x, y in GOALS:
        file, seen = recorded(submission, CLEANER, "gotogoal.py", drive, x, y)
        path, expected = seen.heard[POSE], f"turtle1 comes within {TOLERANCE_M} m of ({x}, {y})"
        gaps = [gap(pose, {"x": x, "y": y}) for pose in path]
        others = [topic for topic in seen.types if "cmd_vel" in topic and topic != COMMAND]
        words, there = "Publisher( advertise<", f"it publishes on {others}"
        file.must(not others, words, expected, there, COMMAND)
        if not length(path):
            file.must_run(seen.program, expected)
            hint = file.either(
                "publish in the loop", "callbacks run in ros::spinOnce(), in the loop"
            )
            file.must(False, "while publish(", expected, "turtle1 does not move", hint)
        near = next((k for k, gap_m in enumerate(gaps) if gap_m < NEARLY_M), 0)
        hint = "atan2(goal y - y, goal x - x) - theta is the angle to turn by"
        file.must(near, "atan2( angular.z", expected, f"only {min(gaps):.1f} m", hint)
        way, expected = length(path[:near]), f"a way of {gaps[0]:.0f} m or so"
        hint = "from -pi to pi it is the short way round; and no faster than it turns"
        file.must(way < 2.5 * gaps[0], "angular.z", expected, f"{way:.0f} m", hint)
        *_, speed, turn = path[-1].values()
        rests, hint = not (speed or turn), f"once it is there, publish {file.idioms.zero}"
        there = f"{gaps[-1]:.1f} m from it, {speed:.1f} m/s, {turn:.1f} rad/s"
        is_right, expected = rests and gaps[-1] < 2 * TOLERANCE_M, f"at rest at ({x}, {y})"
        file.must(is_right, "while publish(", expected, there, hint)


def play(workspace, path) -> Seen:
    """Play a bag to a turtle. path: within src."""
    with turtles(workspace, f"{COMMAND}:=/played{COMMAND}") as (ros, client):
        for topic, kind in KINDS.items():
            client.listen(f"/played{topic}", kind)
        words = ["rosbag", "play", "--delay=1", "--prefix=/played", str(workspace.source / path)]
        program = ros.launch(words)
        ros.wait(lambda: program.ended, LONGEST_BAG_S)
        ros.wait(lambda: not moves(client), 3.0)
        return client.seen(program, POSE, *(f"/played{topic}" for topic in KINDS))


@check("W13", "a recording that drives a turtle", "6", look="rosbag info subset.bag")
def recording(submission):
    bags = package_of(submission, PACKAGE).folder.rglob("*.bag")
    best = sorted(bags, key=lambda path: (path.stem != "subset", path))
    if not best:
        raise Wrong(f"a recording in {PACKAGE}, as bagfiles/subset.bag", "none", hint=RECORD)
    name = str(best[0].relative_to(submission.source))
    seen = submission.recording(play, name)
    for topic, kind in KINDS.items():
        if not seen.heard[f"/played{topic}"]:
            there = last_lines(seen.program.output) if "Error" in seen.program.output else "none"
            raise Wrong(f"messages of {topic} ({kind})", there, name, RECORD)
    way = length(seen.heard[POSE])
    if way < LEAST_M:
        hint = "keys go to the terminal of turtle_teleop_key, while rosbag records in another one"
        raise Wrong(f"the turtle drives {LEAST_M} m or more", f"{way:.1f} m", name, hint)
    return f"{way:.1f} m"
