#!/usr/bin/python3
"""Of two nodes with one name the older ends, cleanly; without a master Ctrl-C ends each."""

import rosnode

from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for


def nodes(name):
    """The running nodes whose name begins so."""
    return [node for node in rosnode.get_node_names() if node.startswith(f"/{name}")]


class NamesTest(RosTest):
    def check(self, name):
        program = node_path("beginner_tutorials", f"{name}.py")
        first = self.start(program, "--unique")
        wait_for(lambda: nodes(name), f"first {name}")
        second = self.start(program, "--unique")
        self.check_end(first)
        self.assertIn("new node registered with same name", first.output)
        wait_for(lambda: nodes(name) == [f"/{name}"], f"second {name}")
        self.assertFalse(second.ended)
        self.end(second)

        # rospy itself says what is missing, and Ctrl-C ends the waiting.
        nobody = "http://localhost:9"  # the port named "discard": no master lives there
        alone, line = self.start(program, ROS_MASTER_URI=nobody), f"with master node [{nobody}]"
        wait_for(lambda: f"Unable to register {line}" in alone.output, line)
        self.end(alone)

    def test_talkers(self):
        self.check("talker")

    def test_listeners(self):
        self.check("listener")


if __name__ == "__main__":
    run()
