"""What rostests share: a test case that cleans up after itself."""

import tempfile
import unittest
from pathlib import Path

import rospy

from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for


class RosTest(unittest.TestCase):
    """A test case whose programs, publishers, subscribers and folders end with each test."""

    def enter(self, context):
        """Enter a context until the end of the test; return its value."""
        value = context.__enter__()
        self.addCleanup(context.__exit__, None, None, None)
        return value

    def start(self, *command, **options):
        return self.enter(Program(*command, **options))

    def folder(self):
        return Path(self.enter(tempfile.TemporaryDirectory()))

    def publisher(self, topic, kind, **options):
        publisher = rospy.Publisher(topic, kind, **{"queue_size": 1000, **options})
        self.addCleanup(publisher.unregister)
        return publisher

    def connected(self, topic, kind, **options):
        """Return a publisher, once it has a subscriber."""
        publisher = self.publisher(topic, kind, **options)
        wait_for(publisher.get_num_connections, f"subscriber of {topic}")
        return publisher

    def hear(self, topic, kind, hear):
        """Call hear() with each message of a topic; return the subscriber."""
        subscriber = rospy.Subscriber(topic, kind, hear, queue_size=1000, tcp_nodelay=True)
        self.addCleanup(subscriber.unregister)
        return subscriber

    def record(self, topic, kind):
        """Return the growing list of a topic's messages."""
        messages = []
        self.hear(topic, kind, messages.append)
        return messages

    def check_mistake(self, program, *words):
        """Check that a Program exits with code 1 and one line, which has these words."""
        with program:
            self.assertEqual(program.wait(), 1)
            self.assertEqual(program.output.count("\n"), 1, program.output)
            for word in words:
                self.assertIn(word, program.output)

    def check_end(self, program, **deadline):
        """Wait until a Program exits, with code 0 and without a traceback."""
        self.assertEqual(program.wait(**deadline), 0, program.output)
        self.assertNotIn("Traceback", program.output)

    def end(self, program, **deadline):
        """Press Ctrl-C, and wait for the end, as check_end() does."""
        program.interrupt()
        self.check_end(program, **deadline)
