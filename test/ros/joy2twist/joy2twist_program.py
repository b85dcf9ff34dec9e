"""joy2twist as a program: how it starts, what it shows, how it ends, and without its master."""

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import BUSY_S, Stopwatch, wait_for

LONGEST_EXIT_S = 1.5 + BUSY_S
NOWHERE = "http://localhost:9"  # the port named "discard": no master lives there
FORWARD = "{axes: [0.0, 0.5]}"
JOY2TWIST = node_path("joy2twist", "joy2twist.py")


class ProgramTest(RosTest):
    def test_rosnode_kill_stops_the_robot_in_time(self):
        """The stick stays forward, but the last velocity is zero."""
        joystick, speeds = self.publisher("joy", Joy), []
        robot = self.hear("cmd_vel", Twist, lambda twist: speeds.append(twist.linear.x))
        node = self.start(JOY2TWIST)
        forward = lambda: joystick.publish(Joy(axes=[0.0, 0.5, -0.25]))  # noqa: E731
        wait_for(lambda: forward() or speeds, "velocity")
        kill = self.start("rosnode", "kill", "/NewJoy2Twist")
        wait_for(lambda: forward() or speeds[-1] == 0.0, "zero")
        watch = Stopwatch()
        wait_for(lambda: forward() or node.ended, "end")
        self.assertLess(watch.took_s, LONGEST_EXIT_S)
        self.check_end(node)
        wait_for(lambda: robot.get_num_connections() == 0, "end of the connection")
        self.assertEqual((speeds[-1], {*speeds[:-1]}), (0.0, {0.5}))
        for line in ("/NewJoy2Twist: Get from Joy [0.00, 0.50, -0.25]\n", "Stopping the node"):
            self.assertIn(line, node.output)
        kill.wait()

    def test_under_simulated_time_that_stands_still_silence_stops_the_robot(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        velocities, joystick = self.record("cmd_vel", Twist), self.publisher("joy", Joy)
        self.start(JOY2TWIST, "_joy_timeout:=0.5", "_max_joy_age:=0.5")
        joy = Joy(axes=[0.0, 0.5])
        wait_for(lambda: joystick.publish(joy) or velocities, "velocity")
        wait_for(lambda: velocities[-1] == Twist(), "zero")
        self.assertEqual(velocities[0].linear.x, 0.5)

    def test_a_mistake_and_a_missing_master_get_one_line(self):
        rospy.set_param("/wrong/joy_timeout", -1)
        for given, environment, words in (
            (["__name:=wrong"], {}, ("~joy_timeout", "-1", "0 to 60 s", "/wrong")),
            (["_axis_linear:=["], {}, ("command-line",)),
            ([], {"ROS_MASTER_URI": NOWHERE}, (NOWHERE, "roscore")),
            ([], {"ROS_MASTER_URI": "nonsense"}, ("'nonsense'", "http://localhost:11311")),
        ):
            self.check_mistake(Program(JOY2TWIST, *given, **environment), *words)

    def test_without_its_master_it_drives_on_and_stops_at_the_end(self):
        port = str(free_port())
        own = {"ROS_MASTER_URI": f"http://localhost:{port}"}
        # Not roscore, which has its master in a session of its own, out of reach.
        master = self.start("rosmaster", "--core", "-p", port, **own)
        wait_for(rosgraph.Master("/test", own["ROS_MASTER_URI"]).is_online, "master")
        node = self.start(JOY2TWIST, **own)
        self.start("rostopic", "pub", "-r", "50", "joy", "sensor_msgs/Joy", FORWARD, **own)
        echo = self.start("rostopic", "echo", "-p", "cmd_vel/linear/x", **own)
        wait_for(lambda: ",0.5" in echo.output, "velocity")
        master.kill()
        count = echo.output.count(",0.5")
        wait_for(lambda: echo.output.count(",0.5") > count + 50, "more velocities")
        self.assertNotIn(",0.0", echo.output)
        self.end(node, deadline_s=LONGEST_EXIT_S)
        wait_for(lambda: echo.output.endswith(",0.0\n"), "zero")
