#!/usr/bin/python3
"""draw_graph.py draws what runs, and says in one line what it wrote or why it cannot."""

import struct
import sys
import tempfile
import unittest
from pathlib import Path

import rospkg
import rostest

from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

SCRIPT = Path(rospkg.RosPack().get_path("tutorial_tools")) / "scripts" / "draw_graph.py"


class GraphTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_it(self, *arguments, **environment):
        """Run it to its end; (exit code, what it printed). Not by rosrun, which needs a PATH."""
        with Program(SCRIPT, *map(str, arguments), **environment) as program:
            return program.wait(), program.output

    def drawn(self, file, *switch):
        """What it wrote."""
        said = self.run_it(self.folder / file, *switch)
        self.assertEqual(said, (0, f"draw_graph: wrote {self.folder / file}\n"))
        return (self.folder / file).read_bytes()

    def test_the_talker_talks_to_the_listener(self):
        edges = {'"node /talker" -> "topic /chatter"', '"topic /chatter" -> "node /listener"'}

        def graph():
            text = self.drawn("graph.dot").decode()
            return text if edges <= set(map(str.strip, text.splitlines())) else None

        text = wait_for(graph, "talker and listener")
        self.assertNotIn("rosout", text)
        self.assertNotIn("draw_graph", text)
        self.assertNotIn("subgraph", text)
        everything = self.drawn("graph.dot", "--all").decode()
        self.assertIn('"node /talker" -> "topic /rosout"', everything)
        self.assertNotIn("draw_graph", everything)

    def test_pictures(self):
        data = self.drawn("graph.png")
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])  # the first block's
        self.assertTrue(width > 200 and height > 30)
        self.assertIn(b"<svg", self.drawn("graph.svg"))
        self.assertEqual(self.drawn("graph.PDF")[:5], b"%PDF-")

    def test_refusals(self):
        nobody = "http://localhost:9"  # the port named "discard": no master lives there
        start = "; start one with: roscore"
        endings = "must end in .png, .svg, .pdf or .dot"
        no_dot = "dot is missing: sudo apt install graphviz, or choose a FILE that ends in .dot"
        for file, why, environment in (
            ("graph.gif", f"{self.folder}/graph.gif {endings}", {}),
            ("graph", f"{self.folder}/graph {endings}", {}),
            ("no/a.png", f"cannot write {self.folder}/no/a.png: No such file or directory", {}),
            ("a.png", f"no ROS master at {nobody}{start}", {"ROS_MASTER_URI": nobody}),
            ("a.png", f"no ROS master at x{start}", {"ROS_MASTER_URI": "x"}),
            ("a.png", no_dot, {"PATH": "/nowhere"}),
        ):
            said = self.run_it(self.folder / file, **environment)
            self.assertEqual(said, (1, f"draw_graph: {why}\n"))
            self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    init_node("graph_test")
    rostest.rosrun("ros1_tutorial_test", "beginner_tutorials_graph", GraphTest, sys.argv)
