"""The node classroom_bodies: gives RViz a body and a name for every robot of a classroom.

A RobotModel of RViz needs for each robot a robot_state_publisher and an entry in a configuration,
which cannot know the names. Markers need neither: RViz moves them with their frame.
"""

from __future__ import annotations

import time

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from node_kit.ros.lifecycle.start import run

NODE_NAME = "classroom_bodies"
PERIOD_S = 1.0  # not of rospy, whose time may be simulated
UPRIGHT = Quaternion(0.0, 0.0, 0.0, 1.0)
BLACK, PLATE = ColorRGBA(0.10, 0.10, 0.10, 1.0), ColorRGBA(0.30, 0.30, 0.32, 1.0)
GREEN = ColorRGBA(0.35, 0.75, 0.20, 1.0)
# The outline of the URDF: shape, middle and size [m] in the frame of the base.
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


class ClassroomBodies:
    """Publishes the bodies once a second: RViz drops a marker that comes before its frame.

    Publishers: classroom_bodies (visualization_msgs/MarkerArray)
    Parameters: those of the node fake_turtlebot; of these count ~robots and ~base_frame
    """

    def __init__(self, parameters: SimulatorParameters) -> None:
        """Take the robots' names."""
        self._bodies = MarkerArray()
        for name in parameters.robots:
            self._bodies.markers += markers(name, f"{name}/{parameters.base_frame}")
        self._publisher = rospy.Publisher("classroom_bodies", MarkerArray, queue_size=1)

    def spin(self) -> None:
        """Publish until shut down."""
        while not rospy.is_shutdown():
            if self._publisher.get_num_connections():
                self._publisher.publish(self._bodies)
            time.sleep(PERIOD_S)


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, parse_parameters, lambda p: ClassroomBodies(p).spin())
