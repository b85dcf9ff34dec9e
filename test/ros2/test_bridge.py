"""The bridge with the tutorial's class in ROS 2, on the simulated robot of ROS 1."""

import json
import os
import signal
import time
from pathlib import Path

import pytest
import rosnode
import rospy
from drive import CLASS, RATE, REPOSITORY, REST_S, moves, stands_after
from geometry_msgs.msg import Twist
from kobuki_msgs.msg import BumperEvent
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image, Joy
from std_msgs.msg import String

from node_kit.raw_messages import senders, subscribe
from tutorial_testing.processes import descendants
from tutorial_testing.waiting import wait_for

RECORDING = REPOSITORY / "common/gamepad/bag/joy.bag"
PEER, DRIVER = (Path(__file__).with_name(name) for name in ("peer.py", "driver.py"))
BRIDGE = "/ros2_bridge"
SECONDS = float(os.environ.get("TUTORIAL_ROS2_SECONDS", "8"))  # the bare machines have 60
WITHOUT_SCREEN = ("rviz:=false", "cockpit:=false", "model:=false")
HOSTILE = "\u00e4 { } %s \\ \n <script>"  # without \0, which ends a text of ROS 2


def heard_twists(ear_):
    return [
        (message.linear.x, message.angular.z)
        for _, sender, message in ear_.heard
        if sender == BRIDGE
    ]


def is_in_order(twists, joys):
    """Whether each Twist is that of a Joy, in their order and equal to the bit."""
    rest = iter(joys)
    return all(twist in rest for twist in twists)


def latching(twists):
    """[(velocity, "1" if its connection latches)]"""
    heard = [message for _, _, message in twists.heard]
    return [(each.linear.x, each._connection_header["latching"]) for each in heard]


def doctor_says(start):
    program = start("rosrun", "tutorial_tools", "doctor.py")
    program.wait()
    assert "Traceback" not in program.output
    return program.output


def wait_for_doctor(start, line):
    """Wait until the doctor says it: what it knows of the bridge comes each half second."""
    wait_for(lambda: line in " ".join(doctor_says(start).split()), f"doctor's {line}")


@pytest.fixture
def class_drives(bridge, start_ros2, robot, ear, stick):
    """(bridge, the program of ROS 2, odometry, velocities, stick), and the robot drives."""
    twists = ear("/cmd_vel", Twist)
    made = bridge()
    program = start_ros2(CLASS)
    stick.wait_for_listener().begin()
    wait_for(lambda: moves(robot), "a robot that drives")
    return made, program, robot, twists, stick


def test_every_joy_becomes_one_twist_equal_to_the_bit(class_drives, tmp_path, bridge, start):
    """One after the other, without an age limit: so none is late on a busy machine."""
    made, _, robot, twists, stick = class_drives
    assert stands_after(robot, stick.end()) < REST_S
    made.program.interrupt()
    made.program.wait()
    list_ = tmp_path / "topics.yaml"
    list_.write_text("topics: {/joy: {direction: to_ros2}, /cmd_vel: {direction: to_ros1}}")
    bridge(list_)

    def arrives(speed):
        sent = stick.push(0.5, speed)
        return heard_twists(twists)[-1:] == [sent]

    wait_for(lambda: arrives(0.25), "a Twist through the new bridge")
    stick.push(0.5, 0.125)
    wait_for(lambda: heard_twists(twists)[-1:] == stick.sent[-1:], "the last one of the beginning")
    first = len(heard_twists(twists))
    for number in range(int(RATE * SECONDS)):
        stick.push(0.001 * number, 0.002 * number)
        wait_for(lambda: len(heard_twists(twists)) > first + number, f"Twist {number}")  # noqa: B023
    assert heard_twists(twists)[first:] == stick.sent[-int(RATE * SECONDS) :]
    wait_for_doctor(start, "bridge carries between ROS 1 and ROS 2")


def test_the_recording_drives_the_robot(bridge, start, start_ros2, robot, ear):
    """A velocity that waits gives way to the next one, as the list says; most do not wait."""
    joys, twists = ear("/joy", Joy), ear("/cmd_vel", Twist)
    bridge()
    start_ros2(CLASS)
    play = start("rosbag", "play", "--loop", "--quiet", RECORDING)
    wait_for(lambda: joys.heard, "a first Joy")
    wait_for(lambda: moves(robot), "a robot that drives")
    begun = len(joys.heard)
    wait_for(lambda: time.monotonic() - joys.heard[0][0] > SECONDS, "the recording", SECONDS + 10)
    for pid in (*descendants(play.pid), play.pid):
        os.kill(pid, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S
    heard = heard_twists(twists)
    assert is_in_order(heard, [(joy.axes[1], joy.axes[0]) for _, _, joy in joys.heard])
    assert len(heard) > 0.5 * (len(joys.heard) - begun)


@pytest.mark.parametrize("side", ["ROS 1", "ROS 2"])
def test_a_side_that_is_killed_stops_the_robot_and_comes_back(class_drives, side):
    made, _, robot, _, _ = class_drives
    pid = made.send(side, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S
    line = f"bridge: the side of {side} has ended (signal 9): it is started anew"
    wait_for(lambda: line in made.output, "the line about it")
    assert made.process(side) != pid
    wait_for(lambda: moves(robot), "a robot that drives again")
    assert "Traceback" not in made.output


def test_the_launch_file_has_the_bridge_in_place_of_joy2twist(start, ear):
    """The two commands of the page on ROS 2."""
    odometry = ear("/odom", Odometry)
    start("roslaunch", "joy2twist", "launch_bag.launch", "ros2:=true", *WITHOUT_SCREEN)
    start(REPOSITORY / "tutorial", "ros2", "new_joy2twist")
    wait_for(lambda: odometry.heard and moves(odometry), "a robot that drives")
    assert "/myjoystick2twist" not in rosnode.get_node_names()


def test_a_program_that_is_killed_stops_the_robot(class_drives):
    _, program, robot, _, _ = class_drives
    os.kill(program.pid, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S


def test_ctrl_c_of_the_class_ends_with_zeros(class_drives):
    _, program, robot, twists, _ = class_drives
    program.interrupt()
    assert program.wait() == 0, program.output
    wait_for(lambda: heard_twists(twists)[-1] == (0.0, 0.0), "a zero")
    assert "Traceback" not in program.output
    assert stands_after(robot, time.monotonic()) < REST_S


@pytest.mark.parametrize("side", ["ROS 1", "ROS 2"])
def test_what_waited_for_a_suspended_side_does_not_move_the_robot(class_drives, side, start):
    made, _, robot, twists, stick = class_drives
    made.send(side, signal.SIGSTOP)
    time.sleep(1.5)  # longer than a velocity or a Joy may be old; the robot stands by then
    stick.end()
    if side == "ROS 2":
        wait_for_doctor(start, "bridge the side of ROS 2 is missing: its terminal")
    before = len(heard_twists(twists))
    made.send(side, signal.SIGCONT)

    def has_passed():
        stick.push(0.0, 0.0)
        return (0.0, 0.0) in heard_twists(twists)[before:]

    wait_for(has_passed, "a zero, which comes after all that waited")
    late = [pair for pair in heard_twists(twists)[before:] if any(pair)]
    assert len(late) <= RATE * 0.5  # those of the last half second, which the Joys may be old
    wait_for(lambda: not moves(robot), "a robot that stands")


def test_no_velocity_is_latched_and_drivers_of_any_quality_are_carried_in_turn(
    bridge, start_ros2, ear, tmp_path
):
    """First as our list has /cmd_vel, with an age limit; then without one."""
    list_ = tmp_path / "topics.yaml"
    list_.write_text("topics: {/cmd_vel: {direction: to_ros1}}")
    twists, kept = ear("/cmd_vel", Twist), "transient_local"
    for topics in (None, list_):
        made = bridge(topics)
        for number, quality in enumerate(
            (
                (kept, "reliable"), ("volatile", "reliable"), ("volatile", "best_effort"),
                (kept, "best_effort"), ("volatile", "reliable"),
            ), 1
        ):  # fmt: skip
            driver = start_ros2(DRIVER, *quality, number)
            now = [(number, "1" if topics and kept in quality else "0")]
            wait_for(lambda now=now: latching(twists)[-1:] == now, f"{quality} of {topics}")
            driver.interrupt()
            driver.wait()
        made.program.interrupt()
        made.program.wait()
        assert topics or {latch for _, latch in latching(twists)} == {"0"}


QUALITIES = '''
import sys; sys.path.insert(0, sys.argv[1])
from rclpy.qos import DurabilityPolicy as D, QoSProfile, ReliabilityPolicy as R
from ros2_side import Frame, Ros2Side, Route, fitting
kept, plain = (QoSProfile(depth=1, durability=d) for d in (D.TRANSIENT_LOCAL, D.VOLATILE))
loose = QoSProfile(depth=1, reliability=R.BEST_EFFORT)
for limit_s, is_own_kept, *offered in (
    (0.0, 0, kept), (0.0, 0, kept, plain), (0.5, 0, kept), (0.0, 1, kept), (0.0, 0, plain, loose),
):
    made = fitting(Route("/a", "both", 1, limit_s), offered, is_own_kept)
    print(made.durability.name, made.reliability.name)

class Node(Ros2Side):
    """Only counts what it makes."""
    def __init__(self):
        self.node, self._publishers, self.made = self, {}, []
    def _class(self, topic, kind): return kind
    def destroy_publisher(self, publisher): self.made.append("ended")
    def create_publisher(self, kind, topic, profile):
        self.made.append(profile.durability.name)
        return self.made
node = Node()
for latches in (False, True, False, True):  # two senders in turn
    node._publisher(Frame("/a", "b/msg/C", b"", 0.0, latches), Route("/a", "to_ros2"))
print(*node.made)
'''


def test_the_quality_of_service_of_subscriptions_and_publishers(start_ros2):
    """All publishers are heard; with an age limit, or what this node keeps, nothing old is.

    A publisher is not made anew for each message of senders of which only one latches.
    """
    sources = REPOSITORY / "common/ros2_bridge/src/ros2_bridge"
    program = start_ros2("-c", QUALITIES, sources)
    assert program.wait() == 0, program.output
    wanted = ["TRANSIENT_LOCAL", "VOLATILE", "VOLATILE", "VOLATILE", "VOLATILE"]
    lines = [f"{each} RELIABLE" for each in wanted[:-1]] + ["VOLATILE BEST_EFFORT"]
    assert program.output.splitlines() == [*lines, "VOLATILE ended TRANSIENT_LOCAL"]


def test_the_first_message_of_a_connection_is_known_and_who_is_connected():
    heard, old = [], rospy.Publisher("/old", String, queue_size=10, latch=True)
    old.publish("old")
    subscriber = subscribe("/old", heard.append, 10)
    wait_for(lambda: heard, "what was latched")
    old.publish("new")
    wait_for(lambda: len(heard) == 2, "a second message")
    assert [(raw.is_latched, raw.is_first) for raw in heard] == [(True, True), (True, False)]
    assert senders(subscriber) == {rospy.get_name()}
    old.unregister()
    wait_for(lambda: not senders(subscriber), "an end of the connection")
    subscriber.unregister()


def test_the_newest_message_of_any_type_is_carried(bridge, start, start_ros2, ear, tmp_path):
    """Latched both ways, ten megabytes, a type that one side lacks, one that changes."""
    topics = {f"/{name}": "to_ros2" for name in ("note", "picture", "bumper", "changing")}
    topics["/reply"] = "to_ros1"
    list_ = tmp_path / "topics.yaml"
    list_.write_text(json.dumps({"topics": {one: {"direction": topics[one]} for one in topics}}))
    note = rospy.Publisher("/note", String, queue_size=1, latch=True)
    note.publish(HOSTILE)
    made = bridge(list_)
    bumper = rospy.Publisher("/bumper", BumperEvent, queue_size=1, latch=True)
    bumper.publish(BumperEvent(1, 1))
    wait_for(lambda: "ROS 2 has no such type here" in made.output, "a line")
    assert made.output.count("kobuki_msgs/msg/BumperEvent") == 1
    wait_for_doctor(start, "/bumper: kobuki_msgs/msg/BumperEvent: ROS 2 has no such")
    peer = start_ros2(PEER)  # late: what was latched has been sent long ago
    reply = ear("/reply", String)
    wait_for(lambda: reply.heard, "the note, and back")
    assert reply.last.data == HOSTILE
    assert reply.heard[0][1] == BRIDGE
    picture = rospy.Publisher("/picture", Image, queue_size=1, latch=True)
    picture.publish(Image(height=1, width=10_000_000, data=bytes(10_000_000)))
    wait_for(lambda: "picture 10000000" in peer.output, "ten megabytes")
    changing = rospy.Publisher("/changing", String, queue_size=1, latch=True)
    changing.publish("one")
    wait_for(lambda: "changing one" in peer.output, "the text")
    changing.unregister()
    other = rospy.Publisher("/changing", Twist, queue_size=1, latch=True)
    other.publish(Twist())
    line = "/changing is now geometry_msgs/msg/Twist in ROS 1"
    wait_for(lambda: line in made.output, "a line")
    note.publish("and on")
    wait_for(lambda: reply.last.data == "and on", "a note after all that")
    assert "Traceback" not in made.output


def test_a_topic_of_both_directions_has_no_echo(bridge, start_ros2, ear):
    bridge()
    programs = REPOSITORY / "common/ros2_tutorials/ros2_tutorials"
    start_ros2(programs / "talker.py")
    listener = start_ros2(programs / "listener.py")
    chatter = ear("/chatter", String)
    publisher = rospy.Publisher("/chatter", String, queue_size=10)
    wait_for(lambda: len(chatter.heard) > 20, "a talker of ROS 2")

    def is_heard():
        publisher.publish("ready?")
        return "ready?" in listener.output

    wait_for(is_heard, "a way to the listener")
    for number in range(20):
        publisher.publish("the same again")
        publisher.publish(f"from here {number}.")
        wait_for(lambda: f"from here {number}." in listener.output, "what was said")  # noqa: B023
    assert listener.output.count("the same again") == 20
    own = [text.data for _, sender, text in chatter.heard if sender == BRIDGE]
    assert len(own) == len(set(own)) and all("hello" in text for text in own)


@pytest.mark.parametrize(
    ("python", "text", "line"),
    [
        ("/nowhere/python", "", "bridge: no ROS 2 here yet: ./tutorial ros2 --yes sets it up\n"),
        (None, "topics: {joy: {direction: up}}", "topics.yaml: 'joy': a topic is"),
    ],
)
def test_a_failed_start_is_one_line(start, monkeypatch, tmp_path, python, text, line):
    if python:
        monkeypatch.setenv("TUTORIAL_ROS2", python)
    (tmp_path / "topics.yaml").write_text(text)
    program = start("rosrun", "ros2_bridge", "bridge", f"_topics:={tmp_path}/topics.yaml")
    assert program.wait() == 1
    assert line in program.output and "Traceback" not in program.output
