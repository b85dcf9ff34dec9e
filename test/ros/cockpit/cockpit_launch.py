#!/usr/bin/python3
"""A browser is the joystick of launch_joy_node.launch; a second cockpit finds the port taken."""

import time
import unittest
from urllib.parse import urlsplit

import rosgraph
import rosnode
import rostest

from node_kit.page import address
from tutorial_testing.cockpit_rig import CockpitRig
from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for


class Launched(CockpitRig):
    """The cockpit that the launch file has started."""

    def start(self):
        """Wait for it."""
        page = wait_for(lambda: address(rosgraph.get_master_uri()), "address of the page")
        self.port = urlsplit(page).port
        self.program = Program("true")
        self.program.__enter__()
        wait_for(self.listens, "page of the cockpit")

    def listens(self):
        """Whether the robot is known there."""
        with self.page() as page:
            return self.robot in page.wait_for("hello")["robots"]


class BrowserJoystick(unittest.TestCase):
    """What the launch file has started."""

    def test_the_page_drives(self):
        with Launched() as rig, rig.page() as page:
            self.assertNotIn("/joy_node", rosnode.get_node_names())
            rig.drive(page)
            page.close()
            rig.rest_after(time.time())
            command = (node_path("cockpit", "cockpit.py"), "--port", str(rig.port))
            with Program(*command, "__name:=another") as second:
                self.assertEqual(second.wait(), 1)
                self.assertRegex(second.output, rf"^cockpit: port {rig.port} is taken[^\n]*\n$")
            with rig.page() as again:
                rig.drive(again)

    def test_rqt_commands_lead_to_the_page(self):
        page = wait_for(lambda: address(rosgraph.get_master_uri()), "address of the page")
        with Program(node_path("tutorial_tools", "rqt_graph"), DISPLAY="") as graph:
            self.assertEqual(graph.wait(), 0)
            self.assertEqual(graph.output, f"rqt_graph: see {page}#Graph\n")


if __name__ == "__main__":
    init_node("cockpit_launch")
    rostest.rosrun("ros1_tutorial_test", "cockpit_launch", BrowserJoystick)
