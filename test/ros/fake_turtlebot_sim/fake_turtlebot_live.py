#!/usr/bin/python3
"""In real time: the rate, the stamps, the transform, the timeout."""

import statistics

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

PERIOD_S = 0.02
SAMPLE = 500  # periods, 10 s
SPEED = 0.7  # [m/s]


class LiveTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.odometry, cls.transforms, cls.joints, cls.log = [], [], [], []
        rospy.Subscriber("odom", Odometry, cls.odometry.append)
        rospy.Subscriber("/tf", TFMessage, lambda m: cls.transforms.append(m.transforms[0]))
        rospy.Subscriber("joint_states", JointState, cls.joints.append)
        rospy.Subscriber("/rosout", Log, cls.log.append)
        cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        wait_for(cmd_vel.get_num_connections, "subscriber of cmd_vel")
        wait_for(lambda: cls.odometry and cls.transforms and cls.joints, "first messages")
        command = Twist()
        command.linear.x, command.angular.z = SPEED, 1.0
        cmd_vel.publish(command)
        wait_for(lambda: len(cls.odometry) >= SAMPLE, "odometry")

    def test_stamps_strictly_increase_and_periods_do_not_drift(self):
        stamps = [odometry.header.stamp.to_nsec() for odometry in self.odometry[:SAMPLE]]
        steps = [(b - a) * 1e-9 for a, b in zip(stamps, stamps[1:])]
        self.assertGreater(min(steps), 0.0)
        # A busy machine may lose a period; the phase it must keep.
        self.assertAlmostEqual(statistics.median(steps), PERIOD_S, delta=0.001)
        phases = [(stamp - stamps[0]) * 1e-9 % PERIOD_S for stamp in stamps]
        off = [min(phase, PERIOD_S - phase) for phase in phases]
        self.assertLess(statistics.median(off), 0.005)

    def test_transform_and_wheels_are_of_the_same_state_as_the_odometry(self):
        stamps = [transform.header.stamp for transform in list(self.transforms)]
        self.assertEqual(len(stamps), len(set(stamps)))  # none twice
        transforms = dict(zip(stamps, self.transforms))
        joints = {j.header.stamp: j for j in list(self.joints)}
        known = transforms.keys() & joints.keys()
        both = [one for one in self.odometry[:SAMPLE] if one.header.stamp in known]
        self.assertGreater(len(both), SAMPLE / 2)  # on a busy machine one is heard later
        for odometry in both:
            pose, transform = odometry.pose.pose, transforms[odometry.header.stamp]
            place = transform.transform.translation
            self.assertEqual((pose.position.x, pose.position.y), (place.x, place.y))
            self.assertEqual(pose.orientation, transform.transform.rotation)
            left, right = joints[odometry.header.stamp].velocity
            twist = odometry.twist.twist
            self.assertAlmostEqual(0.035 * (left + right) / 2, twist.linear.x, delta=1e-12)
            self.assertAlmostEqual(0.035 * (right - left) / 0.23, twist.angular.z, delta=1e-12)

    def test_nothing_is_complained_about(self):
        lines = [line.msg for line in self.log if line.level >= Log.WARN]
        # rospy's word for a peer that came and went, as they do on a busy machine.
        self.assertEqual([line for line in lines if not line.startswith("Inbound TCP")], [])


if __name__ == "__main__":
    run()
