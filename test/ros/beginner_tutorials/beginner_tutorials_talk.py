#!/usr/bin/python3
"""The listener says what the talker said, in its order and with nothing left out."""

import re
import sys
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log
from std_msgs.msg import String

from tutorial_testing.nodes import init_node
from tutorial_testing.waiting import wait_for


class TalkTest(unittest.TestCase):
    def test_the_listener_repeats_the_talker(self):
        said, heard = [], []
        rospy.Subscriber("chatter", String, lambda message: said.append(message.data))
        rospy.Subscriber("/rosout", Log, lambda log: heard.append(log.msg))
        wait_for(lambda: len(said) >= 20, "20 messages on chatter")
        words = said[:20]
        for word in words:
            self.assertRegex(word, r"^hello world \d+\.\d\d$")

        def repeated():
            return re.findall(r"^/listener: I heard (.*)$", "\n".join(heard), re.MULTILINE)

        # What was said before /rosout was connected may be missing, at the front only.
        wait_for(lambda: words[-1] in repeated(), "the listener's repetition")
        caught = [word for word in repeated() if word in words]
        self.assertGreater(len(caught), 5)
        self.assertEqual(caught, words[-len(caught) :])


if __name__ == "__main__":
    init_node("talk_test")
    rostest.rosrun("ros1_tutorial_test", "beginner_tutorials_talk", TalkTest, sys.argv)
