"""A classroom: each student replays a recording, and drives their own robot."""

from tutorial_testing.claims import claim
from tutorial_testing.hands import record
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

NAMES = [f"robot_{number}" for number in range(1, 31)]
DRIVEN = NAMES[:3]
LONGEST_S = 120.0  # the recording takes 6 s; on a busy machine the programs start within a minute


class StudentTest(RosTest):
    @claim("classroom.launch has thirty robots; students drive their own, and the others stand")
    def test_three_drive_their_own_robots_and_the_others_stand(self):
        robots = {name: self.enter(Robot(f"/{name}/")) for name in NAMES}
        wait_for(lambda: all(robot.odometry for robot in robots.values()), "thirty robots")
        bag = record(str(self.folder() / "short.bag"))
        command = ("roslaunch", "joy2twist", "student.launch", "rviz:=false", f"bag:={bag}")
        students = [self.start(*command, f"name:={name}") for name in DRIVEN]
        for student in students:
            self.check_end(student, deadline_s=LONGEST_S)
            self.assertNotIn("died", student.output)  # a normal end does not look like a crash
        driven = [n for n, robot in robots.items() if any(m.moves for m in robot.odometry)]
        self.assertEqual(driven, DRIVEN)
        self.assertFalse(any(robot.moves for robot in robots.values()))
