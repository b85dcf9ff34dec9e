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
    def test_of_two_talkers_with_one_name_the_older_ends_and_ctrl_c_ends_the_other(self):
        program = node_path("beginner_tutorials", "talker.py")
        first = self.start(program, "--unique")
        wait_for(lambda: nodes("talker"), "first talker")
        second = self.start(program, "--unique")
        self.check_end(first)
        self.assertIn("new node registered with same name", first.output)
        wait_for(lambda: nodes("talker") == ["/talker"], "second talker")
        self.assertFalse(second.ended)
        self.end(second)

    def test_without_a_master_rospy_says_what_is_missing_and_ctrl_c_ends_the_waiting(self):
        nobody = "http://localhost:9"  # the port named "discard": no master lives there
        node = self.start(node_path("beginner_tutorials", "listener.py"), ROS_MASTER_URI=nobody)
        line = f"Unable to register with master node [{nobody}]"
        wait_for(lambda: line in node.output, line)
        self.end(node)


if __name__ == "__main__":
    run()
