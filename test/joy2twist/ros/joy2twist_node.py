"""The node joy2twist: its answers to Joys, its start and its end, and what happens after a loss.

Unit tests cover the rules; this shows that each parameter, topic and clock reaches them.
"""

import json
import time
from math import inf, nan

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, free_port
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import BUSY_S, Stopwatch, wait_for

LB, STOP, RESET = 4, 1, 2
QUIET_S = 1.0  # longer than any repetition of zero, and any watchdog here
ROBOTS = {"enable_button": LB, "joy_timeout": 0.5, "stop_messages": 3}
ARMS = {**ROBOTS, "arm_on_neutral": True}
LONGEST_EXIT_S = 1.5 + BUSY_S
NOWHERE = "http://localhost:9"  # the port named "discard": no master lives there
FORWARD = "{axes: [0.0, 0.5]}"
JOY2TWIST = node_path("joy2twist", "joy2twist.py")


def joy(forward, *held, age_s=0.0):
    """A Joy with this stick position and these buttons held."""
    message = Joy(axes=[0.0, forward], buttons=[int(n in held) for n in range(5)])
    message.header.stamp = rospy.Time.now() - rospy.Duration(age_s)
    return message


@claim("Dead-man button, timeout, age, arming, soft and hard stop")
class RulesTest(RosTest):
    def begin(self, **given):
        """Start a node with these parameters, and connect a joystick at rest."""
        self.sent, self.states = [], []  # linear.x [m/s]
        self.hear("cmd_vel", Twist, lambda twist: self.sent.append(twist.linear.x))
        hear = lambda array: self.states.extend(s.message for s in array.status)  # noqa: E731
        self.hear("/diagnostics", DiagnosticArray, hear)
        parameters = [f"_{name}:={json.dumps(value)}" for name, value in given.items()]
        self.start(JOY2TWIST, *parameters)
        self.plug_in()
        wait_for(self.goes_round, "velocity")
        self.joystick.publish(joy(0.0))
        self.wait_for_quiet()

    def goes_round(self):
        """Release, then drive. One message may be lost before all nodes are connected."""
        for message in (joy(0.0), joy(0.1, LB)):
            self.joystick.publish(message)
        return self.sent

    def plug_in(self):
        self.joystick = self.connected("joy", Joy)

    def wait_for_quiet(self):
        count, since_s = -1, 0.0

        def is_quiet():
            nonlocal count, since_s
            if len(self.sent) != count:
                count, since_s = len(self.sent), time.monotonic()
            return time.monotonic() - since_s > QUIET_S

        wait_for(is_quiet, "silence")

    def check(self, joys, speeds):
        """Publish these Joys at once; check that the node sends these speeds and then nothing."""
        self.sent.clear()
        for message in joys:
            self.joystick.publish(message)
        self.wait_for_quiet()
        self.assertEqual(self.sent, speeds)

    def wait_for_state(self, state):
        wait_for(lambda: self.states and self.states[-1].startswith(state), state)

    @claim(
        "The tutorial's node: each Joy gives one Twist, zero for what cannot be used, nothing else"
    )
    def test_bare_it_answers_each_message_by_one_velocity_and_what_is_unusable_by_zero(self):
        self.begin()
        bad = [Joy(axes=axes) for axes in ([nan, 0.5], [0.0, inf], [0.5], [])]
        self.check([*bad, joy(0.5), *[joy(0.25)] * 60], [0.0] * 4 + [0.5] + [0.25] * 60)
        self.sent.clear()
        self.joystick.unregister()
        self.wait_for_quiet()
        self.assertEqual(self.sent, [0.0] * 5)
        self.wait_for_state("stopped: the joystick node has left")
        self.plug_in()
        self.check([joy(0.25), joy(0.0)], [0.25, 0.0])

    def test_release_silence_and_age_give_zero_three_times(self):
        self.begin(**ROBOTS, max_joy_age=1.0)
        stop = [0.0] * 3
        self.check([joy(0.25, LB), *[joy(0.25)] * 20], [0.25, *stop])
        self.wait_for_state("stopped: no message for 0.5 s")
        self.check([joy(0.25, LB)] * 10, [0.25] * 10 + stop)
        self.check([joy(0.25, LB), *[joy(0.25, LB, age_s=2.0)] * 5], [0.25, *stop])

    @claim(
        "A gamepad out of reach, a joystick that does not change, stops the robot after "
        "`~vigilance_timeout`"
    )
    def test_a_joystick_that_does_not_change_stops(self):
        self.begin(**ARMS, vigilance_timeout=1.0)
        self.joystick.publish(joy(0.0))

        def is_noticed():
            self.joystick.publish(joy(0.5, LB))
            return "stopped: the joystick has not changed for 1 s" in "".join(self.states)

        wait_for(is_noticed, "state of a joystick that does not change")
        self.wait_for_quiet()
        self.check([joy(0.25, LB)] * 5, [])
        self.check([joy(0.0), joy(0.5, LB), joy(0.0)], [0.5, 0.0, 0.0, 0.0])

    def test_the_stop_button_sends_zeros_until_it_is_reset_and_all_is_released(self):
        self.begin(**ARMS, stop_button=STOP, stop_reset_button=RESET)
        self.sent.clear()
        for message in (joy(0.0), joy(0.5, LB), joy(0.5, LB, STOP)):
            self.joystick.publish(message)
        wait_for(lambda: len(self.sent) > 30, "zeros")
        self.assertEqual((self.sent[0], {*self.sent[1:]}), (0.5, {0.0}))
        self.wait_for_state("stopped: the stop button was pressed")
        self.joystick.publish(joy(0.0, RESET))
        self.wait_for_quiet()
        self.check([joy(0.5, LB)] * 3, [])
        self.check([joy(0.0), joy(0.25, LB)], [0.25, 0.0, 0.0, 0.0])


@claim(
    "Under simulated time the watchdogs go by the machine's clock; without a master it drives on "
    "and stops; however it is ended it sends zero and exits in time; a mistake is one line"
)
class ProgramTest(RosTest):
    def test_rosnode_kill_stops_the_robot_in_time(self):
        """The last velocity is zero, although the stick stays forward."""
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
            (["__name:=wrong"], {},
             ("~joy_timeout", "-1", "0 to 60 s", "rosparam delete /wrong/joy_timeout")),
            (["_axis_linear:=["], {}, ("command-line",)),
            ([], {"ROS_MASTER_URI": NOWHERE}, (NOWHERE, "roscore")),
            ([], {"ROS_MASTER_URI": "nonsense"}, ("'nonsense'", "http://localhost:11311")),
        ):  # fmt: skip
            self.check_mistake(Program(JOY2TWIST, *given, **environment), *words)

    def test_without_its_master_it_drives_on_and_stops_at_the_end(self):
        port = str(free_port())
        own = {"ROS_MASTER_URI": f"http://localhost:{port}"}
        # Not roscore: it starts its master in another session, out of reach.
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
