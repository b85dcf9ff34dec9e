"""The topics of one robot's sensors in a world: events of the Kobuki, and the laser scan."""

from __future__ import annotations

from typing import Any, Callable, NamedTuple

import rospy
from kobuki_msgs.msg import BumperEvent, CliffEvent, WheelDropEvent
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import MarkerArray

from fake_turtlebot_sim.simulator.differential_drive import Pose
from fake_turtlebot_sim.simulator.laser import Laser
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.sensors import Sensed
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from fake_turtlebot_sim.simulator.world import World
from fake_turtlebot_sim.simulator.world_messages import bumper_markers
from node_kit.prompt_publisher import PromptPublisher

QUEUE = 30  # of events, none of which may be lost
BOTTOM = (0, 1500)  # what a cliff sensor of the Kobuki reads above ground and above none, about


class Snapshot(NamedTuple):
    """What the sensors are about to report, of one instant."""

    stamp: Any
    pose: Pose
    sensed: Sensed
    others: Any  # discs, as a Scanner takes them


class SensorTopics:
    """Publishers: mobile_base/events/bumper, cliff, wheel_drop, bumper_markers and scan."""

    def __init__(self, name: str, parameters: Parameters, world: World) -> None:
        """Take the name of the robot, empty for the only one."""
        prefix = f"{name}/" if name else ""
        self.scan_frame = prefix + parameters.scan_frame
        self.base_frame = prefix + parameters.base_frame
        self._sensed = Sensed()
        self._events = {
            kind: rospy.Publisher(f"{prefix}mobile_base/events/{topic}", kind, queue_size=QUEUE)
            for topic, kind in (
                ("bumper", BumperEvent), ("cliff", CliffEvent), ("wheel_drop", WheelDropEvent),
            )
        }  # fmt: skip
        self._markers = rospy.Publisher(
            f"{prefix}bumper_markers", MarkerArray, queue_size=1, latch=True
        )
        self._cycles_per_scan = 0
        if parameters.scan_rate:
            self._cycles_per_scan = max(1, round(parameters.rate / parameters.scan_rate))
            self._laser = Laser(parameters, world, name)
            self._scans = PromptPublisher(f"{prefix}scan", LaserScan)
            self._scan = LaserScan()
            self._scan.header.frame_id = self.scan_frame
            self._scan.angle_min = self._laser.angle_min
            self._scan.angle_increment = self._laser.increment
            beams = parameters.scan_beams
            self._scan.angle_max = self._laser.angle_min + (beams - 1) * self._laser.increment
            self._scan.scan_time = self._cycles_per_scan / parameters.rate
            self._scan.range_min = parameters.scan_range_min
            self._scan.range_max = parameters.scan_range_max

    def take(self, robot: SimulatedRobot, stamp: Any, others: Any) -> None:
        """Remember what the sensors of the robot feel; others: discs (n, 3) that it may see."""
        self._snapshot = Snapshot(stamp, robot.true_pose, robot.sensed(), others)

    def publish(self, cycle: int) -> None:
        """Publish what changed, and the scan in every so many cycles."""
        sensed = self._snapshot.sensed
        if sensed != self._sensed:
            self._publish_events(self._sensed, sensed)
            self._sensed = sensed
        if self._cycles_per_scan and cycle % self._cycles_per_scan == 0 and self._scans.listeners:
            self._scan.header.stamp = self._snapshot.stamp
            self._scan.ranges = self._laser.measure(self._snapshot.pose, self._snapshot.others)
            self._scans.publish(self._scan)

    def _publish_events(self, before: Sensed, after: Sensed) -> None:
        makers: tuple[tuple[type, Callable[[int, bool], Any]], ...] = (
            (BumperEvent, lambda k, is_on: BumperEvent(state=int(is_on), bumper=k)),
            (
                CliffEvent,
                lambda k, is_on: CliffEvent(sensor=k, state=int(is_on), bottom=BOTTOM[is_on]),
            ),
            (WheelDropEvent, lambda k, is_on: WheelDropEvent(state=int(is_on), wheel=k)),
        )
        for (kind, make), was, now in zip(makers, before, after):
            for k, (old, new) in enumerate(zip(was, now)):
                if old != new:
                    self._events[kind].publish(make(k, new))
        if before.bumpers != after.bumpers:
            markers = bumper_markers(after.bumpers, self.base_frame)
            self._markers.publish(MarkerArray(markers))
