"""The node fake_turtlebot: ROS around the simulated robots."""

from __future__ import annotations

import threading
from dataclasses import replace
from typing import Any

import diagnostic_updater
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from std_srvs.srv import Empty, EmptyResponse
from tf2_msgs.msg import TFMessage

from fake_turtlebot_sim.ros.robot_topics import RobotTopics
from fake_turtlebot_sim.ros.ros_clock import Instant, MotionLock
from fake_turtlebot_sim.ros.world_topics import WorldTopics
from fake_turtlebot_sim.simulator.clock import PhaseLock
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from fake_turtlebot_sim.simulator.robot_messages import ORIGIN, Place, static_transform
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.connections import report_bad_messages
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

NODE_NAME = "fake_turtlebot"
LONGEST_END_S = 0.3  # for the last messages, as /clock may be paused


class FakeTurtlebot:
    """One TurtleBot 2, or with ~robots several, each in the namespace of its name.

    Subscribers: cmd_vel (geometry_msgs/Twist), initialpose (PoseWithCovarianceStamped),
        mobile_base/commands/reset_odometry (std_msgs/Empty); with ~kobuki those of kobuki_topics
    Publishers: odom (nav_msgs/Odometry), joint_states (sensor_msgs/JointState),
        base_pose_ground_truth (nav_msgs/Odometry; in a world, or if the odometry has errors),
        in a world map (nav_msgs/OccupancyGrid), map_metadata (nav_msgs/MapMetaData), both latched,
        world_markers (MarkerArray) and
        for each robot scan (sensor_msgs/LaserScan), bumper_markers (MarkerArray) and
        mobile_base/events/bumper, cliff, wheel_drop (kobuki_msgs),
        /tf and /tf_static (tf2_msgs/TFMessage), /diagnostics (diagnostic_msgs/DiagnosticArray)
    Services: ~reset (std_srvs/Empty), and NAME/reset for each of several robots; in a world
        static_map (nav_msgs/GetMap), change_map (nav_msgs/LoadMap)
    Parameters: parameters.SimulatorParameters, as a table in README.md
    """

    def __init__(self, parameters: SimulatorParameters) -> None:
        """Put the robots at their start poses; spin() publishes them."""
        log, parameters = Log(), prefixed(parameters)
        report_bad_messages(log.warn)
        world = parameters.world
        if world and world.grid and not world.start and None in parameters.given_poses().values():
            x, y, _ = world.start_pose
            log.info(f"the map has no start: took the free place nearest to (0, 0), ({x:g}, {y:g})")
        self._motion = MotionLock()
        self._period_ns = parameters.period_ns()
        self._rate = parameters.rate
        # An absolute name, as in tf2, and one message for all robots.
        self._tf = PromptPublisher("/tf", TFMessage)
        self._topics = [
            RobotTopics(name, pose, parameters, self._motion, log)
            for name, pose in parameters.start_poses().items()
        ]
        self._transforms = TFMessage()
        if parameters.publish_tf:
            self._transforms.transforms = [topics.messages.transform for topics in self._topics]
            if parameters.world:
                self._transforms.transforms += [topics.messages.in_map for topics in self._topics]
        self._world: WorldTopics | None = None
        frames = [(parameters.world_frame, t.odom_frame, ORIGIN) for t in self._topics]
        if parameters.world:
            robots = {topics.name: topics.robot for topics in self._topics}
            self._world = WorldTopics(parameters, parameters.world, robots, log.warn)
            frames = self._world.frames()
        if parameters.publish_tf and (parameters.world or parameters.robots):
            self._publish_static(frames)
        self._cycles = self._missed = self._reported_rejected = 0  # since the last report
        self._cycle_number = 0
        self._diagnostics = diagnostic_updater.Updater()
        self._diagnostics.setHardwareID("none (simulated)")
        self._diagnostics.add("simulation", self._report)
        rospy.Service("~reset", Empty, self._on_reset)
        self._is_ending = False
        self._has_ended = threading.Event()  # set when the robots were published at rest
        rospy.on_shutdown(self._end)

    def spin(self) -> None:
        """Publish until shut down."""
        schedule = None
        while not self._is_ending:
            now = self._cycle()
            if schedule is None:
                schedule = PhaseLock(self._period_ns, now.reading_ns)
            self._count(schedule.complete(now.reading_ns))
            self._motion.clock.wait(now.reading_ns, schedule.deadline_ns)
        self._cycle()
        self._has_ended.set()

    def _cycle(self) -> Instant:
        """Move all robots to the present and publish it."""
        with self._motion.hold() as now:
            if self._world:
                self._world.before_move()
            for topics in self._topics:
                topics.move(now)
            if self._world:
                self._world.after_move(now.stamp)
        self._cycle_number += 1
        if now.stamp:  # 0: simulated time has not started
            for topics in self._topics:
                topics.publish()
            if self._world:
                self._world.publish(self._cycle_number)
            if self._transforms.transforms:
                self._tf.publish(self._transforms)
        return now

    def _publish_static(self, frames: list[tuple[str, str, Place]]) -> None:
        """Publish static frames: (parent, child, place [m] in the parent)."""
        stamp = rospy.Time.now()
        self._tf_static = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        self._tf_static.publish(TFMessage([static_transform(frame, stamp) for frame in frames]))

    def _end(self) -> None:
        """Stop the robots, and wait until their last state is published."""
        with self._motion.hold() as now:
            for topics in self._topics:
                topics.end(now)
        self._is_ending = True
        self._has_ended.wait(LONGEST_END_S)

    def _on_reset(self, _request: Any) -> Any:
        for topics in self._topics:
            topics.reset()
        return EmptyResponse()

    def _count(self, missed: int) -> None:
        """Count a cycle and the periods missed before it; report once a second."""
        self._cycles += 1
        self._missed += missed
        if self._cycles + self._missed >= self._rate:
            self._diagnostics.force_update()
            self._cycles = self._missed = 0

    def _report(self, status: Any) -> Any:
        rejected = sum(topics.rejected for topics in self._topics)
        level, text = DiagnosticStatus.OK, "running"
        if self._missed:
            level = DiagnosticStatus.WARN
            text = "periods missed: busy, or /clock is slower than ~rate"
        elif rejected > self._reported_rejected:
            level, text = DiagnosticStatus.WARN, "commands that are not finite were ignored"
        status.summary(level, text)
        self._reported_rejected = rejected
        status.add("robots", len(self._topics))
        status.add("robots under command", sum(t.robot.is_commanded for t in self._topics))
        status.add("rate [Hz]", self._rate)
        status.add("periods missed in the last second", self._missed)
        status.add("commands rejected since the start", rejected)
        return status


def prefixed(given: SimulatorParameters) -> SimulatorParameters:
    """Return the parameters with the tf_prefix of the namespace before each frame, as in ROS 1."""
    name = rospy.search_param("tf_prefix")
    prefix = f"{rospy.get_param(name)}/".lstrip("/") if name else ""
    odom, base, scan = given.odom_frame, given.base_frame, given.scan_frame
    return replace(
        given, odom_frame=prefix + odom, base_frame=prefix + base, scan_frame=prefix + scan
    )


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, parse_parameters, lambda p: FakeTurtlebot(p).spin(), keeps_name=True)
