"""doctor.py as a user runs it: first all is well, then one fault after another is added."""

import rospy
from geometry_msgs.msg import TransformStamped, Twist
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from tutorial_testing.claims import claim
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import Stopwatch

LONGEST_S = 15.0
NOBODYS = "192.0.2.7"  # an address for documentation (RFC 5737)


class FindingsTest(RosTest):
    def doctor(self, **environment):
        """Return (exit code, all lines except the last) of a run that exits in time."""
        watch = Stopwatch()
        with Program(node_path("tutorial_tools", "doctor.py"), **environment) as program:
            code, output = program.wait(), program.output
        self.assertLess(watch.took_s, LONGEST_S)
        *lines, summary = output.splitlines()
        self.assertRegex(summary, r"^doctor: \d+ ok, \d+ wrong, \d+ unknown$", output)
        return code, lines

    def wrong(self, *words, **environment):
        """Check that each of these words is in a line that is wrong; return those lines."""
        code, lines = self.doctor(**environment)
        lines = [line for line in lines if line.startswith("wrong")]
        missing = [word for word in words if not any(word in line for line in lines)]
        self.assertEqual((code, missing), (1, []), lines)
        return lines

    @claim("It finds these on a live system, within 15 s")
    def test_beside_a_drive_all_is_well_and_then_one_thing_after_the_other_is_not(self):
        robot = self.enter(Robot())
        launch = ("joy2twist", "launch_bag.launch", "cockpit:=false", "rviz:=false")
        with Program("roslaunch", *launch) as drive:
            robot.first(lambda moment: moment.v > 0.1, "moving robot")
            code, lines = self.doctor()
            self.assertEqual((code, [line for line in lines if line.startswith("wrong")]), (0, []))
            way = "/rosbag -> /joy -> /myjoystick2twist -> /cmd_vel -> /fake_turtlebot"
            for words in (way, "says: driving", "frames, each from one node"):
                self.assertIn(words, "\n".join(lines))
            seen = f"ROS_IP={NOBODYS} is no address of this machine"
            self.assertEqual(len(self.wrong(seen, ROS_IP=NOBODYS)), 1)
            self.publisher("/cmd_vel", Twist)
            old = type("String", (String,), {"_md5sum": "0" * 32})
            self.publisher("/old", old)
            self.hear("/old", String, print)
            other = TransformStamped(child_frame_id="base_footprint")
            other.header.frame_id = "odom"
            self.publisher("/tf", TFMessage, latch=True).publish([other])
            rivals = "/cmd_vel is sent by /doctor_findings, /myjoystick2twist at once"
            too = "/doctor_findings, /fake_turtlebot send base_footprint at once"
            definition = "/doctor_findings has another definition of std_msgs/String (md5 00000000)"
            past, name = "doctor_findings sends stamps of the past", "cannot be looked up"
            self.wrong(rivals, too, past, name, definition, ROS_HOSTNAME="nobody.invalid")
            rospy.set_param("/use_sim_time", True)
            self.addCleanup(rospy.delete_param, "/use_sim_time")
            self.wrong("no /clock arrives")
            drive.interrupt()
            drive.wait()
