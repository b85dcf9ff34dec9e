"""turtlesim: each service, the wall, mimic, keys, and a square."""

import math
import subprocess

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from rosgraph_msgs.msg import Log
from std_srvs.srv import Empty
from turtlesim import srv
from turtlesim.msg import Color, Pose

from node_kit.ros.graph import ros_api
from tutorial_testing.claims import claim
from tutorial_testing.keys import Tmux
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

FIRST, MIDDLE, FIELD_M = "/turtlesim1/", 5.5444446, 499 / 45


def call(name, kind, *values):
    rospy.wait_for_service(name)
    return rospy.ServiceProxy(name, kind)(*values)


@claim("turtlesim drives, draws, serves and logs as the real one")
class TurtlesimTest(RosTest):
    def setUp(self):
        call(f"{FIRST}reset", Empty)
        self.poses = self.record(f"{FIRST}turtle1/pose", Pose)
        self.colors = self.record(f"{FIRST}turtle1/color_sensor", Color)
        self.logs = self.record("/rosout", Log)
        self.commands = self.connected(f"{FIRST}turtle1/cmd_vel", Twist)
        wait_for(lambda: self.poses and self.colors, "pose and color")

    def wait_for_pose(self, *wanted, poses=None):
        """Wait for x, y, theta, within the precision of float32."""
        poses = self.poses if poses is None else poses

        def is_there():
            now = poses and (poses[-1].x, poses[-1].y, poses[-1].theta)
            return now and all(abs(a - b) < 2e-6 for a, b in zip(now, wanted))

        wait_for(is_there, f"pose {wanted}", 30)

    def wait_for_log(self, words):
        wait_for(lambda: any(words in log.msg for log in list(self.logs)), f"log {words}", 30)

    def test_one_command_is_an_arc_of_a_second_and_the_mimic_drives_too(self):
        call("/turtlesim2/reset", Empty)  # it has mimicked other tests
        followers = self.record("/turtlesim2/turtle1/pose", Pose)
        self.commands.publish(Twist(linear=Vector3(x=2.0), angular=Vector3(z=1.8)))
        radius = 2.0 / 1.8
        x, y = MIDDLE + radius * math.sin(1.8), MIDDLE + radius * (1 - math.cos(1.8))
        self.wait_for_pose(x, y, 1.8)
        wait_for(lambda: followers and followers[-1].theta > 1.7, "mimic", 30)
        velocities = {(p.linear_velocity, round(p.angular_velocity, 6)) for p in followers}
        self.assertIn((2.0, 1.8), velocities)

    def test_services_of_the_field(self):
        name = call(f"{FIRST}spawn", srv.Spawn, 2.0, 3.0, 0.2, "").name
        self.assertEqual(name, "turtle2")
        self.wait_for_log("Spawning turtle [turtle2] at x=[2.000000], y=[3.000000], theta=[0.2000")
        self.wait_for_pose(2.0, 3.0, 0.2, poses=self.record(f"{FIRST}turtle2/pose", Pose))
        with self.assertRaisesRegex(rospy.ServiceException, r"turtled named \[turtle2\] already"):
            call(f"{FIRST}spawn", srv.Spawn, 2.0, 2.0, 0.2, name)
        call(f"{FIRST}kill", srv.Kill, "turtle2")
        end = lambda: f"{FIRST}turtle2/pose" not in dict(rospy.get_published_topics())  # noqa: E731
        wait_for(end, "end of its topics")

    def test_the_background_is_read_by_clear(self):
        for red in (150, 69):
            rospy.set_param(f"{FIRST}sim/background_r", red)
            call(f"{FIRST}clear", Empty)
            wait_for(lambda red=red: self.colors[-1] == Color(red, 7, 255), "background", 30)
        self.wait_for_log("Clearing turtlesim.")

    def test_teleports_draw_with_the_pen(self):
        call(f"{FIRST}turtle1/set_pen", srv.SetPen, 255, 0, 0, 5, 0)
        call(f"{FIRST}turtle1/teleport_absolute", srv.TeleportAbsolute, 2.0, 3.0, math.pi / 2)
        call(f"{FIRST}turtle1/teleport_relative", srv.TeleportRelative, 1.0, -math.pi / 2)
        self.wait_for_pose(3.0, 3.0, 0.0)
        wait_for(lambda: self.colors[-1] == Color(255, 0, 0), "line", 30)
        call(f"{FIRST}turtle1/set_pen", srv.SetPen, 0, 0, 0, 0, 1)
        call(f"{FIRST}turtle1/teleport_absolute", srv.TeleportAbsolute, 9.0, 1.0, 0.0)
        wait_for(lambda: self.colors[-1] == Color(69, 7, 255), "paper without a line", 30)
        uri = rosgraph.Master("/test").lookupNode(f"{FIRST}sim")
        answer, (_, picture) = ros_api.call(uri, "picture", 0)  # as the cockpit asks for it
        self.assertEqual((answer, picture[:11]), (ros_api.Answer.WELL, "iVBORw0KGgo"))  # a PNG

    def test_the_wall_holds_with_a_warning_and_nan_moves_nothing(self):
        self.commands.publish(Twist(linear=Vector3(x=math.nan)))
        self.wait_for_log("turtle1/cmd_vel is ignored: nan")
        self.commands.publish(Twist(linear=Vector3(x=8.0)))
        self.wait_for_pose(FIELD_M, MIDDLE, 0.0)
        self.wait_for_log("Oh no! I hit the wall! (Clamping from [x=11.")

    def test_a_square_is_drawn(self):
        poses = self.record("/turtlesim3/turtle1/pose", Pose)
        wait_for(lambda: poses and poses[-1].y > MIDDLE + 1.9, "side ahead and on the left", 60)

    def test_an_arrow_key_drives_and_q_ends(self):
        terminal = Tmux(f"rosrun turtlesim turtle_teleop_key __ns:={FIRST.strip('/')}")
        self.addCleanup(terminal.close)
        greeting = (
            f"Reading from keyboard\n{27 * '-'}\nUse arrow keys to move the turtle. 'q' to quit."
        )
        wait_for(lambda: greeting in terminal.screen, "greeting")
        terminal.hold("Up", lambda: self.poses[-1].linear_velocity == 2.0, "drive")
        terminal.press("q")
        wait_for(lambda: terminal.ended, "end")

    def test_keys_come_from_a_pipe_too_and_its_end_ends_the_node(self):
        command = node_path("turtlesim", "turtle_teleop_key"), f"__ns:={FIRST.strip('/')}"
        program = self.start(*command, stdin=subprocess.PIPE)
        program.type("\x1b[D")  # with the end of the line, which is no key here
        wait_for(lambda: self.poses[-1].angular_velocity == 2.0, "turn")
        program.close_input()
        self.check_end(program)

    def test_without_keys_it_says_where_to_start_it(self):
        program = Program(node_path("turtlesim", "turtle_teleop_key"))
        self.check_mistake(program, "no terminal here")
