"""foxglove_bridge for npm's reference clients, beside a robot in a room and a turtlesim.

FOXGLOVE_S in the environment is how long each message is compared [s], such as 60.
"""

import base64
import os

import roslib.message
import rosparam
import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped, Twist
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from turtlesim.msg import Pose

from tutorial_testing.claims import claim
from tutorial_testing.foxglove.clients import FOXGLOVE, LICHTBLICK, Clients
from tutorial_testing.nodes import serialised
from tutorial_testing.processes import free_port
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import Stopwatch, wait_for

COMPARED_S = float(os.environ.get("FOXGLOVE_S", "6"))
ODOM_HZ, LEAST = 50, 0.95  # of the messages of odom
TWISTS = 250


def bytes_of(messages):
    """Return the bytes of a client's messages."""
    return [base64.b64decode(message["data"]) for message in messages]


class ReferenceClientsTest(RosTest):
    def setUp(self):
        self._port = free_port()
        self._url = f"ws://127.0.0.1:{self._port}"
        self.bridge = self.start(
            "roslaunch", "foxglove_bridge", "foxglove_bridge.launch", f"port:={self._port}"
        )
        wait_for(lambda: self._url in self.bridge.output, "bridge", 60, self.said)

    def tearDown(self):
        self.assertNotIn("Traceback", self.said())

    def said(self):
        return self.bridge.output

    def clients(self):
        return self.enter(Clients(self._url))

    def client(self, protocols=LICHTBLICK):
        return self.clients().connect(protocols=protocols)

    def raw(self, topic):
        """Return the growing list of a topic's bytes, as rospy receives them."""
        received = []
        subscriber = rospy.Subscriber(topic, rospy.AnyMsg, lambda it: received.append(it._buff))
        self.addCleanup(subscriber.unregister)
        return received

    @claim("foxglove_bridge: npm's client sees each topic with its type's definition")
    def test_a_client_of_either_kind_sees_all_topics_with_their_schemas(self):
        newest = FOXGLOVE[0]
        for protocols in (LICHTBLICK, FOXGLOVE, FOXGLOVE[::-1]):
            client = self.client(protocols)
            protocol = newest if newest in protocols else protocols[0]
            self.assertEqual(client.of("open")[0]["protocol"], protocol)
            wait_for(lambda client=client: "/odom" in client.channels(), "channel of odom")
            wait_for(
                lambda client=client: (
                    dict(rospy.get_published_topics()).keys() <= client.channels().keys()
                ),
                "all topics",
            )
            for topic, kind in rospy.get_published_topics():
                channel = client.channels()[topic]
                definition = roslib.message.get_message_class(kind)._full_text
                self.assertEqual(channel["encoding"], "ros1")
                self.assertEqual(channel["schemaEncoding"], "ros1msg")
                self.assertEqual((channel["schemaName"], channel["schema"]), (kind, definition))

    @claim("foxglove_bridge: no message of a robot is lost or changed on the way to npm's client")
    def test_each_message_arrives_as_rospy_receives_it(self):
        client = self.client()
        wait_for(lambda: "/odom" in client.channels(), "channel of odom")
        topics = [name for name, _ in rospy.get_published_topics() if "/rosout" not in name]
        reference = {topic: self.raw(topic) for topic in topics}
        wait_for(lambda: reference["/odom"], "odom")
        client.do("subscribe", topics=topics)
        wait_for(lambda: client.messages("/odom"), "first odom of the client", 60, self.said)
        watch, begin = Stopwatch(), len(client.messages("/odom"))
        wait_for(lambda: watch.took_s > COMPARED_S, "time")
        least = LEAST * ODOM_HZ * COMPARED_S
        self.assertGreater(len(client.messages("/odom")) - begin, least)
        client.do("unsubscribe", topics=topics)
        compared = 0
        for topic in topics:
            messages = client.messages(topic)
            self.assertTrue(all(message["isSame"] for message in messages), topic)
            received = bytes_of(messages)
            wait_for(lambda: set(received) <= set(reference[topic]), topic)  # noqa: B023
            if topic not in (
                "/tf",
                "/tf_static",
                "/rosout",
            ):  # those of several nodes have no order
                self.assert_within(received, reference[topic], topic)
            compared += len(received)
        self.assertGreater(compared, 2 * least)

    def assert_within(self, part, whole, topic):
        """Check that messages are without a gap in those that rospy received."""
        starts = range(len(whole) - len(part) + 1)
        self.assertTrue(any(whole[k : k + len(part)] == part for k in starts), topic)

    @claim("foxglove_bridge: npm's client calls a service and sets a parameter")
    def test_a_client_calls_a_service_and_sets_a_parameter(self):
        client = self.client()
        wait_for(lambda: any("/spawn" in str(it) for it in client.of("advertiseServices")), "spawn")
        request = {"x": 2.0, "y": 3.0, "theta": 0.5, "name": "npm"}
        response = client.next("serviceCallResponse", "call", service="/spawn", request=request)
        self.assertEqual(response["data"], {"name": "npm"})
        poses = self.record("/npm/pose", Pose)
        wait_for(lambda: poses and (poses[-1].x, poses[-1].y) == (2.0, 3.0), "turtle")
        change = {"name": "/turtlesim/background_r", "value": 7}
        values = client.next("parameterValues", "setParameters", parameters=[change])
        self.assertEqual(rosparam.get_param(change["name"]), 7)
        self.assertEqual(values["data"]["parameters"][0]["value"], 7)
        names = [change["name"]]
        values = client.next("parameterValues", "getParameters", names=names)
        self.assertEqual([it["value"] for it in values["data"]["parameters"]], [7])

    @claim("foxglove_bridge: all that npm's client publishes arrives; a zero ends its last motion")
    def test_all_twists_arrive_and_a_zero_after_the_client(self):
        twists, client = [], self.client()
        self.hear("twists", Twist, lambda twist: twists.append(twist.linear.x))
        client.do("advertise", topic="/twists", schemaName=Twist._type, schema=Twist._full_text)
        still = {"x": 0, "y": 0, "z": 0}
        speeds = [(k + 1) / 1000 for k in range(TWISTS)]
        first, *messages = [{"linear": {**still, "x": x}, "angular": still} for x in [9, *speeds]]
        wait_for(
            lambda: client.do("publish", topic="/twists", messages=[first]) or twists, "connection"
        )
        client.do("publish", topic="/twists", messages=messages)
        wait_for(lambda: speeds[-1] in twists, f"{TWISTS} twists", 60, self.said)
        self.assertEqual([speed for speed in twists if speed != 9], speeds)
        client.do("close")
        wait_for(lambda: twists[-1] == 0, "zero")

    @claim(
        "foxglove_bridge: a topic that a client unadvertises and advertises at once is published"
    )
    def test_a_topic_is_advertised_again_at_once(self):
        client, goals = self.client(), []
        subscriber = self.hear("goal", PoseStamped, goals.append)
        kind = {"schemaName": PoseStamped._type, "schema": PoseStamped._full_text}
        client.do("advertise", topic="/goal", **kind)
        wait_for(subscriber.get_num_connections, "publisher of the bridge", 60, self.said)
        for _ in range(3):  # as a panel of Foxglove does when it is drawn again
            client.do("unadvertise", topic="/goal")
            client.do("advertise", topic="/goal", **kind)
        point, turn = {"x": 1, "y": 2, "z": 0}, {"x": 0, "y": 0, "z": 0, "w": 1}
        header = {"seq": 0, "stamp": {"sec": 1, "nsec": 0}, "frame_id": "map"}
        goal = {"header": header, "pose": {"position": point, "orientation": turn}}
        wait_for(lambda: client.do("publish", topic="/goal", messages=[goal]) or goals, "goal", 20)
        self.assertEqual(goals[0].pose.position.y, 2)

    @claim("foxglove_bridge: a client that comes late gets the map and all static frames")
    def test_a_late_client_gets_latched_messages(self):
        own = self.publisher("/tf_static", TFMessage, latch=True)
        own.publish([TransformStamped(child_frame_id="of_this_test")])
        clients, topics = self.clients(), ["/map", "/tf_static"]
        reference = {topic: self.raw(topic) for topic in topics}
        wait_for(lambda: reference["/map"] and len(reference["/tf_static"]) >= 2, "latched")
        for name in ("early", "late"):
            client = clients.connect(name)
            client.do("subscribe", topics=topics)
            for topic, latched in reference.items():
                wait_for(
                    lambda client=client, topic=topic, latched=latched: (
                        set(bytes_of(client.messages(topic))) >= set(latched)
                    ),
                    f"{topic} of the {name} client",
                )
        self.assertIn(serialised(rospy.wait_for_message("/map", OccupancyGrid)), reference["/map"])

    @claim("foxglove_bridge: a topic that comes while npm's client waits for it is subscribed")
    def test_topics_come_and_go(self):
        client = self.client()
        client.do("subscribe", topics=["/comes_and_goes"])
        self.come_and_go(client, "first")
        self.come_and_go(client, "second")
        self.assertFalse(client.of("error"))

    def come_and_go(self, client, text):
        publisher, expected = self.connected("/comes_and_goes", String), serialised(String(text))
        publisher.publish(text)
        wait_for(lambda: expected in bytes_of(client.messages("/comes_and_goes")), text)
        number = len(client.of("unadvertise"))
        publisher.unregister()
        wait_for(lambda: len(client.of("unadvertise")) > number, "end of the topic")
