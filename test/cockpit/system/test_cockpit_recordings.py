"""A page plays a recording of several topics: what arrives, and when."""

import signal
from collections import defaultdict
from pathlib import Path
from statistics import median

import pytest
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped, Twist, Vector3
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Joy
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.world import World
from tutorial_testing.nodes import serialised
from tutorial_testing.socket_page import SocketPage
from tutorial_testing.waiting import tolerance, wait_for

pytestmark = [pytest.mark.xdist_group("cockpit"), pytest.mark.long]
COUNT, PERIOD_S = 60, 0.05
ARMED = 10  # messages with everything released, before LB is held
TOPICS = ["/was/odom", "/was/tf", "/was/cmd_vel", "/joy"]
NOTE = "/was/note"  # latched
MEDIAN_S = 0.02  # how late a message may be


def pushed(i):
    return i / COUNT if i >= ARMED else 0.0


def recorded(i):
    """Return {topic: message i}, with all digits in use."""
    odometry = Odometry(child_frame_id=f"base {i}")
    odometry.header.seq, odometry.pose.pose.position.x = i + 7, i / 3
    turn = TransformStamped(child_frame_id="base")
    turn.transform.rotation.w = 1 / (i + 1)
    joy = Joy(axes=[0.0, pushed(i), *[0.0] * 4], buttons=[0] * 4 + [int(i >= ARMED)] + [0] * 7)
    messages = odometry, TFMessage([turn]), Twist(linear=Vector3(x=i / 7)), joy
    return dict(zip(TOPICS, messages))


@pytest.fixture
def bag():
    """The name of a recording in the folder of the cockpit."""
    path = Path("to_play.bag")
    with rosbag.Bag(str(path), "w") as file:
        header = {"topic": NOTE, "type": String._type, "md5sum": String._md5sum,
                  "message_definition": String._full_text, "latching": "1"}  # fmt: skip
        file.write(NOTE, String("hello"), rospy.Time(1000), connection_header=header)
        for i in range(COUNT):
            for topic, message in recorded(i).items():
                file.write(topic, message, rospy.Time.from_sec(1000 + i * PERIOD_S))
    yield path.name
    path.unlink()


def raw(path):
    """Return {topic: [(time [s], type, md5sum, bytes), ...]} of a recording."""
    messages = defaultdict(list)
    with rosbag.Bag(str(path)) as file:
        for topic, (kind, data, md5sum, *_), stamp in file.read_messages(raw=True):
            messages[topic].append((stamp.to_sec(), kind, md5sum, data))
    return messages


@claim("Recorded messages are published equal ...", because="and at their times, as others record")
@claim("A recorded velocity ...", because="of a real subscriber")
def test_a_recording_of_four_topics_arrives_as_it_was_recorded(bag, tmp_path):
    with World() as world, SocketPage(world.port) as page:
        record = world.run("rosbag", "record", "-O", str(tmp_path / "played.bag"), *TOPICS)
        page.say("watch", bag=True, graph=True, robots=True, look="")
        page.wait_for("drives", lambda message: not message["refusal"])

        def is_subscribed(graph):
            to = {edge["from"] for edge in graph["edges"] if edge["to"].startswith("node /record_")}
            return {f"topic {topic}" for topic in TOPICS} <= to

        page.wait_for("graph", is_subscribed)
        page.say("bag_open", name=bag)
        page.wait_for("bag")
        slack = tolerance()
        page.say("bag_play", topics=TOPICS, rate=1.0, loop=False, robot="")
        page.wait_for("bag_at", lambda at: at["playing"])
        wait_for(lambda: world.now.moves, "robot that moves")
        wait_for(lambda: not page.of("bag_at")[-1]["playing"], "end of the recording")
        world.wait_for_rest()
        bound_s = MEDIAN_S + slack()
        record.signal(signal.SIGINT)
        record.wait()
    sent, arrived = raw(bag), raw(tmp_path / "played.bag")
    zero = arrived["/was/cmd_vel"].pop()
    assert zero[1:] == (Twist._type, Twist._md5sum, serialised(Twist()))
    for topic in TOPICS[:-1]:
        assert [message[1:] for message in arrived[topic]] == [m[1:] for m in sent[topic]], topic
        assert lateness(sent[topic], arrived[topic]) < bound_s
    pressed = [Joy().deserialize(data).axes[1] for *_, data in arrived["/joy"]]
    assert pressed == pytest.approx([*map(pushed, range(COUNT)), 0.0], abs=1e-4)


class Bare(World):
    """A master and a cockpit, without a robot."""

    def begin(self):
        port = self.environment["ROS_MASTER_URI"].rpartition(":")[2]
        self.launched = self.run("roscore", "-p", port)
        wait_for(lambda: "core service" in self.launched.output, "master")
        self.start_cockpit()


@claim("Recorded messages are published equal ...", because="latched, for a late subscriber")
def test_a_late_subscriber_gets_what_is_latched_without_a_robot(bag):
    with Bare() as world, SocketPage(world.port) as page:
        page.say("watch", bag=True)
        page.say("bag_open", name=bag)
        page.wait_for("bag")
        page.say("bag_seek", position=0.0)
        page.say("bag_play", topics=[NOTE], rate=0.1, loop=False, robot="")
        page.wait_for("bag_at", lambda at: at["position"] > 0.01)  # after it was published
        echo = world.run("rostopic", "echo", "-n1", NOTE)
        wait_for(lambda: "hello" in echo.output, "what is latched")
        assert page.of("bag_at")[-1]["playing"]


def lateness(sent, arrived):
    """Return the median of how much later messages are than the earliest one [s]."""
    late = [there[0] - here[0] for here, there in zip(sent, arrived)]
    return median(late) - min(late)
