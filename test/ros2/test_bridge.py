"""The bridge with the tutorial's class in ROS 2, on the simulated robot of ROS 1."""

import json
import os
import signal
import time
from pathlib import Path

import pytest
import rosnode
import rospy
from drive import CLASS, LATENESS_S, RATE, REPOSITORY, REST_S, moves, stands_after
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


def is_one_for_each(twists, joys, begun=0):
    """Whether each Joy became its Twist, in order and equal to the bit.

    begun: at which Joy at the latest. A velocity that waits gives way to the next one, as the
    bridge's list says: on a busy machine that may be one in a hundred.
    """
    rest = iter(joys)
    return len(twists) > 0.99 * (len(joys) - begun) and all(twist in rest for twist in twists)


def latching(twists):
    """[(velocity, "1" if its connection latches)]"""
    heard = [message for _, _, message in twists.heard]
    return [(each.linear.x, each._connection_header["latching"]) for each in heard]


def doctor_says(start):
    program = start("rosrun", "tutorial_tools", "doctor.py")
    program.wait(20)
    assert "Traceback" not in program.output
    return program.output


@pytest.fixture
def class_drives(bridge, start_ros2, robot, ear, stick):
    """(bridge, the program of ROS 2, odometry, velocities, stick), and the robot drives."""
    twists = ear("/cmd_vel", Twist)
    made = bridge()
    program = start_ros2(CLASS)
    stick.wait_for_listener().begin()
    begin_s = time.monotonic()
    wait_for(lambda: moves(robot), "a robot that drives", 30)
    assert time.monotonic() - begin_s < 5 + 10 * LATENESS_S
    return made, program, robot, twists, stick


def test_every_joy_becomes_one_twist_equal_to_the_bit_and_then_the_robot_rests(class_drives, start):
    _, _, robot, twists, stick = class_drives
    first = len(stick.sent)
    wait_for(lambda: len(stick.sent) > first + int(RATE * SECONDS), "Joys", SECONDS + 10)
    ended_s = stick.end()
    assert stands_after(robot, ended_s) < REST_S
    heard = heard_twists(twists)
    assert is_one_for_each(heard, stick.sent[stick.sent.index(heard[0]) :])
    assert "bridge    carries between ROS 1 and ROS 2" in doctor_says(start)


def test_the_recording_drives_the_robot_one_twist_for_each_joy(
    bridge, start, start_ros2, robot, ear
):
    joys, twists = ear("/joy", Joy), ear("/cmd_vel", Twist)
    bridge()
    start_ros2(CLASS)
    play = start("rosbag", "play", "--loop", "--quiet", RECORDING)
    wait_for(lambda: joys.heard, "a first Joy", 20)
    wait_for(lambda: moves(robot), "a robot that drives", 30)
    begun = len(joys.heard)
    wait_for(lambda: time.monotonic() - joys.heard[0][0] > SECONDS, "the recording", SECONDS + 10)
    for pid in (*descendants(play.pid), play.pid):
        os.kill(pid, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S
    sent = [(joy.axes[1], joy.axes[0]) for _, _, joy in joys.heard]
    heard = heard_twists(twists)
    assert is_one_for_each(heard, sent, begun)


@pytest.mark.parametrize("side", ["ROS 1", "ROS 2"])
def test_a_side_that_is_killed_stops_the_robot_and_comes_back(class_drives, side):
    made, _, robot, _, _ = class_drives
    pid = made.send(side, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S
    line = f"bridge: the side of {side} has ended (signal 9): it is started anew"
    wait_for(lambda: line in made.output, "the line about it", 10)
    assert made.process(side) != pid
    wait_for(lambda: moves(robot), "a robot that drives again", 30)
    assert "Traceback" not in made.output


def test_the_launch_file_has_the_bridge_in_place_of_joy2twist(start, ear):
    """The two commands of the page on ROS 2."""
    odometry = ear("/odom", Odometry)
    start("roslaunch", "joy2twist", "launch_bag.launch", "ros2:=true", *WITHOUT_SCREEN)
    start(REPOSITORY / "tutorial", "ros2", "new_joy2twist")
    wait_for(lambda: odometry.heard and moves(odometry), "a robot that drives", 60)
    assert "/myjoystick2twist" not in rosnode.get_node_names()


def test_a_program_that_is_killed_stops_the_robot(class_drives):
    _, program, robot, _, _ = class_drives
    os.kill(program.pid, signal.SIGKILL)
    assert stands_after(robot, time.monotonic()) < REST_S


def test_ctrl_c_of_the_class_ends_with_zeros(class_drives):
    _, program, robot, twists, _ = class_drives
    program.interrupt()
    assert program.wait(10) == 0, program.output
    wait_for(lambda: heard_twists(twists)[-3:] == [(0.0, 0.0)] * 3, "three zeros", 5)
    assert "Traceback" not in program.output
    assert stands_after(robot, time.monotonic()) < REST_S


@pytest.mark.parametrize("side", ["ROS 1", "ROS 2"])
def test_what_waited_for_a_suspended_side_does_not_move_the_robot(class_drives, side, start):
    made, _, robot, twists, stick = class_drives
    made.send(side, signal.SIGSTOP)
    time.sleep(1.5)  # longer than a velocity or a Joy may be old; the robot stands by then
    stick.end()
    if side == "ROS 2":
        line = "bridge    the side of ROS 2 is missing: its terminal"
        wait_for(lambda: line in doctor_says(start), "the doctor's line", 20)
    before = len(twists.heard)
    made.send(side, signal.SIGCONT)
    time.sleep(1.5)  # in which a late one would come
    late = [pair for pair in heard_twists(twists)[before:] if any(pair)]
    assert len(late) <= RATE * 0.5  # those of the last half second, which the Joys may be old
    assert not moves(robot)


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
            wait_for(lambda now=now: latching(twists)[-1:] == now, f"{quality} of {topics}", 60)
            driver.interrupt()
            driver.wait(20)
        made.program.interrupt()
        made.program.wait(20)
        assert topics or {latch for _, latch in latching(twists)} == {"0"}


def test_the_first_message_of_a_connection_is_known_and_who_is_connected():
    heard, old = [], rospy.Publisher("/old", String, queue_size=10, latch=True)
    old.publish("old")
    subscriber = subscribe("/old", heard.append, 10)
    wait_for(lambda: heard, "what was latched", 20)
    old.publish("new")
    wait_for(lambda: len(heard) == 2, "a second message", 20)
    assert [(raw.is_latched, raw.is_first) for raw in heard] == [(True, True), (True, False)]
    assert senders(subscriber) == {rospy.get_name()}
    old.unregister()
    wait_for(lambda: not senders(subscriber), "an end of the connection", 20)
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
    wait_for(lambda: "ROS 2 has no such type here" in made.output, "a line", 20)
    assert made.output.count("kobuki_msgs/msg/BumperEvent") == 1
    assert "/bumper: kobuki_msgs/msg/BumperEvent: ROS 2 has no such" in doctor_says(start)
    peer = start_ros2(PEER)  # late: what was latched has been sent long ago
    reply = ear("/reply", String)
    wait_for(lambda: reply.heard, "the note, and back", 20)
    assert reply.last.data == HOSTILE
    assert reply.heard[0][1] == BRIDGE
    picture = rospy.Publisher("/picture", Image, queue_size=1, latch=True)
    picture.publish(Image(height=1, width=10_000_000, data=bytes(10_000_000)))
    wait_for(lambda: "picture 10000000" in peer.output, "ten megabytes", 20)
    changing = rospy.Publisher("/changing", String, queue_size=1, latch=True)
    changing.publish("one")
    wait_for(lambda: "changing" in str(rospy.get_published_topics()), "a topic", 10)
    time.sleep(1.0)
    changing.unregister()
    other = rospy.Publisher("/changing", Twist, queue_size=1, latch=True)
    other.publish(Twist())
    line = "/changing is now geometry_msgs/msg/Twist in ROS 1"
    wait_for(lambda: line in made.output, "a line", 20)
    note.publish("and on")
    wait_for(lambda: reply.last.data == "and on", "a note after all that", 10)
    assert "Traceback" not in made.output


def test_a_topic_of_both_directions_has_no_echo(bridge, start_ros2, ear):
    bridge()
    programs = REPOSITORY / "common/ros2_tutorials/ros2_tutorials"
    start_ros2(programs / "talker.py")
    listener = start_ros2(programs / "listener.py")
    chatter = ear("/chatter", String)
    publisher = rospy.Publisher("/chatter", String, queue_size=10)
    wait_for(lambda: len(chatter.heard) > 20, "a talker of ROS 2", 20)
    for number in range(20):
        publisher.publish(f"from here {number}")
        publisher.publish("the same again")
        time.sleep(0.05)
    wait_for(lambda: "from here 19" in listener.output, "what was said here", 10)
    mine = [line for line in listener.output.splitlines() if "the same again" in line]
    assert len(mine) == 20
    own = [text.data for _, sender, text in chatter.heard if sender == BRIDGE]
    assert len(own) == len(set(own)) and not [text for text in own if "here" in text]


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
    assert program.wait(20) == 1
    assert line in program.output and "Traceback" not in program.output
