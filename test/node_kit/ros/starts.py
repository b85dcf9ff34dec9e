"""Starting a node never disturbs running ones: what runs, what is started, what goes on."""

import re

import pytest
import rosgraph
import rospy
from rospy import AnyMsg

from node_kit.ros.graph.ros_api import known_nodes
from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

MASTER = rosgraph.get_master_uri()
SIMULATOR = (node_path("fake_turtlebot_sim", "fake_turtlebot.py"),)
ROBOT = "rosrun fake_turtlebot_sim fake_turtlebot.py"
TURTLEBOT = "roslaunch fake_turtlebot_sim minimal.launch"
CLASS = "roslaunch cockpit classroom.launch"
RECORDING = "roslaunch joy2twist launch_bag.launch rviz:=false"
# What runs, and topics whose messages must continue: what is refused, with words of its one line;
# then what may run beside it, with a topic that shows it.
TABLE = {
    ("roslaunch fake_turtlebot_sim fake_turtlebot.launch", "/odom", "/joint_states"): (
        [(ROBOT, "/fake_turtlebot runs already"),
         (f"{ROBOT} _rate:=abc", "~rate: 'abc': must be a number"),
         (TURTLEBOT, "/robot_state_publisher runs already"),
         (RECORDING, "/fake_turtlebot runs already")],
        [(f"{ROBOT} __name:=another odom:=odom2", "/odom2")]),
    (TURTLEBOT, "/odom"): (
        [("rosrun fake_turtlebot_sim cmd_vel_mux.py", "/cmd_vel_mux runs already"),
         (TURTLEBOT, "/mobile_base runs already")], []),
    (f"{CLASS} robots:=30 cockpit:=false", "/robot_1/odom", "/robot_30/odom"): (
        [(f"{CLASS} robots:=3", "/classroom runs already")],
        [("roslaunch fake_turtlebot_sim fake_turtlebot.launch", "/odom"), (RECORDING, "/joy")]),
    (f"{RECORDING} cockpit:=false", "/odom", "/joy"): (
        [(RECORDING, "runs already"),
         ("roslaunch joy2twist launch_joy_node_realTurtlebot.launch rviz:=false",
          "/myjoystick2twist runs already"),
         ("rosrun joy2twist joy2twist.py __name:=myjoystick2twist _axis_linear:=foo",
          "~axis_linear: 'foo'")], []),
    ("roslaunch gamepad joystick.launch joy_dev:=/none", "/diagnostics"): (
        [("roslaunch gamepad joystick.launch", "/joy_node runs already")], []),
}  # fmt: skip


def started_by(command):
    words = command.split()
    if words[0] == "rosrun":
        words[:3] = [node_path(*words[1:3])]
    return Program(*words)


@claim("A start never harms what runs; of two nodes with one name the older ends")
@pytest.mark.long
class StartsTest(RosTest):
    def watch(self, topic):
        """Return the messages of a topic, once there is one."""
        messages = self.record(topic, AnyMsg)
        wait_for(lambda: messages, f"messages on {topic}")
        return messages

    def check_goes_on(self, messages):
        count = len(messages)
        wait_for(lambda: len(messages) > count, "one more message")

    def test_a_start_is_refused_or_runs_beside_what_runs(self):
        for (runs, *topics), (refused, both) in TABLE.items():
            with Program(*runs.split()) as running:
                watches = [self.watch(topic) for topic in topics]
                nodes = re.findall(r"process\[(\S+)-\d+\]: started", running.output)
                wait_for(lambda n=nodes: {f"/{name}" for name in n} <= known_nodes(MASTER), "nodes")
                for command, words in refused:
                    with started_by(command) as started:
                        self.assertEqual(started.wait(), 1, f"{command}: {started.output}")
                        self.assertEqual(started.output.count(words), 1, started.output)
                        self.assertNotIn("Traceback (most", started.output)
                for command, topic in both:
                    with started_by(command) as started:
                        self.watch(topic)
                        started.interrupt()
                        started.wait()
                for messages in watches:
                    self.check_goes_on(messages)
                self.assertFalse(running.ended, runs)
                self.assertNotIn("new node registered", running.output)
                self.assertNotIn("process has died", running.output)
                running.interrupt()
                running.wait()

    def test_the_master_keeps_no_parameters_of_a_command_line(self):
        with Program(*SIMULATOR, "_robots:=3", "__name:=three"):
            self.watch("/robot_3/odom")
            self.assertFalse(rospy.has_param("/three/robots"))

    def test_of_two_talkers_with_one_name_the_older_ends_and_ctrl_c_ends_the_other(self):
        # As node_kit's roscore.xml does, which roslaunch reads only in a shell of the suite.
        rospy.set_param("/rosout_disable_topics_generation", False)
        talker, chatter = (node_path("beginner_tutorials", "talker.py"), "--unique"), "chatter"
        first, _ = self.start(*talker), self.watch(chatter)
        second = self.start(*talker)
        self.check_end(first)
        self.assertIn("new node registered with same name", first.output)
        self.watch(chatter)
        self.end(second)

    def test_a_robot_is_replaced_by_one_with_take_over(self):
        old, odometry = self.start(*SIMULATOR, "__name:=replaced"), self.watch("odom")
        self.start(*SIMULATOR, "__name:=replaced", "_take_over:=true")
        self.check_end(old)
        self.check_goes_on(odometry)
