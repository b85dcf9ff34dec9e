"""The topics of a world: its map, its markers, its frames, and what each robot senses in it."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import rospy
from nav_msgs.msg import OccupancyGrid
from rospy.msg import serialize_message
from visualization_msgs.msg import MarkerArray

from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.ros_messages import ORIGIN, Place
from fake_turtlebot_sim.simulator.sensor_topics import SensorTopics
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot, meet
from fake_turtlebot_sim.simulator.world import World
from fake_turtlebot_sim.simulator.world_messages import world_map, world_markers
from node_kit.prompt_publisher import PromptPublisher

# The camera's depth frame above base_footprint [m]: turtlebot_description's 0.287 above base_link.
SCAN_Z = 0.2972
MARKERS_S = 1.0  # how often they are sent: RViz drops a marker that comes before its frame
NOBODY = np.empty((0, 3))


class WorldTopics:
    """Publishers: map, latched, world_markers and the SensorTopics of each robot."""

    def __init__(
        self, parameters: Parameters, world: World, robots: dict[str, SimulatedRobot]
    ) -> None:
        """Take the robots by name and publish the map and the markers."""
        self._parameters, self._robots = parameters, list(robots.values())
        self._reach = parameters.meeting_reach()
        self._sensors = [SensorTopics(name, parameters, world) for name in robots]
        self._map = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self._markers = PromptPublisher("world_markers", MarkerArray)
        self._cycles_per_markers = round(MARKERS_S * parameters.rate)
        self._map.publish(world_map(world, parameters.map_frame, rospy.Time.now()))
        # Made once: a map as large as a building takes a while.
        shown = io.BytesIO()
        serialize_message(shown, 0, MarkerArray(world_markers(world, parameters.map_frame)))
        self._shown = shown.getvalue()

    def frames(self) -> list[tuple[str, str, Place]]:
        """Return which frames lie where for good: (parent, child, place [m] in the parent)."""
        p = self._parameters
        place = p.scan_x, p.scan_y, SCAN_Z
        found = [(one.base_frame, one.scan_frame, place) for one in self._sensors]
        return found + ([(p.world_frame, p.map_frame, ORIGIN)] if p.robots else [])

    def before_move(self) -> None:
        """Let the robots meet, if they may."""
        if self._parameters.robots_meet:
            meet(self._robots, self._reach)

    def after_move(self, stamp: Any) -> None:
        """Remember what the sensors feel; the motion is held meanwhile."""
        discs = [robot.disc for robot in self._robots]
        for k, (sensors, robot) in enumerate(zip(self._sensors, self._robots)):
            meets = self._parameters.robots_meet and len(discs) > 1
            sensors.take(robot, stamp, np.array(discs[:k] + discs[k + 1 :]) if meets else NOBODY)

    def publish(self, cycle: int) -> None:
        """Publish what is new in this cycle; not all robots scan in the same one."""
        if cycle % self._cycles_per_markers == 0:
            self._markers.send(self._shown)
        for k, sensors in enumerate(self._sensors):
            sensors.publish(cycle + k)
