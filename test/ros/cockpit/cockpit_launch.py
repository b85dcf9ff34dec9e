"""A browser is the joystick of launch_joy_node.launch; a second cockpit leads to the first."""

import socket
import time
from urllib.parse import urlsplit

import rosgraph
import rosnode

from node_kit.ros_api import address
from tutorial_testing.cockpit_rig import CockpitRig
from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

URI = rosgraph.get_master_uri()


class Launched(CockpitRig):
    def start(self):
        self.address = wait_for(lambda: address(URI), "address of the page")
        self.port = urlsplit(self.address).port
        self.program = Program("sleep", "infinity")  # the launch file has the cockpit
        wait_for(self.listens, "page of the cockpit")


class BrowserJoystick(RosTest):
    def setUp(self):
        self.rig = self.enter(Launched())

    def test_the_page_drives_in_place_of_a_joystick(self):
        self.assertNotIn("/joy_node", rosnode.get_node_names())
        with self.rig.page() as page:
            self.rig.drive(page)
        self.rig.wait_for_rest(time.time())

    def test_a_second_cockpit_says_where_the_first_one_is(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:  # by another program
            other, ours = taken.getsockname()[1], self.rig.port
            at = self.rig.address
            for port, options, code, line in (
                (ours, (), 0, f"a cockpit is already running: open {at} on this machine"),
                (ours, ("--lan",), 1, f"a cockpit is already running at {at}; for other machines "
                 f"end[^\n]* or take --port {ours + 1}"),
                (other, (), 1, f"port {other} is taken[^\n]*"),
            ):  # fmt: skip
                command = node_path("cockpit", "cockpit.py"), "--port", str(port), *options
                with Program(*command, "__name:=another") as second:
                    self.assertEqual(second.wait(), code)
                    self.assertRegex(second.output, f"^cockpit: {line}\n$")

    def test_windows_of_rqt_without_a_screen_lead_to_the_page(self):
        plot = ("rqt_plot", "rqt_plot", "/odom/pose/pose/position/x:y")
        place = "plot?f=/odom/pose/pose/position/x&f=/odom/pose/pose/position/y"
        for command, at in ((("rqt_graph",) * 2, "Graph"), (plot, place)):
            with Program("rosrun", *command, DISPLAY="") as window:
                self.assertEqual(window.wait(), 0)
                self.assertEqual(window.output, f"{command[0]}: see {self.rig.address}#{at}\n")
