"""The node: hears which robots there are, and gives RViz a body and a name for each of them."""

import time
from dataclasses import dataclass

import rospy
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from fake_turtlebot_sim.classroom_view.bodies import base_frames, markers, robots
from node_kit.parameters import checked
from node_kit.start import run

NODE_NAME = "classroom_bodies"
PERIOD_S = 1.0  # not of rospy, whose time may be simulated


@dataclass(frozen=True)
class Parameters:
    """There are none."""


class ClassroomBodies:
    """Tells where each robot's body belongs; RViz itself moves it with the frame of the robot.

    Again and again: RViz never shows a marker that came before the transforms of its frame.

    Subscribers: /tf_static and, until all robots were seen, /tf (tf2_msgs/TFMessage)
    Publishers: classroom_bodies (visualization_msgs/MarkerArray)
    """

    def __init__(self):
        """Listen."""
        self._static, self._moving, self._tf = set(), set(), None
        self._bodies = MarkerArray()
        self._publisher = rospy.Publisher("classroom_bodies", MarkerArray, queue_size=1)
        rospy.Subscriber("/tf_static", TFMessage, self._on_static)

    def spin(self):
        """Publish until shut down."""
        while not rospy.is_shutdown():
            if self._bodies.markers and self._publisher.get_num_connections():
                self._publisher.publish(self._bodies)
            time.sleep(PERIOD_S)

    def _on_static(self, message):
        self._static = self._static | pairs(message)
        if self._tf is None:
            self._tf = rospy.Subscriber("/tf", TFMessage, self._on_moving)

    def _on_moving(self, message):
        static = self._static
        self._moving |= pairs(message)
        bases = base_frames(static, self._moving)
        if self._tf is not None and set(bases) == set(robots(static)):
            self._tf.unregister()  # fifty messages a second, which say nothing new
            self._tf = None
            self._bodies = MarkerArray([m for name in bases for m in markers(name, bases[name])])


def pairs(message):
    """The transforms of a TFMessage as (parent, child)."""
    return {(t.header.frame_id, t.child_frame_id) for t in message.transforms}


def load(given):
    """The Parameters. Raises ValueError with one line."""
    return Parameters(**checked(Parameters, given))


def spin(_parameters):
    """Run until shut down."""
    ClassroomBodies().spin()


def main():
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, load, spin)
