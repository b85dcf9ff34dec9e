#!/usr/bin/python3
"""Commands in, pose out, of a robot whose names, start and unequal wheels are parameters."""

from math import cos, nan, pi, sin

from fake_turtlebot_stepping import SteppedRobot
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from tutorial_testing.robot import Moment
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


def after(v, w, seconds):
    """The pose after an arc from the start, (1, -2) with the heading pi / 2."""
    ahead, left = v / w * sin(w * seconds), v / w * (1 - cos(w * seconds))
    return 1.0 - left, -2.0 + ahead, pi / 2 + w * seconds


class DriveTest(RosTest):
    def test_a_command_is_limited_and_the_robot_stops_by_itself(self):
        log, transforms = self.record("/rosout", Log), self.record("/tf", TFMessage)
        joints = self.record("joint_states", JointState)
        told, truths = (self.record(one, Odometry) for one in ("odom", "base_pose_ground_truth"))
        robot = self.enter(SteppedRobot())
        robot.command(1.4, 1.0, (0.7, 0.5))  # the radius stays
        robot.step(0.2)
        robot.command(nan, 0.0, (0.7, 0.5))  # neither obeyed nor a sign of life
        robot.step(1.0)
        stamp = robot.now.stamp

        def newest(messages):
            """Return the message of a topic that is of the end."""
            is_there = lambda: messages and messages[-1].header.stamp.to_sec() == stamp  # noqa: E731
            return wait_for(is_there, "message of the end") and messages[-1]

        # Wheels of 0.8 and 1.2 of nominal, 0.2 m apart: in truth 0.52 and 0.9 m/s.
        for messages, arc in ((told, (0.7, 0.5)), (truths, (0.71, 1.9))):
            pose = Moment.of(newest(messages)).pose
            for value, expected in zip(pose, after(*arc, 0.6)):
                self.assertAlmostEqual(value, expected, delta=1e-9)
        self.assertFalse(robot.moves)
        frames = told[-1].header.frame_id, told[-1].child_frame_id
        self.assertEqual((*frames, *newest(joints).name), ("home", "hull", "port", "starboard"))
        self.assertEqual(transforms, [])  # ~publish_tf is false

        def warnings():
            return [line.msg for line in log if line.level >= Log.WARN]

        wait_for(lambda: len(warnings()) >= 2, "warnings")
        self.assertEqual(len(warnings()), 2, warnings())
        for word, warning in zip(("scaled down", "not a finite number"), warnings()):
            self.assertIn(word, warning)


if __name__ == "__main__":
    run()
