"""How long a Joy takes through the bridge to ROS 2 and its Twist back, and how much is carried."""

import os
import statistics
import struct
import threading
import time
from pathlib import Path

import pytest
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy

from node_kit import ros2_python
from tutorial_faults.live.samples import complaints, growth, sample
from tutorial_testing.nodes import init_node
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program, command_line, descendants
from tutorial_testing.waiting import wait_for

pytestmark = pytest.mark.skipif(
    not ros2_python.is_there(), reason="no ROS 2 here: ./tutorial ros2 --yes sets it up"
)
REPOSITORY = Path(__file__).resolve().parents[3]
PROGRAM = REPOSITORY / "common/ros2_tutorials/ros2_tutorials/publish_twist.py"
MANY = Path(__file__).with_name("many.py")
COUNT, RATE = 1000, 50.0
MOST_MS, MOST_LATE_MS = 3.0, 8.0  # median; of 99 in 100
SECONDS, ODOMETRY_HZ = 20, 1000.0
SIDES = {"ros1_node": "the side of ROS 1", "ros2_side": "the side of ROS 2"}
TICKS = os.sysconf("SC_CLK_TCK")


@pytest.fixture(scope="module", autouse=True)
def master():
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://127.0.0.1:{port}"
    os.environ["ROS_DOMAIN_ID"] = str(1 + port % 100)
    with Program("roscore", "-p", str(port)) as core:
        wait_for(lambda: "started core service" in core.output, "master")
        init_node("bench", disable_signals=True)
        yield


@pytest.fixture
def bridge(tmp_path):
    list_ = tmp_path / "topics.yaml"
    list_.write_text(
        "defaults: {depth: 5000}\ntopics:\n"
        "  /joy: {direction: to_ros2}\n  /cmd_vel: {direction: to_ros1, depth: 1}\n"
        "  /odom: {direction: to_ros2}\n  /odom_of_ros2: {direction: to_ros1}\n"
    )
    with Program("rosrun", "ros2_bridge", "bridge", f"_topics:={list_}") as program:
        wait_for(lambda: len(descendants(program.pid)) >= 3, "both sides", 20)
        yield program
        program.interrupt()
        program.wait(20)


def delays():
    """From each Joy to its Twist [ms], at an even rate; those that never came are missing."""
    publisher = rospy.Publisher("/joy", Joy, queue_size=10, tcp_nodelay=True)
    heard = {}

    def hear(twist):
        heard.setdefault(twist.linear.x, time.monotonic())

    subscriber = rospy.Subscriber("/cmd_vel", Twist, hear, tcp_nodelay=True)
    wait_for(publisher.get_num_connections, "a subscriber of /joy", 20)

    def is_answered():
        publisher.publish(Joy(axes=[0.0, 2.0], buttons=[0] * 12))
        return 2.0 in heard

    wait_for(is_answered, "a first Twist", 20)
    sent = {}
    for number in range(COUNT):
        (axis,) = struct.unpack("f", struct.pack("f", (number + 1) / COUNT))
        sent[axis] = time.monotonic()
        publisher.publish(Joy(axes=[0.0, axis], buttons=[0] * 12))
        time.sleep(1 / RATE)
    wait_for(lambda: axis in heard, "the last Twist", 10)
    publisher.unregister()
    subscriber.unregister()
    return sorted(1000 * (heard[axis] - when) for axis, when in sent.items() if axis in heard)


def test_a_joy_and_its_twist(bridge, figure):
    with Program("rosrun", "joy2twist", "publish_twist.py") as program:
        beside = delays()
        program.interrupt()
        program.wait()
    with Program(*ros2_python.command([str(PROGRAM)])) as program:
        found = delays()
        program.interrupt()
        program.wait()
    median, late = statistics.median(found), found[int(0.99 * len(found))]
    alone = statistics.median(beside)
    figure("Joys answered in ROS 2", f"{len(found)} of {COUNT}", f"{COUNT}")
    figure("Joy to Twist through the bridge and back, median", f"{median:.2f} ms", f"{MOST_MS} ms")
    figure("of 99 in 100", f"{late:.2f} ms", f"{MOST_LATE_MS} ms")
    figure("the same program in ROS 1, median", f"{alone:.2f} ms", "")
    assert len(found) == COUNT
    assert median < MOST_MS and late < MOST_LATE_MS


def used_s(pids):
    """Time of the processor that processes have used [s]."""
    total = 0
    for pid in pids:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        total += int(fields[11]) + int(fields[12])
    return total / TICKS


def test_odometry_both_ways(bridge, figure):
    count = int(SECONDS * ODOMETRY_HZ)
    came = []

    def hear(odom):
        came.append(odom.pose.pose.position.x)

    rospy.Subscriber("/odom_of_ros2", Odometry, hear, tcp_nodelay=True)
    publisher = rospy.Publisher("/odom", Odometry, queue_size=count, tcp_nodelay=True)
    wait_for(publisher.get_num_connections, "the bridge", 20)
    with Program(*ros2_python.command([str(MANY), str(count), str(ODOMETRY_HZ)])) as program:
        wait_for(lambda: "ready" in program.output, "ROS 2", 20)
        time.sleep(2.0)  # until the other side has found its publisher: no event says so
        pids = descendants(bridge.pid)
        begun, begin_s = used_s(pids), time.monotonic()
        thread = threading.Thread(target=publish, args=(publisher, count))
        thread.start()
        program.wait(SECONDS * 4 + 20)
        thread.join()
        wait_for(lambda: len(came) >= count, "all of ROS 2's", 20)
        said = program.output.splitlines()[-1]
        share = (used_s(pids) - begun) / (time.monotonic() - begin_s)
    figure("odometry of ROS 1 in ROS 2", said, f"{count}, in order")
    there = f"came {len(came)}, in order {came == sorted(came)}"
    figure("odometry of ROS 2 in ROS 1", there, f"{count}, in order")
    figure("share of a processor, both sides", f"{100 * share:.0f} %", "60 %")
    assert f"came {count}, in order True" in said
    assert came == sorted(came) and len(came) == count
    assert share < 0.6


def publish(publisher, count):
    """Publish odometry at an even rate."""
    message, begin_s = Odometry(), time.monotonic()
    for number in range(count):
        message.pose.pose.position.x = float(number)
        publisher.publish(message)
        time.sleep(max(0.0, begin_s + (number + 1) / ODOMETRY_HZ - time.monotonic()))


def test_nothing_grows(bridge, figure, request):
    """Joys at an even rate for --hours: memory, threads and files of both sides."""
    seconds = 3600 * request.config.getoption("--hours")
    twists, sent, samples = [0], 0, []

    def hear(_twist):
        twists[0] += 1

    subscriber = rospy.Subscriber("/cmd_vel", Twist, hear, tcp_nodelay=True)
    publisher = rospy.Publisher("/joy", Joy, queue_size=10, tcp_nodelay=True)
    with Program(*ros2_python.command([str(PROGRAM)])) as program:
        wait_for(publisher.get_num_connections, "the bridge", 20)
        sides = {
            said: pid
            for pid in descendants(bridge.pid)
            for name, said in SIDES.items()
            if name in command_line(pid)
        }
        begin_s = time.monotonic()
        while time.monotonic() - begin_s < seconds:
            if sent % int(2 * RATE) == 0:
                now_s = time.monotonic() - begin_s
                samples += [sample(now_s, side, pid) for side, pid in sides.items()]
            publisher.publish(Joy(axes=[0.0, sent % 7 / 7], buttons=[0] * 12))
            sent += 1
            time.sleep(max(0.0, begin_s + sent / RATE - time.monotonic()))
        program.interrupt()
        program.wait()
    subscriber.unregister()
    publisher.unregister()
    for side in sides:
        memory, threads, files = growth(samples, side)
        seen = f"{memory:+} kB, {threads:+} threads, {files:+} files"
        figure(f"{side} in {seconds / 60:.0f} minutes", seen, "≤ 2 MB, 0, 0")
    figure("meanwhile Twists for Joys", f"{twists[0]} of {sent}", "")
    assert len(sides) == 2 and complaints(samples) == []
    assert twists[0] >= 0.95 * sent  # it took a moment until both knew each other
