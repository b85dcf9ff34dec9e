"""Graphs of nodes, each with the doctor's lines about it; none contradicts another."""

import re
from collections import defaultdict
from dataclasses import replace

import pytest

from node_kit.rules.answer import Answer
from tutorial_testing.claims import claim
from tutorial_tools.doctor.facts import Facts, Mux, MuxInput, Node, Stray
from tutorial_tools.doctor.judgement import judge

pytestmark = claim(
    "Of any graph, with a joystick or without, it says what fits and is missing, in lines that do "
    "not contradict each other"
)
TYPES = {
    "Joy": "sensor_msgs/Joy", "Twist": "geometry_msgs/Twist", "String": "std_msgs/String",
    "Int32": "std_msgs/Int32", "Odometry": "nav_msgs/Odometry", "Scan": "sensor_msgs/LaserScan",
    "Log": "rosgraph_msgs/Log", "TF": "tf2_msgs/TFMessage", "Pose": "turtlesim/Pose",
    "Clock": "rosgraph_msgs/Clock", "Diagnostics": "diagnostic_msgs/DiagnosticArray",
    "Empty": "std_msgs/Empty", "Goal": "actionlib_msgs/GoalID", "Sound": "kobuki_msgs/Sound",
    "Point": "geometry_msgs/PointStamped", "Num": "mine/Num", "*": "*",
}  # fmt: skip


def graph(text, cut=(), **changes):
    """Return Facts of a graph: "/a > /topic Type, /b < /topic Type". Ends of a type are connected,
    except for those in cut: "/sender /topic /receiver".
    """
    ends = {True: defaultdict(dict), False: defaultdict(dict)}  # {inwards: {node: {topic: type}}}
    topics = {True: defaultdict(list), False: defaultdict(list)}
    for node, way, topic, kind in (end.split() for end in text.split(", ") if end):
        ends[way == "<"][node][topic] = TYPES[kind]
        topics[way == "<"][topic].append(node)
    nodes = {}
    for node in {*ends[True], *ends[False]}:
        links = [
            (topic, other)
            for topic, kind in ends[False][node].items()
            for other in topics[True][topic]
            if ends[True][other][topic] in (kind, "*") and f"{node} {topic} {other}" not in cut
        ]
        here = ("http://localhost:1234/", "localhost", Answer.WELL, True)
        nodes[node] = Node(*here, links, ends[False][node], ends[True][node])
    facts = Facts(nodes=nodes, publishers=topics[False], subscribers=topics[True])
    # Like the master: the type of the topic's last sender.
    types = [(t, kind) for way in (True, False) for own in ends[way].values()
             for t, kind in own.items()]  # fmt: skip
    return replace(facts, types=dict(types), **changes)


ROBOT = "/robot < /cmd_vel Twist, /robot > /odom Odometry, /robot > /tf TF, /robot > /scan Scan"
PAD = "/joy_node > /joy Joy, /joy2twist < /joy Joy, /joy2twist > /cmd_vel Twist"
TALK = "/talker > /chatter String, /listener < /chatter String"
TURTLE = "/turtlesim < /turtle1/cmd_vel Twist, /turtlesim > /turtle1/pose Pose"
LOG = "/talker > /rosout Log, /rosout < /rosout Log, /rosout > /rosout_agg Log"
KOBUKI = (
    "/mobile_base < /mobile_base/commands/velocity Twist, /mobile_base < "
    "/mobile_base/commands/sound Sound, /mux > /mobile_base/commands/velocity Twist, "
    "/mux < /mux/input/teleop Twist, /mux < /mux/input/navi Twist, /mux > /mux/active String, "
    "/mobile_base > /mobile_base/debug/raw String, /mobile_base > /mobile_base/info Sound, "
    "/mobile_base < /mobile_base/commands/info Sound"
)
MUX = {"/mux": Mux("idle", [MuxInput("t", "/mux/input/teleop", 7)])}
RVIZ = "/rviz_1 < /map Scan, /rviz_1 > /initialpose Point, /rviz_1 < /scan2 Scan"
OLD = {("/num", "/talker"): ("aaaaaaaabbbb", "ccccccccdddd")}
SAME = {("/num", "/talker"): ("aaaaaaaabbbb", "aaaaaaaabbbb")}
NUMBERS = ("/talker > /num Num, /listener < /num Num", ("/talker /num /listener",))
WELL = "-"  # no line is wrong or unknown
ROWS = [  # name, facts, parts of the lines that are wrong or unknown
    ("nothing", graph(""), "wrong ... no node runs at this master: roslaunch joy2twist"),
    ("RViz alone", graph(f"{RVIZ}, /rosout < /rosout Log"),
     "wrong ... no node runs at this master but /rosout, /rviz_1: roslaunch ||unknown  joystick"),
    ("a recording alone", graph("/rosbag > /odom Odometry, /rosout < /rosout Log"), WELL),
    ("talker and listener", graph(f"{TALK}, {LOG}"), WELL),
    ("a robot that is driven", graph(f"{ROBOT}, {PAD}"), WELL),
    ("a turtle with keys", graph(f"{TURTLE}, /keys > /turtle1/cmd_vel Twist"), WELL),
    ("keys of a Kobuki", graph(f"{KOBUKI}, /keys > /mux/input/teleop Twist", muxes=MUX), WELL),
    ("a recording and RViz", graph(f"{RVIZ}, /play_1 > /odom Odometry, /play_1 > /x String"), WELL),
    ("all tools",
     graph(f"{ROBOT}, {PAD}, {RVIZ}, /cockpit < /joy Joy, /cockpit > /joy_web Joy, "
           "/record_1 < /cmd_vel *, /record_1 < /nowhere *, /rqt_gui < /foo Int32, "
           "/robot > /diagnostics Diagnostics, /sim > /clock Clock, /robot < /initialpose Point"),
     WELL),
    ("echo", graph(f"{TALK}, /rostopic_1 < /chatter *"), WELL),
    ("an action's server", graph("/fib < /fib/cancel Goal, /fib < /fib/goal Goal"), WELL),
    ("a String on /cmd_vel", graph(f"{ROBOT}, /rostopic_1 > /cmd_vel String"),
     "wrong    types ... /cmd_vel: std_msgs/String comes from /rostopic_1, geometry_msgs/Twist"
     " is wanted by /robot: no message arrives"),
    ("a String on /joy",
     graph(f"{ROBOT}, /joy2twist < /joy Joy, /joy2twist > /cmd_vel Twist, /pub > /joy String",
           states={"/joy2twist": (False, "waiting for the joystick")}),
     "wrong    types ... /joy: std_msgs/String comes from /pub, sensor_msgs/Joy is wanted by ||"
     "wrong    state ... /joy2twist says: waiting for the joystick ||"
     "unknown  joystick"),
    ("a String beside the right one", graph(f"{ROBOT}, {PAD}, /pub > /cmd_vel String"),
     "wrong    types ... /cmd_vel: std_msgs/String comes from /pub, geometry_msgs/Twist is"),
    ("another definition", graph(*NUMBERS, definitions=OLD),
     "wrong    types ... /num: /talker has another definition of mine/Num (md5 aaaaaaaa) than this"
     " terminal (md5 cccccccc), and does not reach /listener: build both workspaces"),
    ("not connected", graph(*NUMBERS, definitions=SAME),
     "wrong    topics ... /num: /talker and /listener know of each other, but are not connected"
     ": restart both; if that does not help, build again what has mine/Num"),
    ("a talker alone", graph("/talker > /chatter String"),
     "unknown  topics ... nobody listens to /chatter (/talker): start what needs it"),
    ("a listener alone", graph("/listener < /chatter String"),
     "unknown  topics ... nobody sends what is wanted: /chatter (/listener)"),
    ("many halves",
     graph(", ".join(f"/a > /{n}_sent String, /b < /wanted_{n} Int32" for n in "abc")),
     "unknown ... nobody listens to /a_sent (/a), /b_sent (/a), /c_sent (/a) ||"
     "unknown ... nobody sends what is wanted: /wanted_a (/b), /wanted_b (/b), /wanted_c (/b)"),
    ("a misspelt name", graph("/talker > /chater String, /listener < /chatter String"),
     "wrong    topics ... nobody listens to /chater of /talker, and nobody sends /chatter of the"
     " same type, which /listener wants: start /talker with /chater:=/chatter"),
    ("no remap", graph(f"{TURTLE}, /keys > /cmd_vel Twist"),
     "wrong ... nobody listens to /cmd_vel of /keys ... with /cmd_vel:=/turtle1/cmd_vel"),
    ("a turtle alone", graph(TURTLE),
     "wrong ... nobody drives /turtlesim, by /turtle1/cmd_vel: rosrun turtlesim turtle_tele ||"
     "unknown  joystick"),
    ("a robot alone", graph(ROBOT),
     "wrong ... nobody drives /robot, by /cmd_vel: roslaunch joy2twist launch_joy_node.launch ||"
     "unknown  joystick"),
    ("a recording without a joystick",
     graph(f"{ROBOT}, /joy2twist < /joy Joy, /joy2twist > /cmd_vel Twist, /rosbag > /o Odometry"),
     "wrong ... nobody sends /joy: the recording of /rosbag does not have it: rosbag info ||"
     "unknown  joystick"),
    ("a gamepad that nothing needs", graph(f"{TURTLE}, /k > /turtle1/cmd_vel Twist, /j > /joy Joy"),
     "unknown  topics ... nobody listens to /joy (/j)"),
    ("a master that was restarted", graph("", strays=[Stray("/robot", 7), Stray("/joy_node", 8)]),
     "wrong    nodes ... unknown to the master, which was restarted meanwhile: /joy_node (process"
     " 8), /robot (process 7): restart them, after roscore"),
    ("a master that has exited", graph("", strays=[Stray("/robot", 7)], master=Answer.REFUSED),
     "wrong    master ||"
     "wrong    nodes ... running here, but of a master that has exited: /robot (process 7) ||"
     "unknown  joystick"),
    ("two masters", graph(TALK, strays=[Stray("/robot", 7, "http://localhost:11312")]),
     "unknown  nodes ... with the master http://localhost:11312: /robot: to join them: export"),
]  # fmt: skip


def has(line, words):
    return re.search(".*".join(map(re.escape, words.strip().split(" ... "))), line)


@pytest.mark.parametrize(
    ("facts", "words"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_a_graph_has_its_sentence_and_no_other(facts, words):
    findings = judge(facts)
    lines = [f.line() for f in findings if f.level != "ok"]
    if facts.master is Answer.WELL and not facts.nodes:
        lines = [line for line in lines if "joystick  " not in line]  # there is no joystick either
    expected = [] if words == WELL else words.split("||")
    assert len(lines) == len(expected), lines
    assert all(map(has, lines, expected)), lines
    assert all(len(line) < 300 for line in lines)
    contradict([f.seen for f in findings if f.level == "ok"], [f.seen for f in findings])


def contradict(well, every):
    """Check that no topic that lacks something is part of a good path, and no line comes twice."""
    lacks = {
        t for seen in every for t in re.findall(r"nobody (?:sends|listens to) (/\S+?)[ ,]", seen)
    }
    ways = {t for seen in well for t in re.findall(r"-> (/\S+) ->", seen)}
    sent = {t for seen in every for t in re.findall(r"(/\S+) is sent by", seen)}
    assert not lacks & (ways | sent), every
    unregistered = any("unknown to the master" in seen for seen in every)
    assert not (unregistered and any(re.match(r"all \d+ answer", seen) for seen in well))
    assert len(set(every)) == len(every)


def test_of_a_graph_without_a_joystick_a_line_shows_what_is_connected():
    (line,) = [f.line() for f in judge(graph(f"{TALK}, {LOG}")) if f.about == "topics"]
    assert line == "ok       topics       /talker -> /chatter -> /listener"
    assert not [f for f in judge(graph(TALK)) if f.about == "joystick"]
