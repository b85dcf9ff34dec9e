#!/usr/bin/python3
"""draw_graph.py draws what runs, and says in one line what it wrote or why it cannot."""

import struct
import sys
import tempfile
import unittest
from pathlib import Path

import rospkg
import rostest

from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

SCRIPT = Path(rospkg.RosPack().get_path("tutorial_tools")) / "scripts" / "draw_graph.py"


class GraphTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_it(self, *arguments, **environment):
        """Run it from rosrun, to its end; (exit code, what it printed)."""
        command = [node_path("tutorial_tools", "draw_graph.py")]
        with Program(*command, *map(str, arguments), **environment) as program:
            return program.wait(), program.output

    def drawn(self, file, *switch):
        """What it wrote."""
        said = self.run_it(self.folder / file, *switch)
        self.assertEqual(said, (0, f"draw_graph: wrote {self.folder / file}\n"))
        return (self.folder / file).read_bytes()

    def check_refusal(self, said, why):
        self.assertEqual(said, (1, f"draw_graph: {why}\n"))
        self.assertEqual(list(self.folder.iterdir()), [])

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

    def test_a_picture_is_named_with_its_folder(self):
        draw = f"cd '{self.folder}' && exec {node_path('tutorial_tools', 'draw_graph.py')}"
        with Program("sh", "-c", draw) as program:
            self.assertEqual(program.wait(), 0)
            self.assertEqual(program.output, f"draw_graph: wrote {self.folder}/graph.png\n")

    def test_a_picture(self):
        data = self.drawn("graph.png")
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", data[16:24])  # the first block's
        self.assertGreater(width, 200)
        self.assertGreater(height, 30)

    def test_other_kinds(self):
        self.assertIn(b"<svg", self.drawn("graph.svg"))
        self.assertEqual(self.drawn("graph.PDF")[:5], b"%PDF-")

    def test_another_ending(self):
        for file in ("graph.gif", "graph", ".png"):
            path = self.folder / file
            why = f"{path} must end in .png, .svg, .pdf or .dot"
            self.check_refusal(self.run_it(path), why)

    def test_a_path_that_cannot_be_written(self):
        path = self.folder / "nowhere" / "graph.png"
        why = f"cannot write {path}: No such file or directory"
        self.check_refusal(self.run_it(path), why)

    def test_no_master(self):
        nobody = "http://localhost:9"  # the port named "discard": no master lives there
        said = self.run_it(self.folder / "graph.png", ROS_MASTER_URI=nobody)
        why = f"no ROS master at {nobody}; start one with: roscore"
        self.check_refusal(said, why)

    def test_no_address_of_a_master(self):
        said = self.run_it(self.folder / "graph.png", ROS_MASTER_URI="robot")
        self.check_refusal(said, "no ROS master at robot; start one with: roscore")

    def test_without_graphviz(self):
        """Not by rosrun, which needs a PATH."""
        with Program(SCRIPT, self.folder / "graph.png", PATH="/nowhere") as program:
            said = program.wait(), program.output
        why = "dot is missing: sudo apt install graphviz, or choose a FILE that ends in .dot"
        self.check_refusal(said, why)
        with Program(SCRIPT, self.folder / "graph.dot", PATH="/nowhere") as program:
            self.assertEqual(program.wait(), 0, program.output)


if __name__ == "__main__":
    init_node("graph_test")
    rostest.rosrun("ros1_tutorial_test", "beginner_tutorials_graph", GraphTest, sys.argv)
