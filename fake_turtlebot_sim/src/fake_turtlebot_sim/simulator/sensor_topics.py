"""The topics of one robot's sensors in a world: events of the Kobuki, and the laser scan."""

from __future__ import annotations

from typing import Any

import rospy
from kobuki_msgs.msg import CliffEvent
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import MarkerArray

from fake_turtlebot_sim.kobuki_events import EVENTS, QUEUE
from fake_turtlebot_sim.simulator.laser import Laser
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.sensors import Sensed
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from fake_turtlebot_sim.simulator.world import World
from fake_turtlebot_sim.simulator.world_messages import bumper_markers
from node_kit.prompt_publisher import PromptPublisher

BOTTOM = (0, 1500)  # what a cliff sensor of the Kobuki reads above ground and above none, about


class SensorTopics:
    """Publishers: mobile_base/events/bumper, cliff, wheel_drop, bumper_markers and scan."""

    def __init__(self, name: str, parameters: Parameters, world: World) -> None:
        """Take the name of the robot, empty for the only one."""
        prefix = f"{name}/" if name else ""
        self.scan_frame = prefix + parameters.scan_frame
        self.base_frame = prefix + parameters.base_frame
        self._sensed = self._published = Sensed()
        self._events = [
            rospy.Publisher(f"{prefix}mobile_base/events/{topic}", kind, queue_size=QUEUE)
            for topic, kind, _ in EVENTS
        ]
        self._markers = rospy.Publisher(
            f"{prefix}bumper_markers", MarkerArray, queue_size=1, latch=True
        )
        self._cycles_per_scan, self._scan = 0, LaserScan()
        if parameters.scan_rate:
            self._cycles_per_scan = max(1, round(parameters.rate / parameters.scan_rate))
            self._laser = laser = Laser(parameters, world, name)
            self._scans = PromptPublisher(f"{prefix}scan", LaserScan)
            self._scan = LaserScan(angle_min=laser.angle_min, angle_increment=laser.increment)
            self._scan.header.frame_id = self.scan_frame
            self._scan.angle_max = laser.angle_min + (parameters.scan_beams - 1) * laser.increment
            self._scan.scan_time = self._cycles_per_scan / parameters.rate
            self._scan.range_min = parameters.scan_range_min
            self._scan.range_max = parameters.scan_range_max

    def take(self, robot: SimulatedRobot, stamp: Any, others: Any) -> None:
        """Remember what the sensors of the robot feel; others: discs (n, 3) that it may see."""
        self._scan.header.stamp, self._sensed = stamp, robot.sensed()
        self._seen = robot.true_pose, others

    def publish(self, cycle: int) -> None:
        """Publish what changed, and the scan in every so many cycles."""
        if self._sensed != self._published:
            self._publish_events(self._published, self._sensed)
            self._published = self._sensed
        if self._cycles_per_scan and cycle % self._cycles_per_scan == 0 and self._scans.listeners:
            self._scan.ranges = self._laser.measure(*self._seen)
            self._scans.publish(self._scan)

    def _publish_events(self, before: Sensed, after: Sensed) -> None:
        for (_, kind, field), publisher, was, now in zip(EVENTS, self._events, before, after):
            for k, is_on in enumerate(now):
                if is_on != was[k]:
                    bottom = {"bottom": BOTTOM[is_on]} if kind is CliffEvent else {}
                    publisher.publish(kind(state=int(is_on), **{field: k}, **bottom))
        if before.bumpers != after.bumpers:
            markers = bumper_markers(after.bumpers, self.base_frame)
            self._markers.publish(MarkerArray(markers))
