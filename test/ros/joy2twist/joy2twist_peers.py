#!/usr/bin/python3
"""joy2twist without its master."""

import rosgraph

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import BUSY_S, wait_for

LONGEST_EXIT_S = 1.5 + BUSY_S
PUBLISH_JOY = ("rostopic", "pub", "-r", "50", "joy", "sensor_msgs/Joy", "{axes: [0.0, 0.5]}")
JOY2TWIST = node_path("joy2twist", "joy2twist.py")
ECHO_SPEED = ("rostopic", "echo", "-p", "cmd_vel/linear/x")


class MasterTest(RosTest):
    def test_without_its_master_it_drives_on_and_stops_at_the_end(self):
        port = str(free_port())
        own = {"ROS_MASTER_URI": f"http://localhost:{port}"}
        # Not roscore, which has its master in a session of its own, out of reach.
        master = self.start("rosmaster", "--core", "-p", port, **own)
        wait_for(rosgraph.Master("/test", own["ROS_MASTER_URI"]).is_online, "master")
        node = self.start(JOY2TWIST, **own)
        self.start(*PUBLISH_JOY, **own)
        echo = self.start(*ECHO_SPEED, **own)
        wait_for(lambda: ",0.5" in echo.output, "velocity")
        master.kill()
        count = echo.output.count(",0.5")
        wait_for(lambda: echo.output.count(",0.5") > count + 50, "more velocities")
        self.assertNotIn(",0.0", echo.output)
        self.end(node, deadline_s=LONGEST_EXIT_S)
        wait_for(lambda: echo.output.endswith(",0.0\n"), "zero")


if __name__ == "__main__":
    run()
