#!/usr/bin/python3
"""A browser is the joystick of launch_joy_node.launch; a second cockpit leads to the first."""

import socket
import time
from urllib.parse import urlsplit

import rosgraph
import rosnode

from node_kit.questions import address
from tutorial_testing.cockpit_rig import CockpitRig
from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


class Launched(CockpitRig):
    def start(self):
        page = wait_for(lambda: address(rosgraph.get_master_uri()), "address of the page")
        self.port = urlsplit(page).port
        self.program = Program("true")
        wait_for(self.listens, "page of the cockpit")

    def listens(self):
        with self.page() as page:
            return self.robot in page.wait_for("hello")["robots"]


class BrowserJoystick(RosTest):
    def test_the_page_drives(self):
        with Launched() as rig, rig.page() as page:
            self.assertNotIn("/joy_node", rosnode.get_node_names())
            rig.drive(page)
            page.close()
            rig.wait_for_rest(time.time())
            at = f"http://127.0.0.1:{rig.port}/"
            why = f"cockpit: a cockpit is already running: open {at} on this machine"
            self.second_says(rig.port, 0, f"{why}\n")
            why = f"cockpit: a cockpit is already running at {at}; for other machines end[^\n]*"
            self.second_says(rig.port, 1, f"{why} or take --port {rig.port + 1}\n", "--lan")
            with socket.create_server(("127.0.0.1", 0)) as taken:  # by another program
                port = taken.getsockname()[1]
                self.second_says(port, 1, f"cockpit: port {port} is taken[^\n]*\n")
            with rig.page() as again:
                rig.drive(again)

    def second_says(self, port, code, line, *options):
        """Another cockpit ends at once, with an exit code and one line."""
        command = (node_path("cockpit", "cockpit.py"), "--port", str(port), *options)
        with Program(*command, "__name:=another") as second:
            self.assertEqual(second.wait(), code)
            self.assertRegex(second.output, f"^{line}$")

    def test_a_second_cockpit_that_ends_leaves_the_address_of_the_first(self):
        uri, port = rosgraph.get_master_uri(), free_port()
        first = wait_for(lambda: address(uri), "address of the page")
        command = (node_path("cockpit", "cockpit.py"), "--port", str(port), "__name:=second")
        with Program(*command) as second:
            wait_for(lambda: address(uri) == f"http://127.0.0.1:{port}/", "the second's address")
            second.interrupt()
            second.wait()
        self.assertEqual(address(uri), first)

    def test_rqt_commands_lead_to_the_page(self):
        page = wait_for(lambda: address(rosgraph.get_master_uri()), "address of the page")
        with Program(node_path("tutorial_tools", "rqt_graph"), DISPLAY="") as graph:
            self.assertEqual(graph.wait(), 0)
            self.assertEqual(graph.output, f"rqt_graph: see {page}#Graph\n")


if __name__ == "__main__":
    run()
