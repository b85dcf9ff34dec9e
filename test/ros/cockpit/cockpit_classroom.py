#!/usr/bin/python3
"""A classroom on one page: each robot where it is, one of them driven and put back."""

import time

import rospy
from nav_msgs.msg import Odometry

from node_kit.arming import DRIVING
from tutorial_testing.cockpit_rig import CockpitRig
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

OURS, OTHERS = "robot_2", ("robot_1", "robot_3")


class Classroom(RosTest):
    def test_one_robot_of_three_is_driven_and_put_back(self):
        with CockpitRig(robot=OURS) as rig, rig.page() as page:
            self.assertEqual(page.wait_for("hello")["robots"], sorted([OURS, *OTHERS]))
            page.say("watch", robots=True, look=OURS)

            def seen():
                return page.of("robots")[-1]["robots"]

            wait_for(lambda: page.of("robots") and len(seen()) == 3, "three robots")
            start = seen()
            rig.drive(page)
            wait_for(lambda: seen()[OURS]["covered"] > 0.2, "way driven")
            page.wait_for("teleop", lambda told: [told["robot"], told["state"]] == [OURS, DRIVING])
            page.say("stop")
            rig.wait_for_rest(time.time())
            at = rospy.wait_for_message(f"/{OURS}/odom", Odometry).pose.pose.position
            wait_for(lambda: abs(seen()[OURS]["x"] - at.x) < 0.001, "place of its odometry")
            for robot in OTHERS:
                self.assertEqual(seen()[robot]["x"], start[robot]["x"])
            page.say("reset", robot=OURS)
            wait_for(lambda: seen()[OURS]["x"] == start[OURS]["x"], "robot at its start")


if __name__ == "__main__":
    run()
