"""The node classroom_bodies: shows a body and a name in RViz for each robot of a classroom.

For each robot RViz's RobotModel needs a robot_state_publisher, and an entry in a configuration,
where the names are unknown. Markers need neither: RViz moves them with their frame.
"""

from __future__ import annotations

import time

import rospy
from geometry_msgs.msg import Point, Vector3
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from fake_turtlebot_sim.simulator.world_messages import marker
from node_kit.ros.lifecycle.start import run

NODE_NAME = "classroom_bodies"
PERIOD_S = 1.0  # of real time; rospy's may be simulated
BLACK, PLATE = ColorRGBA(0.10, 0.10, 0.10, 1.0), ColorRGBA(0.30, 0.30, 0.32, 1.0)
GREEN = ColorRGBA(0.35, 0.75, 0.20, 1.0)
# The outline of the URDF: shape, centre and size [m] in the base frame.
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
    body = []
    for number, (shape, centre, size, colour) in enumerate(BODY):
        part = marker(robot, number, shape, base_frame, colour)
        part.pose.position, part.scale = Point(*centre), Vector3(*size)
        body.append(part)
    body[-1].text = robot
    return body


class ClassroomBodies:
    """Publishes the bodies once a second: RViz drops a marker that arrives before its frame.

    Publishers: classroom_bodies (visualization_msgs/MarkerArray)
    Parameters: those of the node fake_turtlebot, of which only ~robots and ~base_frame matter
    """

    def __init__(self, parameters: SimulatorParameters) -> None:
        """Make the markers of all robots."""
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
