"""The look of a robot and its name as markers, in the frame of its base.

A RobotModel of RViz would need for each robot a robot_state_publisher and an entry in a
configuration, which cannot know the names. Markers need neither: RViz moves them with their frame.
"""

from geometry_msgs.msg import Point, Pose, Quaternion
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

UPRIGHT = Quaternion(0.0, 0.0, 0.0, 1.0)
BLACK, PLATE = ColorRGBA(0.10, 0.10, 0.10, 1.0), ColorRGBA(0.30, 0.30, 0.32, 1.0)
GREEN = ColorRGBA(0.35, 0.75, 0.20, 1.0)
# The outline of urdf/turtlebot.urdf: shape, middle and size [m] in the frame of the base.
BODY = (
    (Marker.CYLINDER, (0.0, 0.0, 0.052), (0.356, 0.356, 0.080), BLACK),  # the base
    (Marker.CYLINDER, (0.0, 0.0, 0.142), (0.320, 0.320, 0.008), PLATE),
    (Marker.CYLINDER, (0.0, 0.0, 0.200), (0.320, 0.320, 0.008), PLATE),
    (Marker.CUBE, (-0.080, 0.0, 0.235), (0.050, 0.250, 0.045), BLACK),  # the camera
    (Marker.CYLINDER, (0.0, 0.0, 0.307), (0.060, 0.060, 0.206), PLATE),  # in place of four poles
    (Marker.CYLINDER, (0.0, 0.0, 0.414), (0.320, 0.320, 0.008), PLATE),
    (Marker.CUBE, (0.080, 0.0, 0.420), (0.140, 0.060, 0.008), GREEN),  # points to the front
)
# Above the robot, and always turned to whoever looks. Of the size, only the height counts.
NAME = (Marker.TEXT_VIEW_FACING, (0.0, 0.0, 0.75), (0.0, 0.0, 0.26), BLACK)


def robots(static):
    """{robot: its odometry frame}: the simulator lays NAME/... of each onto the world's frame.

    static: transforms of /tf_static as (parent, child).
    """
    return {
        child.split("/")[0]: child for parent, child in static if "/" in child and "/" not in parent
    }


def base_frames(static, moving):
    """{robot: frame of its base}, of the robots whose base was seen to move in /tf.

    static, moving: transforms of /tf_static and of /tf as (parent, child).
    """
    base = dict(moving)
    return {name: base[odometry] for name, odometry in robots(static).items() if odometry in base}


def markers(robot, base_frame):
    """The Markers of one robot, which stay and move with the frame."""
    found = [_marker(robot, base_frame, part) for part in BODY]
    name = _marker(robot, base_frame, NAME)
    name.text = robot
    found.append(name)
    for number, marker in enumerate(found):
        marker.id = number
    return found


def _marker(robot, base_frame, part):
    shape, middle, size, colour = part
    marker = Marker(ns=robot, type=shape, action=Marker.ADD, color=colour)
    # Without a stamp and locked: wherever the frame is when RViz draws.
    marker.header.frame_id, marker.frame_locked = base_frame, True
    marker.pose = Pose(Point(*middle), UPRIGHT)
    marker.scale.x, marker.scale.y, marker.scale.z = size
    return marker
