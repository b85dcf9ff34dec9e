#!/usr/bin/python3
"""In real time: the rate, the stamps, the transform, the wheels."""

import statistics

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

PERIOD_S = 0.02
SAMPLE = 500  # periods, 10 s


class LiveTest(RosTest):
    def test_periods_do_not_drift_and_each_stamp_is_of_one_state(self):
        odometry, log = self.record("odom", Odometry), self.record("/rosout", Log)
        tf, joints = self.record("/tf", TFMessage), self.record("joint_states", JointState)
        cmd_vel = self.publisher("cmd_vel", Twist)
        wait_for(cmd_vel.get_num_connections, "subscriber of cmd_vel")
        cmd_vel.publish(Twist(Vector3(0.7, 0.0, 0.0), Vector3(0.0, 0.0, 1.0)))
        wait_for(lambda: len(odometry) >= SAMPLE and tf and joints, "messages")

        sample = odometry[:SAMPLE]
        stamps = [one.header.stamp.to_nsec() for one in sample]
        steps = [(b - a) * 1e-9 for a, b in zip(stamps, stamps[1:])]
        self.assertGreater(min(steps), 0.0)
        # A busy machine may lose a period; the phase it must keep.
        self.assertAlmostEqual(statistics.median(steps), PERIOD_S, delta=0.001)
        phases = [(stamp - stamps[0]) * 1e-9 % PERIOD_S for stamp in stamps]
        self.assertLess(statistics.median(min(one, PERIOD_S - one) for one in phases), 0.005)

        transforms = {one.header.stamp: one for array in tf for one in array.transforms}
        wheels = {one.header.stamp: one for one in joints}
        both = [one for one in sample if one.header.stamp in transforms.keys() & wheels.keys()]
        self.assertGreater(len(both), SAMPLE / 2)  # on a busy machine one is heard later
        for one in both:
            pose, place = one.pose.pose, transforms[one.header.stamp].transform
            self.assertEqual(pose.orientation, place.rotation)
            self.assertEqual(pose.position.x, place.translation.x)
            left, right = wheels[one.header.stamp].velocity
            twist = one.twist.twist
            self.assertAlmostEqual(0.035 * (left + right) / 2, twist.linear.x, delta=1e-12)
            self.assertAlmostEqual(0.035 * (right - left) / 0.23, twist.angular.z, delta=1e-12)
        lines = [line.msg for line in log if line.level >= Log.WARN]
        # rospy's word for a peer that came and went, as they do on a busy machine.
        self.assertEqual([line for line in lines if not line.startswith("Inbound TCP")], [])


if __name__ == "__main__":
    run()
