#!/usr/bin/python3
"""A classroom: students replay joy.bag at once, and each drives its own robot."""

from pathlib import Path

import rosgraph
import rospkg

from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

DRIVEN = [f"robot_{number}" for number in range(1, 4)]
STANDING = [f"robot_{number}" for number in range(4, 31)]
LONGEST_S = 240.0  # the recording takes 55 s, all programs on a busy machine as long to start
# Velocities that come late on a busy machine bend the path a little. Measured: 0.01 m.
TOLERANCE_M = 0.1
BAG = Path(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")


class StudentTest(RosTest):
    def test_three_drive_their_own_robots_and_the_others_stand(self):
        robots = {name: self.enter(Robot(f"/{name}/")) for name in (*DRIVEN, *STANDING)}
        wait_for(lambda: all(robot.odometry for robot in robots.values()), "thirty robots")
        command = ("roslaunch", "joy2twist", "student.launch", "rviz:=false", f"bag:={BAG}")
        students = [self.start(*command, f"name:={name}") for name in DRIVEN]
        wait_for(lambda: drivers() == set(DRIVEN), "three drivers at once", LONGEST_S)
        for student in students:
            self.check_end(student, deadline_s=LONGEST_S)
            self.assertNotIn("died", student.output)  # a normal end does not look like a crash
        ways = {}  # from where each began, as complex numbers [m]
        for name, robot in robots.items():
            places = [complex(moment.x, moment.y) for moment in robot.odometry]
            ways[name] = [place - places[0] for place in places]
        self.assertEqual([name for name in STANDING if any(ways[name])], [])
        for name in DRIVEN:  # with the same recording
            self.assertGreater(max(map(abs, ways[name])), 0.5, name)
            self.assertFalse(robots[name].moves)
            self.assertLess(abs(ways[name][-1] - ways[DRIVEN[0]][-1]), TOLERANCE_M, name)


def drivers():
    """Return the robots to which velocities are sent."""
    publishers, _, _ = rosgraph.Master("/student").getSystemState()
    return {topic.split("/")[1] for topic, _ in publishers if topic.endswith("/cmd_vel")}


if __name__ == "__main__":
    run()
