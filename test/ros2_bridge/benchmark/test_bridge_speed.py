"""How long a Joy to ROS 2 and its Twist back take through the bridge, and how much it carries."""

import statistics
import threading
import time
from pathlib import Path

import pytest
import rospy
from drive import CLASS, own_master
from live import delays, processor_time
from nav_msgs.msg import Odometry

from node_kit import ros2_python
from tutorial_testing.claims import claim
from tutorial_testing.processes import Program, descendants
from tutorial_testing.waiting import wait_for

pytestmark = [
    claim(
        "The bridge's figures: milliseconds for a Joy and its Twist, 1,000 odometry messages a "
        "second each way"
    ),
    pytest.mark.skipif(not ros2_python.is_there(), reason="no ROS 2 yet: ./tutorial ros2 --yes"),
]
PROGRAM = CLASS.with_name("publish_twist.py")
MANY = Path(__file__).with_name("many.py")
COUNT, RATE = 1000, 50.0
MOST_MS, MOST_LATE_MS = 3.0, 8.0  # median; of 99 in 100
SECONDS, ODOMETRY_HZ = 20, 1000.0


@pytest.fixture(scope="module", autouse=True)
def master():
    with own_master():
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


def test_a_joy_is_answered_through_the_bridge_in_milliseconds(bridge, figure):
    with Program("rosrun", "joy2twist", "publish_twist.py"):
        beside = delays("joy", RATE, COUNT)
    with Program(*ros2_python.command([str(PROGRAM)])):
        through = delays("joy", RATE, COUNT)
    median, late = 1e3 * statistics.median(through), 1e3 * through[int(0.99 * len(through))]
    alone = 1e3 * statistics.median(beside)
    figure("Joys answered in ROS 2", f"{len(through)} of {COUNT}", f"{COUNT}")
    figure("Joy to Twist through the bridge and back, median", f"{median:.2f} ms", f"{MOST_MS} ms")
    figure("of 99 in 100", f"{late:.2f} ms", f"{MOST_LATE_MS} ms")
    figure("the same program in ROS 1, median", f"{alone:.2f} ms", "")
    assert len(through) == COUNT
    assert median < MOST_MS and late < MOST_LATE_MS


def test_a_thousand_odometry_messages_a_second_pass_both_ways(bridge, figure):
    count = int(SECONDS * ODOMETRY_HZ)
    came = []

    hear = lambda odom: came.append(odom.pose.pose.position.x)  # noqa: E731
    rospy.Subscriber("/odom_of_ros2", Odometry, hear, tcp_nodelay=True)
    publisher = rospy.Publisher("/odom", Odometry, queue_size=count, tcp_nodelay=True)
    wait_for(publisher.get_num_connections, "the bridge", 20)
    with Program(*ros2_python.command([str(MANY), str(count), str(ODOMETRY_HZ)])) as program:
        wait_for(lambda: "ready" in program.output, "ROS 2", 20)
        time.sleep(2.0)  # until the other side has found its publisher: no event says so
        start, begin_s = processor_time(bridge.pid), time.monotonic()
        thread = threading.Thread(target=publish, args=(publisher, count))
        thread.start()
        program.wait(SECONDS * 4 + 20)
        thread.join()
        wait_for(lambda: len(came) >= count, "all of ROS 2's", 20)
        said = program.output.splitlines()[-1]
        share = (processor_time(bridge.pid) - start) / (time.monotonic() - begin_s)
    figure("odometry of ROS 1 in ROS 2", said, f"{count}, in order")
    there = f"came {len(came)}, in order {came == sorted(came)}"
    figure("odometry of ROS 2 in ROS 1", there, f"{count}, in order")
    figure("share of a processor, both sides", f"{100 * share:.0f} %", "60 %")
    assert f"came {count}, in order True" in said
    assert came == sorted(came) and len(came) == count
    assert share < 0.6


def publish(publisher, count):
    message, begin_s = Odometry(), time.monotonic()
    for number in range(count):
        message.pose.pose.position.x = float(number)
        publisher.publish(message)
        time.sleep(max(0.0, begin_s + (number + 1) / ODOMETRY_HZ - time.monotonic()))
