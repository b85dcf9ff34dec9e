"""rbx1's fake TurtleBot has the names that the programs and views of its book use."""

import rosgraph
import rospy
import tf2_ros
from sensor_msgs.msg import JointState, LaserScan
from tf2_msgs.msg import TFMessage

from tutorial_testing.claims import claim
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

# Where links are in the frame base_footprint, x, y, z [m]: sums of the origins in rbx1_description.
PLACES = {
    "base_link": (0.0, 0.0, 0.017),
    "left_wheel_link": (0.0, 0.13, 0.032),
    "right_wheel_link": (0.0, -0.13, 0.032),
    "laser": (-0.065, 0.0, 0.092),
    "plate_0_link": (-0.04334, 0.0, 0.08475704),
    "plate_1_link": (-0.00266, 0.0, 0.14190704),
    "plate_2_link": (-0.00266, 0.0, 0.19910784),
    "plate_3_link": (-0.01582, 0.0, 0.40545744),
    "camera_link": (-0.0870982, 0.0, 0.30385744),
    "camera_depth_frame": (-0.0870982, 0.018, 0.30385744),
    "camera_rgb_frame": (-0.0870982, -0.005, 0.30385744),
}


@claim("rbx1's fake TurtleBot has the names of the original's node, joints and frames")
class Rbx1Test(RosTest):
    def test_node_joints_and_clock_are_those_of_arbotix(self):
        joints, master = self.record("joint_states", JointState), rosgraph.Master(rospy.get_name())
        wait_for(lambda: joints, "joints")
        self.assertEqual(joints[0].name, ["base_l_wheel_joint", "base_r_wheel_joint"])
        subscribers = dict(master.getSystemState()[1])
        self.assertEqual(subscribers["/cmd_vel"], ["/arbotix"])
        self.assertIs(rospy.get_param("/use_sim_time"), False)

    def test_frames_are_those_of_the_books_robot_and_each_has_one_parent(self):
        laid = [self.record(topic, TFMessage) for topic in ("/tf", "/tf_static")]
        scans = self.record("scan", LaserScan)
        frames = tf2_ros.Buffer()
        tf2_ros.TransformListener(frames)
        known = lambda link: frames.can_transform("base_footprint", link, rospy.Time())  # noqa: E731
        wait_for(lambda: scans and all(map(known, PLACES)), "frames, and a scan")
        for link, place in PLACES.items():
            moved = frames.lookup_transform("base_footprint", link, rospy.Time())
            there = moved.transform.translation
            for value, given in zip((there.x, there.y, there.z), place):
                self.assertAlmostEqual(value, given, msg=link)
        self.assertEqual(scans[0].header.frame_id, "camera_depth_frame")
        messages = [message for of in laid for message in list(of)]
        links = [link for message in messages for link in message.transforms]
        parents = {(link.child_frame_id, link.header.frame_id) for link in links}
        self.assertEqual(len(parents), len(dict(parents)))
