"""The topics of one robot; the node decides when to publish."""

from __future__ import annotations

from typing import Any, Callable

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs import srv

from fake_turtlebot_sim.ros.kobuki_topics import KobukiTopics
from fake_turtlebot_sim.ros.ros_clock import Instant, MotionLock
from fake_turtlebot_sim.simulator.differential_drive import Pose, composed
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.robot_messages import RobotMessages, between_frames, pose_on_plane
from fake_turtlebot_sim.simulator.simulated_robot import REST, CommandResult, SimulatedRobot
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.fresh_only import FreshOnly
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher


class RobotTopics:
    """A simulated robot and its topics, in the namespace of its name if it has one."""

    def __init__(
        self,
        name: str,
        start_pose: Pose,
        parameters: SimulatorParameters,
        motion: MotionLock,
        log: Log,
    ) -> None:
        """Create the robot and its topics; motion: shared by all robots."""
        prefix = f"{name}/" if name else ""
        self.name = name
        self._name = name or "the robot"
        self._motion = motion
        self._fresh = FreshOnly(motion.suspensions)
        self._log, self._warn = log, log.warn
        self._reported: set[str] = set()
        self._has_ended = False
        self._timeout_s = parameters.cmd_vel_timeout
        self.rejected = 0
        self.robot = SimulatedRobot(parameters, start_pose, name)
        self.odom_frame = prefix + parameters.odom_frame
        # The frames of a pose from outside; world_frame coincides with each odometry frame.
        self._frames = [self.odom_frame] + ([parameters.world_frame] if name else [])
        self._is_in_world = parameters.world is not None
        if parameters.world:
            self._frames.append(parameters.map_frame)
        self.messages = RobotMessages(parameters, prefix)
        self._publishers = [
            (PromptPublisher(f"{prefix}odom", Odometry), self.messages.odometry),
            (PromptPublisher(f"{prefix}joint_states", JointState), self.messages.joints),
        ]
        if self.robot.odometry_differs:
            truth = PromptPublisher(f"{prefix}base_pose_ground_truth", Odometry)
            self._publishers.append((truth, self.messages.ground_truth))
        for topic, kind, callback in (
            ("cmd_vel", Twist, self._on_cmd_vel),
            ("initialpose", PoseWithCovarianceStamped, self._on_initialpose),
            ("mobile_base/commands/reset_odometry", Empty, self._on_reset_odometry),
        ):
            # Only the newest message counts, so none may be queued.
            subscriber = rospy.Subscriber(
                prefix + topic, kind, callback, queue_size=1, tcp_nodelay=True
            )
            if kind is Twist:
                self._fresh.watch(subscriber)
        kobuki = prefix, self.robot, parameters, motion, log
        self._kobuki = KobukiTopics(*kobuki) if parameters.kobuki else None
        if name:  # a single robot has the node's own service
            rospy.Service(f"{prefix}reset", srv.Empty, self._on_reset)

    def move(self, now: Instant) -> None:
        """Move the robot to the present and fill its messages; call it with the motion held."""
        self._notice_suspension(now)
        if self.robot.advance(now.motion_ns):
            what = (
                f"no command came for {self._timeout_s:g} s, so it stopped in the middle of a"
                f" motion; send more often, or set {rospy.get_name()}/cmd_vel_timeout: 0 (never) in"
                " the YAML file of config:="
            )
            self._report_once(what, self._log.info)
        self.messages.fill(self.robot, now.stamp)
        self._sensed = self._kobuki.messages(now.stamp) if self._kobuki else []

    def publish(self) -> None:
        """Publish the messages that move() filled."""
        for publisher, message in (*self._publishers, *self._sensed):
            publisher.publish(message)

    def end(self, now: Instant) -> None:
        """Stop the robot for good; call it with the motion held."""
        self.robot.command(REST, now.motion_ns)
        self._has_ended = True

    def reset(self) -> None:
        """Return the robot to its start."""
        with self._motion.hold() as now:
            self.robot.advance(now.motion_ns)
            self._lift(self.robot.reset)

    def _lift(self, put: Callable[[], None]) -> None:
        try:
            put()
        except ValueError as error:
            self._warn(f"{self._name} stays where it is: {error}")

    def _on_reset_odometry(self, _message: Any) -> None:
        with self._motion.hold() as now:
            self.robot.advance(now.motion_ns)
            self.robot.reset_odometry()

    def _on_reset(self, _request: Any) -> Any:
        self.reset()
        return srv.EmptyResponse()

    def _on_cmd_vel(self, twist: Any) -> None:
        with self._motion.hold() as now:
            self._notice_suspension(now)
            if self._has_ended or self._fresh.is_old(twist):
                return
            result = self.robot.command((twist.linear.x, twist.angular.z), now.motion_ns)
            self.rejected += result is CommandResult.REJECTED
        if result is not CommandResult.ACCEPTED:
            self._report_once(result.value, self._log.warn)

    def _report_once(self, what: str, report: Callable[[str], object]) -> None:
        if what not in self._reported:
            self._reported.add(what)
            report(f"cmd_vel of {self._name}: {what}")

    def _notice_suspension(self, now: Instant) -> None:
        if self._fresh.notice():
            self.robot.command(REST, now.motion_ns)
            self._warn(f"{self._name} was suspended. Commands sent meanwhile are ignored.")

    def _on_initialpose(self, message: Any) -> None:
        try:
            pose = pose_on_plane(message, self._frames)
        except ValueError as error:
            self._warn(f"initialpose of {self._name}: {error}")
            return
        with self._motion.hold() as now:
            self.robot.advance(now.motion_ns)
            if self._is_in_world and message.header.frame_id.lstrip("/") == self.odom_frame:
                frame = between_frames(self.robot.true_pose, self.robot.state()[:3])
                pose = composed(frame, pose)
            self._lift(lambda: self.robot.place(pose))
