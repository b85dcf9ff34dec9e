"""The bridge and clients in Python: what they see, what they drive, and how a motion ends."""

import importlib.util
import os
import signal
import socket
import ssl
import subprocess
import time
import unittest

import rospy
from geometry_msgs.msg import Twist, TwistStamped
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Empty, String
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

from foxglove_bridge_server.velocities import SILENCE_S
from tutorial_testing.claims import claim
from tutorial_testing.foxglove.socket_client import OLD_NAME, SocketClient
from tutorial_testing.nodes import node_path, pid_of, serialised
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

BRIDGE = node_path("foxglove_bridge", "foxglove_bridge")
TWIST = "geometry_msgs/Twist"
NORMAL_CLOSE = 1000  # RFC 6455, 7.4.1
AHEAD, ZERO = Twist(), Twist()
AHEAD.linear.x = 0.3


@unittest.skipUnless(
    importlib.util.find_spec("foxglove"), "PyPI has no foxglove-sdk for this Python"
)
class BridgeTest(RosTest):
    """A test case with a bridge."""

    def bridge(self, *parameters):
        """Start a bridge; return it and its port."""
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        program = self.start(BRIDGE, f"_port:={port}", *parameters)
        wait_for(lambda: "://127.0.0.1" in program.output, "bridge", seen=lambda: program.output)
        return program, port

    def client(self, port):
        return self.enter(SocketClient(port))

    def driver(self, port, topic):
        """Return a client that drives on a topic, and the messages that arrive."""
        client, heard = self.client(port), self.record(topic, Twist)
        client.advertise(1, topic, TWIST)
        self.drive(client, heard)
        return client, heard

    def drive(self, client, heard):
        """Publish until a velocity arrives: the first ones may come before the subscriber."""
        count = heard.count(AHEAD)

        def arrives():
            self.sent_s = time.monotonic()
            client.publish(1, serialised(AHEAD))
            return heard.count(AHEAD) > count

        wait_for(arrives, "velocity")


@claim(
    "Clients of Foxglove see topics, services, parameters and time of ROS 1 to the bit; one that "
    "comes late gets what is latched"
)
class SeenTest(BridgeTest):
    def test_a_late_client_gets_the_message_of_each_latched_publisher_once(self):
        bridge, port = self.bridge()
        self.publisher("latched", String, latch=True).publish("a")
        other = self.start("rostopic", "pub", "-l", "/latched", "std_msgs/String", "b")
        wanted = {serialised(String(text)) for text in "ab"}
        early = self.client(port)
        early.subscribe("/latched")
        wait_for(
            lambda: set(early.data("/latched")) == wanted, "latched", seen=lambda: other.output
        )
        late = self.client(port)
        late.subscribe("/latched")
        seen = lambda: (late.data("/latched"), early.data("/latched"), bridge.output)  # noqa: E731
        wait_for(lambda: set(late.data("/latched")) == wanted, "latched, late", seen=seen)
        self.assertEqual(len(late.data("/latched")), 2)
        self.assertEqual(len(early.data("/latched")), 2)
        other.interrupt()
        other.wait()
        last = self.client(port)
        last.subscribe("/latched")
        wait_for(lambda: last.data("/latched"), "latched, last")
        self.assertEqual(last.data("/latched"), [serialised(String("a"))])

    def test_a_topic_is_subscribed_while_a_client_subscribes_and_goes_with_its_publisher(self):
        _, port = self.bridge()
        publisher, client = self.publisher("comes", Empty), self.client(port)
        channel = client.channel("/comes")
        self.assertEqual((channel["encoding"], channel["schemaEncoding"]), ("ros1", "ros1msg"))
        self.assertEqual((channel["schemaName"], channel["schema"]), (Empty._type, ""))
        self.assertEqual(publisher.get_num_connections(), 0)
        client.subscribe("/comes")
        wait_for(publisher.get_num_connections, "subscription")
        client.send({"op": "unsubscribe", "subscriptionIds": [0]})
        wait_for(lambda: not publisher.get_num_connections(), "end of the subscription")
        client.subscribe("/comes")
        wait_for(publisher.get_num_connections, "second subscription")
        publisher.unregister()
        gone = {"op": "unadvertise", "channelIds": [channel["id"]]}
        wait_for(lambda: gone in client.texts, "unadvertisement")

    def test_a_type_that_is_not_installed_is_shown_as_its_publisher_defines_it(self):
        kind = type(
            "Odd", (String,), {"_type": "odd_msgs/Odd", "_full_text": "string data # odd\n"}
        )
        _, port = self.bridge()
        self.publisher("odd", kind, latch=True).publish("x")
        client = self.client(port)
        client.subscribe("/odd")
        self.assertEqual(client.channel("/odd")["schema"], "string data # odd\n")
        wait_for(lambda: client.data("/odd") == [serialised(String("x"))], "odd message")

    def test_simulated_time_is_broadcast_and_stamps_messages(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        clock = self.publisher("/clock", Clock)
        _, port = self.bridge()
        client, talk = self.client(port), self.publisher("talk", String)
        client.subscribe("/clock", "/talk")
        wait_for(talk.get_num_connections, "subscription")
        for second in range(5, 55):
            clock.publish(rospy.Time(second))
            wait_for(lambda s=second: s * 10**9 in client.times, f"time {second}")
        talk.publish("now")
        wait_for(lambda: client.stamps("/talk"), "message")
        self.assertEqual(client.stamps("/talk"), [54 * 10**9])
        self.assertEqual(
            client.data("/clock")[-50:], [serialised(Clock(rospy.Time(s))) for s in range(5, 55)]
        )

    def test_services_are_called_with_bytes_and_a_slow_one_delays_no_other(self):
        def answer(request):
            if request.data:
                wait_for(lambda: 2 in client.answers, "answer of the other call")
            return SetBoolResponse(success=not request.data, message="done")

        service = rospy.Service("ask", SetBool, answer)
        self.addCleanup(service.shutdown)
        _, port = self.bridge()
        client = self.client(port)
        client.call("/ask", 1, serialised(SetBoolRequest(True)))
        client.call("/ask", 2, serialised(SetBoolRequest(False)))
        wait_for(lambda: 1 in client.answers, "both answers")
        self.assertEqual(client.answers[1], serialised(SetBoolResponse(False, "done")))
        self.assertEqual(client.answers[2], serialised(SetBoolResponse(True, "done")))
        client.call("/ask", 3, b"")
        failure = wait_for(lambda: client.of("serviceCallFailure"), "failure")[0]["message"]
        self.assertIn("the request is not a std_srvs/SetBoolRequest", failure)

    def test_parameters_are_read_set_watched_and_limited(self):
        rospy.set_param("/of/rate", 5)
        rospy.set_param("/secret", "x")
        _, port = self.bridge("_param_whitelist:=['/of/.*']")
        client = self.client(port)

        def values():
            lists = [text["parameters"] for text in client.of("parameterValues")]
            return {p["name"]: p["value"] for parameters in lists for p in parameters}

        wait_for(lambda: client.of("serverInfo"), "server")
        client.send({"op": "getParameters", "parameterNames": [], "id": "all"})
        wait_for(lambda: values() == {"/of/rate": 5}, "parameters", seen=lambda: client.texts)
        client.send({"op": "subscribeParameterUpdates", "parameterNames": ["/of/rate"]})
        rates = iter(range(100))
        wait_for(
            lambda: rospy.set_param("/of/rate", next(rates)) or values()["/of/rate"] != 5, "change"
        )
        wanted = [{"name": "/of/new", "value": [1.5, 2.5]}, {"name": "/secret", "value": "y"}]
        client.send({"op": "setParameters", "parameters": wanted, "id": "set"})
        wait_for(lambda: rospy.get_param("/of/new", 0) == [1.5, 2.5], "set parameter")
        wait_for(lambda: any("/secret" in text for text in client.statuses()), "refusal")
        self.assertEqual(rospy.get_param("/secret"), "x")

    def test_what_is_set_is_answered_and_the_rest_is_refused_with_a_line(self):
        _, port = self.bridge("_param_whitelist:=['/set/.*']")
        client = self.client(port)
        wait_for(lambda: client.of("serverInfo"), "server")
        refused = {
            "/set/tree": {"value": {"a": 1}},
            "/set/bytes": {"value": "AAEC", "type": "byte_array"},
            "/set/large": {"value": 1 << 40},
            "/set/no name": {"value": 1},
            "/set/none": {},
        }
        wanted = [{"name": name, **value} for name, value in refused.items()]
        wanted.append({"name": "set/list", "value": ["a", "b"]})  # relative
        client.send({"op": "setParameters", "parameters": wanted, "id": "set"})
        answer = wait_for(lambda: client.of("parameterValues"), "answer")[0]
        self.assertEqual(answer["parameters"], [{"name": "/set/list", "value": ["a", "b"]}])
        self.assertEqual(rospy.get_param("/set"), {"list": ["a", "b"]})
        for name in refused:
            line = f"{name!r} is not set: "
            wait_for(lambda s=line: any(t.startswith(s) for t in client.statuses()), line)

    def test_a_refused_file_names_no_folder_of_this_machine(self):
        _, port = self.bridge()
        client = self.client(port)
        wait_for(lambda: client.of("serverInfo"), "server")
        for number, package in enumerate(("no_such_package", "rospy")):
            uri = f"package://{package}/none.dae"
            client.send({"op": "fetchAsset", "uri": uri, "requestId": number})
        wait_for(lambda: len(client.assets) == 2, "answers", seen=lambda: client.texts)
        for answer in client.assets:
            self.assertNotIn(b"/opt", answer)
            self.assertNotIn(b"/usr", answer)
            self.assertNotIn(b"ROS path", answer)

    def test_the_graph_has_what_the_whitelists_allow(self):
        _, port = self.bridge("_topic_whitelist:=['/gra.*']", "_service_whitelist:=['/as.*']")
        self.publisher("graphed", String)
        self.publisher("hidden", String)
        service = rospy.Service("ask", SetBool, lambda _: SetBoolResponse())
        self.addCleanup(service.shutdown)
        client = self.client(port)
        wait_for(lambda: client.of("serverInfo"), "server")
        client.send({"op": "subscribeConnectionGraph"})
        published = {"name": "/graphed", "publisherIds": [rospy.get_name()]}

        def graphed():
            updates = client.of("connectionGraphUpdate")
            return any(published in update["publishedTopics"] for update in updates)

        wait_for(graphed, "topic in the graph", seen=lambda: client.texts)
        updates = client.of("connectionGraphUpdate")
        shown = {
            entry["name"]
            for update in updates
            for kind in ("publishedTopics", "subscribedTopics", "advertisedServices")
            for entry in update[kind]
        }
        self.assertLessEqual({"/graphed"}, shown)
        self.assertLessEqual(shown, {"/graphed", "/ask"})


@claim(
    "A velocity of a client is ended by one zero when the client is lost, silent or done, and when "
    "the bridge ends; it is refused while another drives"
)
class DrivenTest(BridgeTest):
    def check_zero(self, heard):
        """Check that one zero comes after the motion, and nothing else."""
        wait_for(lambda: heard[-1] == ZERO, "zero")
        self.assertEqual(heard.count(ZERO), 1)

    def test_one_zero_comes_when_a_client_is_lost_closes_or_unadvertises(self):
        _, port = self.bridge()
        for end in ("cut", "close", "unadvertise"):
            client, heard = self.driver(port, f"/by_{end}")
            if end == "unadvertise":
                client.send({"op": "unadvertise", "channelIds": [1]})
            else:
                getattr(client, end)()
            self.check_zero(heard)

    def test_one_zero_comes_after_two_seconds_of_silence_and_driving_goes_on(self):
        _, port = self.bridge()
        client, heard = self.driver(port, "/silent")
        self.check_zero(heard)
        self.assertGreater(time.monotonic() - self.sent_s, SILENCE_S)
        self.drive(client, heard)

    def test_one_zero_comes_at_the_end_of_the_bridge(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            program, port = self.bridge()
            _, heard = self.driver(port, f"/ended_{int(number)}")
            os.kill(pid_of("/foxglove_bridge"), number)
            self.check_end(program)
            self.check_zero(heard)

    def test_a_stamped_velocity_is_ended_too(self):
        _, port = self.bridge()
        client, heard = self.client(port), self.record("/stamped", TwistStamped)
        client.advertise(1, "/stamped", TwistStamped._type)
        ahead = TwistStamped(twist=AHEAD)
        wait_for(lambda: client.publish(1, serialised(ahead)) or heard, "velocity")
        client.cut()
        wait_for(lambda: heard[-1].twist == ZERO, "zero")
        self.assertGreater(heard[-1].header.stamp.to_sec(), 0.0)

    def test_a_velocity_is_refused_while_another_client_or_node_drives(self):
        _, port = self.bridge()
        first, heard = self.driver(port, "/contested")
        second = self.client(port)
        second.advertise(1, "contested", TWIST)  # the same topic
        fast = Twist()
        fast.linear.x = 9.0
        refusal = "/contested: a message is refused: another client drives: stop it, then wait 2 s"

        def both():
            first.publish(1, serialised(AHEAD))
            second.publish(1, serialised(fast))
            return refusal in second.statuses()

        wait_for(both, "refusal")
        self.assertNotIn(fast, heard)
        node = self.connected("/contested", Twist)
        other = f"/contested: a message is refused: {rospy.get_name()} publishes there: stop it"

        def against_a_node():
            node.publish(ZERO)
            first.publish(1, serialised(AHEAD))
            return any(line.startswith(other) for line in first.statuses())

        wait_for(against_a_node, "refusal for a node")

    def test_other_messages_and_topics_are_published_or_refused_with_a_line(self):
        _, port = self.bridge("_client_topic_whitelist:=['/t.*']")
        client, heard = self.client(port), self.record("/talk", String)
        client.advertise(1, "/talk", String._type)
        wait_for(lambda: client.publish(1, serialised(String("a"))) or heard, "text")
        for number, about in enumerate(
            (("/x", TWIST), ("/t1", "no_msgs/No"), ("/t2", TWIST, "json"), ("a\x1bb", TWIST))
        ):
            client.advertise(number + 2, *about)
            line = f"{about[0]!r} cannot be published: "
            wait_for(lambda s=line: any(t.startswith(s) for t in client.statuses()), line)
        self.publisher("taken", Empty)
        client.advertise(9, "/taken", String._type)
        line = "'/taken' cannot be published: the master has std_msgs/Empty there"
        wait_for(lambda: any(t.startswith(line) for t in client.statuses()), line)
        self.assertEqual(client.channel("/taken")["schemaName"], Empty._type)
        client.publish(1, b"\xff\xff\xff\xff")
        wait_for(lambda: any("not a std_msgs/String" in s for s in client.statuses()), "line")

    def test_a_new_topic_has_the_type_of_its_first_client_until_that_leaves(self):
        _, port = self.bridge()
        first, second = self.client(port), self.client(port)
        first.advertise(1, "/new", String._type)
        self.assertEqual(first.channel("/new")["schemaName"], String._type)
        second.advertise(1, "/new", TWIST)
        line = "'/new' cannot be published: another client publishes std_msgs/String there"
        wait_for(lambda: line in second.statuses(), line)
        first.send({"op": "unadvertise", "channelIds": [1]})
        first.advertise(2, "/new", TWIST)  # at once
        # rospy does not connect again to a publisher whose type was another one.
        wait_for(lambda: first.channel("/new")["schemaName"] == TWIST, "channel of the new type")
        heard = self.record("/new", Twist)
        wait_for(lambda: first.publish(2, serialised(AHEAD)) or AHEAD in heard, "velocity")


@claim("A client that does not read or sends nonsense costs the others of the bridge nothing")
class ClientsTest(BridgeTest):
    def test_others_get_all_while_one_does_not_read(self):
        _, port = self.bridge("_send_buffer_limit:=100000")
        publisher = self.publisher("big", String, queue_size=1000)
        stalled, reader = self.client(port), self.client(port)
        for client in (stalled, reader):
            client.subscribe("/big")
        wait_for(publisher.get_num_connections, "subscription")
        publisher.publish("first")
        wait_for(lambda: stalled.data("/big") and reader.data("/big"), "first message")
        stalled.stall()
        text = "x" * 200_000
        for number in range(1, 151):  # 30 MB, more than all buffers on the way
            publisher.publish(text)
            wait_for(lambda n=number: len(reader.data("/big")) > n, f"message {number}")
        self.assertEqual(set(reader.data("/big")[1:]), {serialised(String(text))})

    def test_nonsense_gets_an_answer_and_the_next_message_is_obeyed(self):
        program, port = self.bridge()
        client = self.client(port)
        self.assertEqual(client.subprotocol, OLD_NAME)
        for nonsense in ("{", {"op": "nonsense"}, {"op": "subscribe"}, b"\x09x", "", b"\x01"):
            count = len(client.statuses())
            client.send(nonsense)
            wait_for(lambda c=count: len(client.statuses()) > c, f"answer to {nonsense!r}")
        client.subscribe("/rosout")
        client.publish(99, b"no such channel")
        with socket.create_connection(("127.0.0.1", port)) as other:
            other.sendall(b"GET / HTTP/1.1\r\n\r\n")
            self.assertNotIn(b"101", other.recv(100))
        rospy.logwarn("a line")
        wait_for(lambda: client.data("/rosout"), "message")
        self.end(program)

    def test_a_close_is_answered(self):
        _, port = self.bridge()
        client = self.client(port)
        client.close()
        wait_for(lambda: client.of("closed"), "end of the connection")
        self.assertEqual(client.close_code, NORMAL_CLOSE)

    def test_the_bridge_ends_with_its_master(self):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        master = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
        roscore = self.start("roscore", "-p", str(port), **master)
        wait_for(lambda: "started core service" in roscore.output, "master")
        bridge = self.start(BRIDGE, "_port:=0", **master)
        wait_for(lambda: "ws://127.0.0.1" in bridge.output, "bridge", seen=lambda: bridge.output)
        roscore.interrupt()
        self.assertEqual(bridge.wait(), 1, bridge.output)
        self.assertIn("foxglove_bridge: the ROS master has exited", bridge.output)
        self.assertNotIn("Traceback", bridge.output)

    def test_a_client_with_tls_is_served_and_one_without_it_is_not(self):
        folder = self.folder()
        certificate, key = folder / "certificate.pem", folder / "key.pem"
        request = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"]
        request += ["-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1"]
        files = ["-out", certificate, "-keyout", key]
        subprocess.run([*request, *files], check=True, capture_output=True)
        program, port = self.bridge("_tls:=true", f"_certfile:={certificate}", f"_keyfile:={key}")
        self.assertIn("wss://127.0.0.1", program.output)
        trust = ssl.create_default_context(cafile=str(certificate))
        with socket.create_connection(("127.0.0.1", port)) as plain:
            plain.sendall(b"GET / HTTP/1.1\r\n\r\n")
            self.assertEqual(plain.recv(100), b"")
        client = self.enter(SocketClient(port, tls=trust))
        client.subscribe("/rosout")
        rospy.logwarn("a line")
        wait_for(lambda: client.data("/rosout"), "message")
        self.end(program)
        self.assertNotIn("SSL", program.output)

    def test_mistakes_are_one_line(self):
        _, port = self.bridge("__name:=first")
        for parameter, words in (
            (f"_port:={port}", f"~port: {port}: Address already in use; choose another: port:="),
            ("_address:=999.9.9.9", "~address: '999.9.9.9': "),
            ("_address:=192.0.2.1", "~address: '192.0.2.1': "),
            ("_tls:=true", "~tls: true: give certfile:= and keyfile:=, too"),
            ("_port:=70000", "~port: 70000: must be a port"),
            ("_topic_whitelist:=['(']", "'(' is not a regular expression"),
            ("_capabilities:=[clientpublish]", "must be a list of some of clientPublish"),
            ("_prot:=8765", "did you mean ~port?"),
        ):
            self.check_mistake(self.start(BRIDGE, parameter), words)
        paths = os.environ["PYTHONPATH"].split(":")
        without = ":".join(path for path in paths if "/foxglove/" not in path)
        alone = self.start(BRIDGE, PYTHONPATH=without)
        self.check_mistake(alone, "foxglove-sdk is missing; ./tutorial foxglove installs it")
        keys = "_tls:=true", "_certfile:=/none", "_keyfile:=/none"
        self.check_mistake(self.start(BRIDGE, *keys), "~certfile: '/none'", "No such file")

    def test_a_parameter_without_effect_is_one_line(self):
        program, _ = self.bridge("_use_compression:=true")
        wait_for(lambda: "use_compression: True has no effect here" in program.output, "line")
