"""The topics of one robot; the node decides when they speak."""

import time

import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs import srv

from fake_turtlebot_sim.simulator.ros_messages import RobotMessages, pose_on_floor
from fake_turtlebot_sim.simulator.simulated_robot import REST, SimulatedRobot
from fake_turtlebot_sim.simulator.velocity_command import Verdict
from node_kit.arming import Resumption
from node_kit.prompt_publisher import PromptPublisher


class RobotTopics:
    """A simulated robot and its topics, in the namespace of its name if it has one."""

    def __init__(self, name, start_pose, parameters, motion, warn):
        """Take the start pose (x, y, yaw), the Parameters and the Motion shared by all robots.

        warn: called with a line for the user; it must not wait.
        """
        prefix = f"{name}/" if name else ""
        self._name = name or "the robot"
        self._motion = motion
        self._resumption = Resumption()
        self._warn = warn
        self._said = set()
        self._has_ended = False
        self.rejected = 0
        self.robot = SimulatedRobot(parameters.robot_model(name), start_pose)
        self.odom_frame = prefix + parameters.odom_frame
        # The frames a pose may be given in: that of all robots lies on that of each odometry.
        self._frames = [self.odom_frame] + ([parameters.world_frame] if name else [])
        self.messages = RobotMessages(parameters, prefix)
        self._odom = PromptPublisher(f"{prefix}odom", Odometry)
        self._joints = PromptPublisher(f"{prefix}joint_states", JointState)
        if self.robot.has_errors:
            self._ground_truth = PromptPublisher(f"{prefix}base_pose_ground_truth", Odometry)
        for topic, kind, callback in (
            ("cmd_vel", Twist, self._on_cmd_vel),
            ("initialpose", PoseWithCovarianceStamped, self._on_initialpose),
            ("mobile_base/commands/reset_odometry", Empty, self._on_reset),
        ):
            # Only the newest counts, so none may wait behind it.
            rospy.Subscriber(prefix + topic, kind, callback, queue_size=1, tcp_nodelay=True)
        if name:  # of a single robot the node's own does the same
            rospy.Service(f"{prefix}reset", srv.Empty, self._on_reset_call)

    def tell(self, stamp):
        """Write the robot's state into its messages; call while the motion is held."""
        self.messages.tell(self.robot, stamp)

    def publish(self):
        """Publish what was told last."""
        self._odom.publish(self.messages.odometry)
        self._joints.publish(self.messages.joints)
        if self.robot.has_errors:
            self._ground_truth.publish(self.messages.ground_truth)

    def end(self, now):
        """Stop the robot for good; call while the motion is held."""
        self.robot.command(REST, now.motion_ns)
        self._has_ended = True

    def _on_cmd_vel(self, twist):
        with self._motion.hold() as now:
            if self._has_ended or not self._takes(twist):
                return
            verdict = self.robot.command((twist.linear.x, twist.angular.z), now.motion_ns)
            self.rejected += verdict is Verdict.REJECTED
        if verdict is not Verdict.ACCEPTED:
            self._say_once(f"cmd_vel of {self._name}: {verdict.value}")

    def _takes(self, twist):
        """Whether a command may be obeyed: after a suspension none before a stop that is new."""
        now = time.monotonic()
        if self._resumption.notice(self._motion.suspensions.number(), now):
            self._warn(f"{self._name} was suspended: it obeys again after a command to stand.")
        stops = not (twist.linear.x or twist.angular.z)
        return not self._resumption.holds(stops, now)

    def _on_initialpose(self, message):
        try:
            pose = pose_on_floor(message, self._frames)
        except ValueError as error:
            self._warn(f"initialpose of {self._name}: {error}")
            return
        with self._motion.hold() as now:
            self.robot.advance(now.motion_ns)
            self.robot.place(pose)

    def _on_reset(self, _empty):
        with self._motion.hold() as now:
            self.robot.advance(now.motion_ns)
            self.robot.reset()

    def _on_reset_call(self, request):
        self._on_reset(request)
        return srv.EmptyResponse()

    def _say_once(self, text):
        if text not in self._said:
            self._said.add(text)
            self._warn(text)
