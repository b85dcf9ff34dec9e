"""Of two nodes with one name the older ends, cleanly, and the newer one goes on."""

import rosnode
import rospy

from tutorial_testing.nodes import node_path
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for


class NamesTest(RosTest):
    def test_of_two_talkers_with_one_name_the_older_ends_and_ctrl_c_ends_the_other(self):
        # As node_kit's roscore.xml, which only a shell of the suite has roslaunch read.
        rospy.set_param("/rosout_disable_topics_generation", False)
        is_known = lambda: "/talker" in rosnode.get_node_names()  # noqa: E731
        program = node_path("beginner_tutorials", "talker.py")
        first = self.start(program, "--unique")
        wait_for(is_known, "first talker")
        second = self.start(program, "--unique")
        self.check_end(first)
        self.assertIn("new node registered with same name", first.output)
        wait_for(is_known, "second talker")
        self.assertFalse(second.ended)
        self.end(second)
