"""Each finding of the doctor, from invented facts."""

import errno
import re
from dataclasses import replace
from pathlib import Path

import pytest

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_tools.doctor import connections, drive_chain, judgement, transforms, unmatched_topics
from tutorial_tools.doctor.facts import Facts, Joystick, Mux, MuxInput, Node, Offset, Transform
from tutorial_tools.doctor.judgement import judge

JOY, TWIST = "sensor_msgs/Joy", "geometry_msgs/Twist"
TELEOP = "/cmd_vel_mux/input/teleop"
SAFETY = "/cmd_vel_mux/input/safety_controller"
NAVI = "/cmd_vel_mux/input/navi"


def node(host="here", answer=Answer.WELL, here=True, links=()):
    return Node(f"http://{host}:1234/", host, answer, here, list(links))


# A workstation whose joystick drives a TurtleBot on another machine.
WELL = Facts(
    master_uri="http://robot:11311",
    master_host="robot",
    master_here=False,
    own_variable="ROS_IP",
    own_name="10.0.0.2",
    own_addresses=["10.0.0.2"],
    way_out="10.0.0.2",
    joysticks=[Joystick("/dev/input/js0")],
    nodes={
        "/joy_node": node("10.0.0.2", links=[("/joy", "/joy2twist")]),
        "/joy2twist": node("10.0.0.2", links=[(TELEOP, "/cmd_vel_mux")]),
        "/cmd_vel_mux": node("robot", here=False),
    },
    publishers={"/joy": ["/joy_node"], TELEOP: ["/joy2twist"]},
    subscribers={"/joy": ["/joy2twist"], TELEOP: ["/cmd_vel_mux"]},
    types={"/joy": JOY, TELEOP: TWIST, "/left": TWIST},
    clocks={"robot": Offset(0.002, "/odom")},
    muxes={
        "/cmd_vel_mux": Mux(
            "teleop",
            [MuxInput("safety", SAFETY, 10), MuxInput("teleop", TELEOP, 7), MuxInput("n", NAVI, 5)],
        )
    },
    states={"/joy2twist": (True, "driving")},
)
ARMED = {"/joy2twist": (True, "armed")}


def well(**changes):
    return replace(WELL, **changes)


def nodes(**changed):
    return well(nodes={**WELL.nodes, **{f"/{name}": value for name, value in changed.items()}})


def mux(active, inputs=WELL.muxes["/cmd_vel_mux"].inputs, **changes):
    return well(muxes={"/cmd_vel_mux": Mux(active, list(inputs))}, **changes)


def says(text):
    return well(states={"/joy2twist": (False, text)})


def frames(*sent, **changes):
    """Return Facts with transforms, each given as "NODE PARENT CHILD [LATE_S]"."""
    parts = [text.split() for text in sent]
    transforms = [Transform(*part[:3], *map(float, part[3:])) for part in parts]
    return well(transforms=transforms, **changes)


def lines(facts, level):
    return [finding.line() for finding in judge(facts) if finding.level == level]


def unreached(name, own=(), variable="", called_back=None, **changes):
    """Return Facts with an own name under which the master does not reach this machine."""
    own = {"own_name": name, "own_addresses": list(own), "own_variable": variable}
    return well(called_back=called_back, **own, **changes)


STILL = "stopped: the joystick has not changed for 3 s, it may be out of range; release"
JOY_OF_TWO = {**WELL.publishers, "/joy": ["/joy_node", "/rosbag"]}
DEAD_BAG = {**WELL.nodes, "/rosbag": node("10.0.0.2", Answer.REFUSED)}
ROBOTS = [f"/robot_{number}/cmd_vel" for number in range(1, 31)]
CLASS = dict.fromkeys(ROBOTS, TWIST)
CLASSROOM = Facts(subscribers={robot: ["/classroom"] for robot in ROBOTS}, types=CLASS)
JOY_OF_CLASS = {**CLASS, "/robot_2/joy": JOY}
LISTENING = {"/joy": ["/joy2twist"]}
SAFETY_TOO = {**WELL.types, SAFETY: TWIST}
# fmt: off
WRONG = {  # words of the only wrong line, in order: facts
    "master ... ROS_MASTER_URI=http://robot:11311 ... http://HOST:PORT ... export":
        Facts(**{**vars(WELL), "master": Answer.MALFORMED, "called_back": None}),
    'looked up ... "robot" ... /etc/hosts': well(master=Answer.UNKNOWN_NAME, called_back=None),
    "start roscore, or minimal.launch, on robot": well(master=Answer.REFUSED, called_back=None),
    "does not answer ... ping robot ... firewall": well(master=Answer.SILENT, called_back=None),
    "not of ROS ... end that program": well(master=Answer.STRANGE, called_back=None),
    "ROS_IP=10.0.0.9 is no address of this machine ... export ROS_IP=10.0.0.2":
        unreached("10.0.0.9", ["10.0.0.9"], "ROS_IP", own_is_here=False),
    "ROS_HOSTNAME=localhost is seen by this machine only ... export ROS_IP=10.0.0.2":
        unreached("localhost", ["127.0.0.1"], "ROS_HOSTNAME", called_back=False),
    'the master does not reach "desk" ... export ROS_IP=10.0.0.2 ... firewall':
        unreached("desk", ["10.0.0.2"], called_back=False),
    '/cmd_vel_mux at http://robot:1234/ ... "robot" cannot be looked up ... /etc/hosts':
        nodes(cmd_vel_mux=node("robot", Answer.UNKNOWN_NAME, None)),
    "/cmd_vel_mux at http://robot:1234/ ... has died ... rosnode cleanup":
        nodes(cmd_vel_mux=node("robot", Answer.REFUSED, False)),
    "from its own machine only ... export ROS_IP": nodes(cmd_vel_mux=node("localhost")),
    "3.2 s behind us ... chrony": well(clocks={"robot": Offset(-3.21, "/odom")}),
    "no node runs at this master: roslaunch joy2twist launch_joy_node.launch": Facts(),
    "roslaunch joy2twist student.launch name:=robot_1 ... joystick:=browser": CLASSROOM,
    "rosrun joy2twist joy2twist.py __ns:=/robot_2":
        replace(CLASSROOM, publishers={"/robot_2/joy": ["/pad"]}, types=JOY_OF_CLASS),
    "though /joy2twist drives ... release LB and the sticks": mux("idle"),
    "nobody sends /joy: rosrun joy joy_node, or: rosbag play FILE;":
        well(publishers={TELEOP: ["/joy2twist"]}, joysticks=[]),
    "nothing turns /joy into velocities ... joy2twist_turtlebot.launch":
        well(publishers={"/joy": ["/joy_node"]}, subscribers={"/joy": ["/echo"]}),
    f"nobody listens to {TELEOP} of /joy2twist ... or drive the one at /left":
        well(subscribers={"/joy": ["/joy2twist"], "/left": ["/robot"]}, muxes={}),
    f"start the robot, or drive the one at {' or '.join(ROBOTS[:5])} and 25 more":
        well(subscribers={**LISTENING, **CLASSROOM.subscribers}, types={**WELL.types, **CLASS}),
    f"{TELEOP}: /joy2twist and /cmd_vel_mux know of each other, but are not connected ... firewall":
        nodes(joy2twist=node("10.0.0.2")),
    "/rosbag at http://10.0.0.2:1234/ is registered, but has died":
        well(publishers=JOY_OF_TWO, nodes=DEAD_BAG),
    f'lets "safety" through, and not {TELEOP}: end what sends to that': mux("safety"),
    "end /bumper":
        mux("safety", publishers={**WELL.publishers, SAFETY: ["/bumper"]}, types=SAFETY_TOO),
    "/r1/robot, /r2/robot send b, odom at once ... tf_prefix":
        frames("/r1/robot a odom", "/r2/robot a odom", "/r1/robot odom b", "/r2/robot odom b"),
    "networkingMode=mirrored ... wsl --shutdown":
        unreached("desk", ["10.0.0.2"], called_back=False, wsl=True),
    "move the joystick, or start it": says("stopped: no message for 0.5 s"),
    "--device /dev/input/js1":
        well(joysticks=[Joystick("/dev/input/js1", errno.ENOENT)], container=True),
}
# fmt: on
BRIDGE = [(False, "the side of ROS 2 is missing"), (False, "/scan: a/msg/B: not carried")]
LONELY = unreached("1.2.3.4", ["1.2.3.4"], "ROS_IP", own_is_here=False, way_out="")
# robot_2 of the classroom, without a joystick
OF_TWO = replace(
    CLASSROOM,
    subscribers={**CLASSROOM.subscribers, "/robot_2/joy": ["/robot_2/joy2twist"]},
    publishers={"/robot_2/cmd_vel": ["/robot_2/joy2twist"]},
    types=JOY_OF_CLASS,
    states={"/robot_2/joy2twist": (False, "waiting for the joystick")},
)
LINES = [  # facts, level, words of a line of this level
    (well(publishers=JOY_OF_TWO, nodes=DEAD_BAG), "ok", "/joy_node -> /joy -> /joy2twist ->"),
    (well(clocks={"robot": None}), "unknown", "robot sends no stamped message: compare: date"),
    (mux(None), "unknown", "rostopic echo /cmd_vel_mux/active"),
    (Facts(joy2twist=""), "unknown", "no joy2twist is found here: call this through"),
    (Facts(workspace="/ws", joy2twist=""), "unknown", "yet: make it in /ws/src"),
    (Facts(workspace="/w", joy2twist="/w/src/joy2twist"), "ok", "is yours: /w/src/joy2twist"),
    (Facts(workspace="/w"), "wrong", "is not in your workspace: /suite/joy2twist: mv it into"),
    (Facts(hidden=[("/a hides b", "touch c")]), "wrong", "/a hides b"),
    (frames("/a odom base", "/b map x"), "unknown", "nothing joins: below map, odom: start"),
    (LONELY, "wrong", "unset ROS_IP ROS_HOSTNAME"),
    (Facts(master=Answer.REFUSED, called_back=None), "wrong", ": start roscore; or"),
    (well(bridge=BRIDGE), "wrong", "the side of ROS 2 is missing: its terminal says why"),
    (well(bridge=BRIDGE), "unknown", BRIDGE[1][1]),
    (OF_TWO, "wrong", "joy_node __ns:=/robot_2 ... FILE /joy:=/robot_2/joy ... joystick:=browser"),
    (replace(says(STILL), silent_s={"/joy_node": 12.3}), "wrong", "has been silent for 12 s"),
]


def has(line, words):
    return re.search(".*".join(map(re.escape, words.split(" ... "))), line)


@claim("Of one mistake one line says what to do")
@pytest.mark.parametrize(("words", "facts"), WRONG.items(), ids=WRONG)
def test_of_one_mistake_one_line_says_what_to_do(words, facts):
    (line,) = lines(facts, "wrong")
    assert has(line, words) and len(line) < 300, line


@claim("Its lines have levels; what is no mistake is not called one")
@pytest.mark.parametrize(("facts", "level", "words"), LINES)
def test_a_line_has_the_level_and_the_words(facts, level, words):
    assert any(has(line, words) for line in lines(facts, level))


@claim("Its lines have ...", because="what is no mistake")
@pytest.mark.parametrize("facts", [
    WELL,
    *(mux(active, states=ARMED) for active in ("idle", "n")),
    mux("Teleoperation", [], states=ARMED),
    well(clocks={"robot": Offset(0.1, "/odom")}),
    well(use_sim_time=True, clock_ticks=True, clocks={"robot": Offset(99.0, "/odom")}),
    well(nodes={name: WELL.nodes[name] for name in ("/joy_node", "/cmd_vel_mux")}),
    frames("/one odom base 0.3", "/one base wheel", "/two map odom"),
    frames("/bag odom base 3600", use_sim_time=True, clock_ticks=True),
    frames(*(f"/class r{n}/odom r{n}/base" for n in (1, 2))),
])  # fmt: skip
def test_what_is_no_mistake(facts):
    assert lines(facts, "wrong") == []
    assert {finding.level for finding in judge(WELL)} == {"ok"}


def test_of_a_graph_that_was_not_seen_nothing_is_said():
    abouts = {finding.about for finding in judge(well(master=Answer.REFUSED, called_back=None))}
    assert abouts == {"environment", "overlay", "master", "address", "joystick"}


def test_no_way_leads_through_a_dead_node():
    through_dead = nodes(joy2twist=node("10.0.0.2", Answer.REFUSED))
    assert not [line for line in lines(through_dead, "ok") if " -> " in line]


@claim("Its README lists what is looked at")
def test_the_readme_lists_what_is_looked_at():
    package = Path(judgement.__file__).resolve().parents[3]
    modules = (judgement, drive_chain, transforms, connections, unmatched_topics)
    source = "".join(Path(module.__file__).read_text() for module in modules)
    looked_at = set(re.findall(r'\b(?:ok|wrong|unknown)\("(\w+)"', source))
    section = (package / "README.md").read_text().split("## When nothing moves")[1].split("##")[0]
    assert set(re.findall(r"^\| `(\w+)` \|", section, re.M)) == looked_at
