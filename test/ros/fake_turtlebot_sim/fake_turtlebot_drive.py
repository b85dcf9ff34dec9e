#!/usr/bin/python3
"""Commands in, pose out: what to send and what to expect are data of the .test file.

~cases: for each name, which is the namespace of a robot of its own,
  commands: list of {send: [v, w], shown: [v, w] (if the robot executes another), wait: seconds}
  expect: names from below with values, exact to 1e-9; warnings: a word of each, in their order
"""

from fake_turtlebot_stepping import PERIOD_NS, CommandedRobot, World
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from tutorial_testing.robot import Moment
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


class DriveTest(RosTest):
    """One test method for every case; one clock for all of them, which never goes back."""

    world_ns = PERIOD_NS

    def play(self, name, case):
        commands, expect = case["commands"], case["expect"]
        robot, bases = self.enter(CommandedRobot(f"/{name}/")), set()
        self.hear("/tf", TFMessage, lambda m: bases.add(m.transforms[0].child_frame_id))
        log = self.record("/rosout", Log)
        joints = self.record(f"/{name}/joint_states", JointState)
        told, truths = (
            self.record(f"/{name}/{topic}", Odometry)
            for topic in ("odom", "base_pose_ground_truth")
        )
        world = World([robot], DriveTest.world_ns)
        for command in commands:
            v, w = command["send"]
            began_ns = world.command(robot, v, w, tuple(command.get("shown", (v, w))))
            world.step(command["wait"] - (world.now_ns - began_ns) * 1e-9)
        DriveTest.world_ns = world.now_ns
        stamp = robot.now.stamp

        def newest(messages):
            """Return the message of a topic that is of the end."""
            is_there = lambda: messages and messages[-1].header.stamp.to_sec() == stamp  # noqa: E731
            return wait_for(is_there, "message of the end") and messages[-1]

        result, end = robot.now._asdict(), newest(told)
        result.update(zip(("left_joint", "right_joint"), newest(joints).name))
        result.update(frame=end.header.frame_id, base_frame=end.child_frame_id)
        if any(key.startswith("true_") for key in expect):
            truth = Moment.of(newest(truths))._asdict()
            result.update({f"true_{key}": value for key, value in truth.items()})
        wait_for(lambda: bases, "transforms of the other robots")
        self.assertNotIn("hull", bases)  # ~publish_tf is false

        def warnings():
            node = f"/{name}/fake_turtlebot"
            return [line.msg for line in log if line.level >= Log.WARN and line.name == node]

        words = expect.pop("warnings", [])
        wait_for(lambda: len(warnings()) >= len(words), f"warnings {words}")
        self.assertEqual(len(warnings()), len(words), warnings())
        for word, warning in zip(words, warnings()):
            self.assertIn(word, warning)
        for key, value in expect.items():
            if isinstance(value, str):
                self.assertEqual(result[key], value, key)
            else:
                self.assertAlmostEqual(result[key], value, msg=key, delta=1e-9)


if __name__ == "__main__":
    run(DriveTest)
