"""The launch files of turtlebot_teleop behave as those of the real package."""

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from tutorial_testing.claims import claim
from tutorial_testing.keys import Tmux
from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

TELEOP = "/cmd_vel_mux/input/teleop"
LB, L1 = 4, 10


def pair(twist):
    """Return speed and turn rate, rounded for comparison."""
    return round(twist.linear.x, 6), round(twist.angular.z, 6)


@claim("turtlebot_teleop drives by keys and gamepads as the real one")
class TeleopTest(RosTest):
    def test_a_key_speeds_up_in_steps_and_its_release_slows_down(self):
        robot, sent = self.enter(Robot()), self.record(TELEOP, Twist)
        terminal = Tmux("roslaunch turtlebot_teleop keyboard_teleop.launch")
        self.addCleanup(terminal.close)
        wait_for(lambda: sent, "first velocity, a zero")
        terminal.hold("i", lambda: pair(sent[-1]) == (0.2, 0.0), "full speed")
        wait_for(lambda: robot.moves, "motion")
        speeds = [pair(twist)[0] for twist in sent]
        steps = {round(b - a, 6) for a, b in zip(speeds, speeds[1:])}
        self.assertLessEqual(steps, {0.0, 0.02, -0.02})
        wait_for(lambda: pair(sent[-1]) == (0.0, 0.0), "slow end")
        terminal.press("q")
        terminal.hold("u", lambda: pair(sent[-1]) == (0.22, 1.1), "10 % more, to the left")
        terminal.press("k")
        wait_for(lambda: pair(sent[-1]) == (0.0, 0.0), "stop at once")
        robot.wait_for_rest()
        count = len(sent)
        terminal.press("C-c")
        wait_for(lambda: terminal.ended, "end")
        wait_for(lambda: len(sent) > count, "last velocity")  # it may arrive after the exit
        self.assertEqual(pair(sent[-1]), (0.0, 0.0))
        self.assertNotIn("Traceback", terminal.history)

    def test_a_gamepad_drives_while_its_dead_man_button_is_held(self):
        rospy.set_param("/joystick/dev", "/none")
        for file, button in (("logitech.launch", LB), ("ps3_teleop.launch", L1)):
            sent, joy = self.record(TELEOP, Twist), self.publisher("/joy", Joy)
            with Program("roslaunch", "turtlebot_teleop", file) as launch:
                wait_for(joy.get_num_connections, "subscriber of joy")
                held = Joy(axes=[0.5, 1.0], buttons=[k == button for k in range(12)])
                joy.publish(Joy(axes=held.axes, buttons=[not b for b in held.buttons]))
                joy.publish(held)
                moving = lambda sent=sent: [pair(t) for t in sent if t != Twist()]  # noqa: E731
                wait_for(lambda moving=moving: len(moving()) > 3, "velocities, repeated")
                self.assertEqual(set(moving()), {(0.5, 0.75)})
                del sent[:]
                joy.publish(Joy(axes=held.axes, buttons=[0] * 12))
                wait_for(lambda sent=sent: Twist() in sent, "zero at the release")
                joy.publish(held)
                wait_for(lambda sent=sent: sent[-1] != Twist(), "another drive")
                self.assertEqual(sent.count(Twist()), 1)
                self.end(launch)
