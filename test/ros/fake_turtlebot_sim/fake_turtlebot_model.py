#!/usr/bin/python3
"""The model's links hang on the robot that they belong to, alone and in a classroom."""

import rospy
from tf2_msgs.msg import TFMessage

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

# Child: parent, both behind the name of the robot.
LINKS = {
    "base_footprint": "odom",
    "base_link": "base_footprint",
    "gyro_link": "base_link",
    "stack_link": "base_link",
    "wheel_left_link": "base_link",
    "wheel_right_link": "base_link",
}


class ModelTest(RosTest):
    def test_every_link_hangs_on_the_odometry_of_its_robot(self):
        parents = {}

        def on_transforms(message):
            parents.update((t.child_frame_id, t.header.frame_id) for t in message.transforms)

        rospy.Subscriber("/tf", TFMessage, on_transforms)
        rospy.Subscriber("/tf_static", TFMessage, on_transforms)
        expected = {p + link: p + parent for p in ("", "bob/") for link, parent in LINKS.items()}
        expected.update({f"{name}/odom": "world" for name in ("ada", "bob")})
        wait_for(lambda: parents.keys() >= expected.keys(), "transforms of every link")
        self.assertEqual({link: parents[link] for link in expected}, expected)


if __name__ == "__main__":
    run()
