"""The topics of a world: its map, its markers, and each robot's sensors in it."""

from __future__ import annotations

import io
from typing import Any, Callable

import numpy as np
import rospy
from rospy.msg import serialize_message
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import MarkerArray

from fake_turtlebot_sim.ros.map_topics import MapTopics
from fake_turtlebot_sim.simulator.kobuki_feedback import touch_feedback
from fake_turtlebot_sim.simulator.laser import Laser
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.robot_messages import ORIGIN, Place
from fake_turtlebot_sim.simulator.sensors import Sensed
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot, meet
from fake_turtlebot_sim.simulator.world import World
from fake_turtlebot_sim.simulator.world_messages import bumper_markers, world_map, world_markers
from kobuki_protocol.events import EVENTS, QUEUE, events
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

# The camera's depth frame above base_footprint [m]: turtlebot_description's 0.287 above base_link.
SCAN_Z = 0.2972
MARKERS_S = 1.0  # period of the markers: RViz drops one that arrives before its frame


class WorldTopics:
    """Publishers: world_markers, MapTopics and the SensorTopics of each robot."""

    def __init__(
        self,
        parameters: SimulatorParameters,
        world: World,
        robots: dict[str, SimulatedRobot],
        warn: Callable[[str], None],
    ) -> None:
        """Take the robots by name, and publish the map."""
        self._parameters, self._robots = parameters, list(robots.values())
        self._sensors = [SensorTopics(name, parameters, world, warn) for name in robots]
        self._map = MapTopics(world_map(world, parameters.map_frame, rospy.Time.now()), warn)
        self._markers = PromptPublisher("world_markers", MarkerArray)
        self._cycles_per_markers = round(MARKERS_S * parameters.rate)
        data = io.BytesIO()
        serialize_message(data, 0, MarkerArray(world_markers(world, parameters.map_frame)))
        self._marker_data = data.getvalue()

    def frames(self) -> list[tuple[str, str, Place]]:
        """Return the static frames: (parent, child, place [m] in the parent)."""
        p = self._parameters
        place = p.scan_x, p.scan_y, SCAN_Z
        published = self._sensors if p.publish_scan_tf else []
        scanners = [(sensors.base_frame, sensors.scan_frame, place) for sensors in published]
        return scanners + ([(p.world_frame, p.map_frame, ORIGIN)] if p.robots else [])

    def before_move(self) -> None:
        """Let the robots meet, if ~robots_meet is true."""
        if self._parameters.robots_meet:
            meet(self._robots, self._parameters.meeting_reach())

    def after_move(self, stamp: Any) -> None:
        """Remember the states of all sensors; call it with the motion held."""
        discs, numbers = np.array([robot.disc for robot in self._robots]), range(len(self._robots))
        for k, sensors, robot in zip(numbers, self._sensors, self._robots):
            is_seen = np.not_equal(numbers, k) & self._parameters.robots_meet
            sensors.take(robot, stamp, discs[is_seen])

    def publish(self, cycle: int) -> None:
        """Publish markers, events and scans; the robots' scans are spread over the cycles."""
        if cycle % self._cycles_per_markers == 0:
            self._markers.send(self._marker_data)
        for k, sensors in enumerate(self._sensors):
            sensors.publish(cycle + k)


class SensorTopics:
    """Publishers: mobile_base/events/bumper, cliff, wheel_drop, bumper_markers and scan."""

    def __init__(
        self, name: str, parameters: SimulatorParameters, world: World, warn: Callable[[str], None]
    ) -> None:
        """Take the name of the robot, empty for a single one."""
        self._name, self._warn = name or "the robot", warn
        p, prefix = parameters, f"{name}/" if name else ""
        self.scan_frame, self.base_frame = prefix + p.scan_frame, prefix + p.base_frame
        self._sensed = self._published = Sensed()
        self._events = {
            topic: rospy.Publisher(f"{prefix}mobile_base/events/{topic}", kind, queue_size=QUEUE)
            for topic, kind, _ in EVENTS
        }
        self._markers = rospy.Publisher(
            f"{prefix}bumper_markers", MarkerArray, queue_size=1, latch=True
        )
        self._laser = laser = Laser(p, world, name)
        self._scans = PromptPublisher(f"{prefix}scan", LaserScan) if p.scan_rate else None
        self._cycles_per_scan = max(1, round(p.rate / p.scan_rate)) if p.scan_rate else 1
        self._scan = LaserScan(
            angle_min=laser.angle_min,
            angle_max=laser.angle_min + (p.scan_beams - 1) * laser.increment,
            angle_increment=laser.increment,
            scan_time=self._cycles_per_scan / p.rate,
            range_min=p.scan_range_min,
            range_max=p.scan_range_max,
        )
        self._scan.header.frame_id = self.scan_frame

    def take(self, robot: SimulatedRobot, stamp: Any, others: Any) -> None:
        """Remember the robot's sensors; others: obstacles (n, 5) that it may see."""
        self._scan.header.stamp, self._sensed = stamp, robot.sensed()
        self._seen = robot.true_pose, others

    def publish(self, cycle: int) -> None:
        """Publish the events, and in each _cycles_per_scan-th cycle the scan."""
        before, self._published = self._published, self._sensed
        if before != self._sensed:
            self._publish_events(before, self._sensed)
        if self._scans and self._scans.listeners and cycle % self._cycles_per_scan == 0:
            self._scan.ranges = self._laser.measure(*self._seen)
            self._scans.publish(self._scan)

    def _publish_events(self, before: Sensed, after: Sensed) -> None:
        for topic, event in events(touch_feedback(before), touch_feedback(after)):
            self._events[topic].publish(event)
        if any(after.wheels) and not any(before.wheels):
            (x, y, _), todo = self._seen[0], "lift it with ~reset or initialpose"
            self._warn(f"{self._name} fell over an edge at ({x:.2f}, {y:.2f}): {todo}")
        if before.bumpers != after.bumpers:
            self._markers.publish(MarkerArray(bumper_markers(after.bumpers, self.base_frame)))
