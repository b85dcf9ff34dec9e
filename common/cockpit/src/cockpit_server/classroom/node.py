"""The node classroom_bodies: gives RViz a body and a name for every robot of a classroom.

A RobotModel of RViz needs for each robot a robot_state_publisher and an entry in a configuration,
which cannot know the names. Markers need neither: RViz moves them with their frame.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import Set, Tuple

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from std_msgs.msg import ColorRGBA
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from node_kit.parameters import checked
from node_kit.start import run

NODE_NAME = "classroom_bodies"
PERIOD_S = 1.0  # not of rospy, whose time may be simulated
MOST_PAIRS = 10_000  # The node keeps so many transforms; a class of thirty has a few hundred.
UPRIGHT = Quaternion(0.0, 0.0, 0.0, 1.0)
BLACK, PLATE = ColorRGBA(0.10, 0.10, 0.10, 1.0), ColorRGBA(0.30, 0.30, 0.32, 1.0)
GREEN = ColorRGBA(0.35, 0.75, 0.20, 1.0)
# The outline of fake_turtlebot_sim's URDF: shape, middle and size [m] in the frame of the base.
BODY = (
    (Marker.CYLINDER, (0.0, 0.0, 0.052), (0.356, 0.356, 0.080), BLACK),  # the base
    (Marker.CYLINDER, (0.0, 0.0, 0.142), (0.320, 0.320, 0.008), PLATE),
    (Marker.CYLINDER, (0.0, 0.0, 0.200), (0.320, 0.320, 0.008), PLATE),
    (Marker.CUBE, (-0.080, 0.0, 0.235), (0.050, 0.250, 0.045), BLACK),  # the camera
    (Marker.CYLINDER, (0.0, 0.0, 0.307), (0.060, 0.060, 0.206), PLATE),  # in place of four poles
    (Marker.CYLINDER, (0.0, 0.0, 0.414), (0.320, 0.320, 0.008), PLATE),
    (Marker.CUBE, (0.080, 0.0, 0.420), (0.140, 0.060, 0.008), GREEN),  # points to the front
    (Marker.TEXT_VIEW_FACING, (0.0, 0.0, 0.75), (0.0, 0.0, 0.26), BLACK),  # the name
)

Pairs = Set[Tuple[str, str]]  # transforms: (parent, child)


def robots(known: Pairs) -> set[str]:
    """Return the names of the robots: the simulator lays NAME/... of each onto the world."""
    return {child.split("/")[0] for parent, child in known if "/" in child and "/" not in parent}


def base_frames(static: Pairs, moving: Pairs) -> dict[str, str]:
    """Return {robot: frame of its base} of the robots whose base was seen to move in /tf."""
    base = dict(moving)
    laid = {child for parent, child in static | moving if "/" not in parent}
    return {child.split("/")[0]: base[child] for child in laid if "/" in child and child in base}


def markers(robot: str, base_frame: str) -> list[Marker]:
    """Return the Markers of one robot, which stay and move with the frame."""
    found = []
    for number, (shape, middle, size, colour) in enumerate(BODY):
        marker = Marker(ns=robot, id=number, type=shape, action=Marker.ADD, color=colour)
        # Without a stamp and locked: wherever the frame is when RViz draws.
        marker.header.frame_id, marker.frame_locked = base_frame, True
        marker.pose = Pose(Point(*middle), UPRIGHT)
        marker.scale.x, marker.scale.y, marker.scale.z = size
        found.append(marker)
    found[-1].text = robot
    return found


@dataclass(frozen=True)
class Parameters:
    """The node has none."""


class ClassroomBodies:
    """Publishes the bodies once a second: RViz drops a marker that comes before its frame.

    Subscribers: /tf_static and, until all robots were seen, /tf (tf2_msgs/TFMessage)
    Publishers: classroom_bodies (visualization_msgs/MarkerArray)
    """

    def __init__(self) -> None:
        """Listen."""
        self._static: Pairs = set()
        self._moving: Pairs = set()
        self._tf = None
        self._bodies = MarkerArray()
        self._publisher = rospy.Publisher("classroom_bodies", MarkerArray, queue_size=1)
        rospy.Subscriber("/tf_static", TFMessage, self._on_static)

    def spin(self) -> None:
        """Publish until shut down."""
        while not rospy.is_shutdown():
            if self._bodies.markers and self._publisher.get_num_connections():
                self._publisher.publish(self._bodies)
            time.sleep(PERIOD_S)

    def _on_static(self, message: TFMessage) -> None:
        self._static = joined(self._static, message)
        if self._tf is None:
            self._tf = rospy.Subscriber("/tf", TFMessage, self._on_moving)

    def _on_moving(self, message: TFMessage) -> None:
        static = self._static
        self._moving = joined(self._moving, message)
        bases = base_frames(static, self._moving)
        if self._tf is not None and set(bases) == robots(static | self._moving):
            self._tf.unregister()  # fifty messages a second without news
            self._tf = None
            self._bodies = MarkerArray([m for name in bases for m in markers(name, bases[name])])


def joined(known: Pairs, message: TFMessage) -> Pairs:
    """Return what is known and the transforms of a TFMessage; only what is known if too many."""
    both = known | {(t.header.frame_id, t.child_frame_id) for t in message.transforms}
    return both if len(both) <= MOST_PAIRS else known


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, partial(checked, Parameters), lambda _: ClassroomBodies().spin())
