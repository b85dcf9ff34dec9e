"""The bridge with the tutorial's class in ROS 2, on the simulated robot of ROS 1."""

import os
import re
import shutil
import threading
from pathlib import Path

import pytest
import rosnode
import rospy
from drive import BRIDGE, CLASS, RATE, REPOSITORY, carried, wait_for_doctor
from geometry_msgs.msg import Twist
from kobuki_msgs.msg import BumperEvent
from sensor_msgs.msg import Image
from std_msgs.msg import String

from node_kit import ros2_python
from node_kit.ros.graph.raw_messages import RawPublisher, senders, subscribe
from node_kit.ros.rospy_patches.connections import header_of, sender_of
from tutorial_testing.claims import claim
from tutorial_testing.robot import Robot
from tutorial_testing.waiting import DEADLINE_S, wait_for

SOURCES = REPOSITORY / "common/ros2_bridge/src"
PROGRAMS = CLASS.parent
PEER, DRIVER, QUALITIES = map(Path(__file__).with_name, ("peer.py", "driver.py", "qualities.py"))
PAGE = REPOSITORY / "common/doc/ROS2.md"
SECONDS = float(os.environ.get("TUTORIAL_ROS2_SECONDS", "8"))  # the bare machines have 60
WITHOUT_SCREEN = ("rviz:=false", "cockpit:=false", "model:=false")
HOSTILE = "\u00e4 { } %s \\ \n <script>"  # without \0, which ends a text of ROS 2
VELOCITY = {"/cmd_vel": "to_ros1"}


def latched(topic, message):
    publisher = rospy.Publisher(topic, type(message), queue_size=1, latch=True)
    publisher.publish(message)
    return publisher


@claim("Every Joy becomes one Twist through the bridge, equal to the bit and in order")
def test_every_joy_becomes_one_twist_equal_to_the_bit(bridge, start, start_ros2, ear, stick):
    """One after the other, and without an age limit, so that a busy machine makes none late."""
    bridge({"/joy": "to_ros2", **VELOCITY})
    twists, _ = ear("/cmd_vel", Twist), start_ros2(CLASS)
    wait_for(lambda: stick.push(0.5, 0.25) in carried(twists), "a first Twist")
    for number in range(int(RATE * SECONDS)):
        sent = stick.push(0.001 * number, 0.002 * number)
        wait_for(lambda sent=sent: carried(twists)[-1] == sent, f"Twist {number}")
    count = int(RATE * SECONDS)
    assert carried(twists)[-count:] == stick.sent[-count:]
    wait_for_doctor(start, "bridge carries between ROS 1 and ROS 2")


@claim(
    "The recording drives the robot through ROS 2: `ros2:=true` has the bridge in place of "
    "joy2twist, and `./tutorial ros2 new_joy2twist` drives then"
)
def test_the_launch_file_has_the_bridge_in_place_of_joy2twist(start):
    """These are the two commands of the page on ROS 2."""
    start("roslaunch", "joy2twist", "launch_bag.launch", "ros2:=true", *WITHOUT_SCREEN)
    start(REPOSITORY / "tutorial", "ros2", "new_joy2twist")
    with Robot() as robot:
        wait_for(lambda: robot.moves, "a robot that drives")
    assert "/myjoystick2twist" not in rosnode.get_node_names()
    rospy.delete_param("/fake_turtlebot")  # with the launch file's, it never stops by itself


@claim(
    "Drivers of any quality of service are carried in turn, to a busy subscriber, too; with an age "
    "limit none is latched"
)
@pytest.mark.parametrize("topics", [None, VELOCITY], ids=["with our age limit", "without a limit"])
def test_drivers_of_any_quality_are_carried_in_turn(bridge, start, start_ros2, topics):
    """One subscriber is busy with a velocity while the next one reaches another subscriber.

    Velocities with an age limit are not latched.
    """
    heard, are_carried = [], [threading.Event() for _ in range(6)]  # by the driver's number

    def hear(twist):
        speed = int(twist.linear.x)
        heard.append((speed, header_of(twist)["latching"]))
        are_carried[speed + 1].wait(DEADLINE_S)

    bridge(topics)
    subscriber = rospy.Subscriber("/cmd_vel", Twist, hear)
    other = start("rostopic", "echo", "-p", "/cmd_vel/linear/x")
    kept, plain = "transient_local", "volatile"
    for speed, (durability, reliability) in enumerate(
        [(kept, "reliable"), (plain, "best_effort"), (kept, "best_effort"), (plain, "reliable")], 1
    ):
        driver = start_ros2(DRIVER, durability, reliability, speed)
        wait_for(lambda text=f",{speed}.0\n": text in other.output, f"driver {speed}")
        are_carried[speed].set()
        now = speed, "1" if topics else "0"
        wait_for(lambda now=now: heard[-1:] == [now], f"driver {speed} at the busy subscriber")
        driver.interrupt()
        driver.wait()
    are_carried[-1].set()
    subscriber.unregister()


@claim(
    "A subscription fits all publishers; late subscribers in ROS 2 get what latched senders sent, "
    "not what gone ones did"
)
def test_quality_of_service_and_what_is_kept_for_late_subscribers(start_ros2):
    """All publishers are received; nothing old is, with an age limit or of what this node keeps.

    A sender that does not latch does not renew a publisher; the end of the last latched one does.
    """
    program = start_ros2(QUALITIES, SOURCES)
    assert program.wait() == 0, program.output
    wanted = ["TRANSIENT_LOCAL", "VOLATILE", "VOLATILE", "VOLATILE"]
    lines = [*(f"{durability} RELIABLE" for durability in wanted), "VOLATILE BEST_EFFORT"]
    assert program.output.splitlines() == [*lines, "latched not end", "end"]


def test_the_first_message_of_a_connection_is_known_and_who_is_connected():
    """A late subscriber gets the latched message, until one that is not latched replaces it."""
    heard, publisher = [], RawPublisher("/old", "std_msgs/String", 10, is_latched=False)
    publisher.publish(b"old", True)
    subscriber = subscribe("/old", heard.append, 10)
    wait_for(lambda: heard, "what was latched")
    publisher.publish(b"new", False)
    wait_for(lambda: len(heard) == 2, "a second message")
    subscriber.unregister()
    subscriber = subscribe("/old", heard.append, 10)
    wait_for(lambda: publisher.publish(b"next", False) or len(heard) > 2, "a third message")
    seen = [(raw.data, raw.is_latched, raw.is_first) for raw in heard[:3]]
    assert seen == [(b"old", True, True), (b"new", True, False), (b"next", False, True)]
    assert senders(subscriber) == {rospy.get_name()}
    publisher.end()
    wait_for(lambda: not senders(subscriber), "an end of the connection")
    subscriber.unregister()


@claim("Latched messages come to late subscribers of the other side, both ways, ten megabytes too")
def test_what_is_latched_is_carried_to_late_subscribers_ten_megabytes_too(bridge, start_ros2, ear):
    note = latched("/note", String(HOSTILE))
    bridge({"/note": "to_ros2", "/reply": "to_ros1", "/picture": "to_ros2"})
    picture = latched("/picture", Image(height=1, width=10_000_000, data=bytes(10_000_000)))
    peer, reply = start_ros2(PEER), ear("/reply", String)
    wait_for(lambda: reply, "the note, and back")
    assert (sender_of(reply[0]), reply[-1].data) == (BRIDGE, HOSTILE)
    wait_for(lambda: "picture 10000000" in peer.output, "ten megabytes")
    note.unregister()
    picture.unregister()


@claim(
    "A type that ROS 2 lacks, or that changes, is one line, in the doctor too, and the others go on"
)
def test_a_type_that_ros2_lacks_or_that_changes_is_one_line_and_others_go_on(
    bridge, start, start_ros2, ear
):
    to_ros2 = dict.fromkeys(["/bumper", "/changing", "/note"], "to_ros2")
    made = bridge({**to_ros2, "/reply": "to_ros1"})
    kept = [latched("/bumper", BumperEvent(1, 1))]
    wait_for(lambda: "ROS 2 has no such type here" in made.program.output, "a line")
    assert made.program.output.count("kobuki_msgs/msg/BumperEvent") == 1
    wait_for_doctor(start, "/bumper: kobuki_msgs/msg/BumperEvent: ROS 2 has no such")
    text, note = latched("/changing", String("one")), latched("/note", String("and on"))
    reply, _ = ear("/reply", String), start_ros2(PEER)
    wait_for(lambda: reply, "a note, long after the text")
    text.unregister()
    kept += [note, latched("/changing", Twist())]
    wait_for(lambda: "/changing is now geometry_msgs/msg/Twist" in made.program.output, "a line")
    reply.clear()
    wait_for(lambda: note.publish("and on") or reply, "a note after all that")
    assert "Traceback" not in made.program.output
    for publisher in kept:
        publisher.unregister()


@claim("Nothing comes back on a topic of both directions")
def test_a_topic_of_both_directions_has_no_echo(bridge, start_ros2, ear):
    bridge()
    start_ros2(PROGRAMS / "talker.py")
    listener, chatter = start_ros2(PROGRAMS / "listener.py"), ear("/chatter", String)
    publisher = rospy.Publisher("/chatter", String, queue_size=10)
    wait_for(lambda: len(chatter) > 20, "a talker of ROS 2")

    def is_heard(text):
        publisher.publish(text)
        return text in listener.output

    def is_repeated(number):
        sent.append(publisher.publish("the same again"))  # more than once if one is lost
        return listener.output.count("the same again") > number

    sent = []
    wait_for(lambda: is_heard("ready?"), "a way to the listener")
    for number in range(20):
        wait_for(lambda number=number: is_repeated(number), "the same text")
        wait_for(lambda text=f"from here {number}.": is_heard(text), "another text")
    assert listener.output.count("the same again") <= len(sent)
    own = [text.data for text in chatter if sender_of(text) == BRIDGE]
    assert len(own) == len(set(own)) and all("hello" in text for text in own)


@claim("A bridge that cannot start says why in one line")
@pytest.mark.parametrize(
    ("python", "text", "line"),
    [
        ("/nowhere/python", "", "bridge: no ROS 2 here yet: ./tutorial ros2 --yes sets it up\n"),
        ("", "topics: {joy: {direction: up}}", "topics.yaml: 'joy': a topic is"),
    ],
    ids=["no ROS 2", "a wrong list"],
)
def test_a_failed_start_is_one_line(start, monkeypatch, tmp_path, python, text, line):
    if python:
        monkeypatch.setenv("TUTORIAL_ROS2", python)
    (tmp_path / "topics.yaml").write_text(text)
    program = start("rosrun", "ros2_bridge", "bridge", f"_topics:={tmp_path}/topics.yaml")
    assert program.wait() == 1
    assert line in program.output and "Traceback" not in program.output


@claim("colcon builds the programs in ROS 2 by the page's commands")
@pytest.mark.skipif(not shutil.which("colcon"), reason="no colcon in this system's archive")
def test_the_package_is_built_by_colcon_and_runs(start, tmp_path):
    """These are the page's commands for colcon."""
    (commands,) = re.findall(r"^## With colcon.*?```bash\n(.*?)```", PAGE.read_text(), re.S | re.M)
    talker = "install/ros2_tutorials/lib/ros2_tutorials/talker"
    script = f'cd "{REPOSITORY}"\nset -e\n{commands}\nexec "$0" {talker}'
    *environment, python = ros2_python.command([])
    program = start(*environment, f"HOME={tmp_path}", "bash", "-c", script, python)
    wait_for(lambda: "hello world" in program.output or program.ended, "talker")
    assert not program.ended, program.output
