#!/usr/bin/python3
"""Of two nodes with one name the older ends, cleanly; without a master Ctrl-C ends each."""

import sys
import unittest
from functools import partialmethod

import rosnode
import rostest

from tutorial_testing.nodes import init_node, node_path
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for


def nodes(name):
    """The running nodes whose name begins so."""
    return [node for node in rosnode.get_node_names() if node.startswith(f"/{name}")]


class NamesTest(unittest.TestCase):
    def run_two(self, name):
        """Start a node, and when it is there a second one; return both."""
        programs = []
        for _ in range(2):
            programs.append(Program(node_path("beginner_tutorials", f"{name}.py"), "--unique"))
            self.addCleanup(programs[-1].__exit__)
            wait_for(lambda: nodes(name), f"first {name}")
        return programs

    def ends(self, program):
        self.assertEqual(program.wait(), 0)
        self.assertNotIn("Traceback", program.output)

    def stop(self, program):
        program.interrupt()
        self.ends(program)

    def check_unique(self, name):
        first, second = self.run_two(name)
        self.ends(first)
        self.assertIn("new node registered with same name", first.output)
        wait_for(lambda: nodes(name) == [f"/{name}"], f"second {name}")
        self.assertFalse(second.ended)
        self.stop(second)

    def check_without_master(self, name):
        """rospy itself says what is missing, and Ctrl-C ends the waiting."""
        nobody = "http://localhost:9"  # the port named "discard": no master lives there
        line = f"Unable to register with master node [{nobody}]"
        with Program(node_path("beginner_tutorials", f"{name}.py"), ROS_MASTER_URI=nobody) as node:
            wait_for(lambda: line in node.output, line)
            self.stop(node)


if __name__ == "__main__":
    init_node("names_test")
    for check in ("unique", "without_master"):
        for name in ("talker", "listener"):
            test = partialmethod(getattr(NamesTest, f"check_{check}"), name)
            setattr(NamesTest, f"test_{name}_{check}", test)
    rostest.rosrun("ros1_tutorial_test", "beginner_tutorials_names", NamesTest, sys.argv)
