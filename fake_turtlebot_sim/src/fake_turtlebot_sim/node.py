"""The node: ROS on one side, SimulatedRobot on the other, and no arithmetic in between."""

import sys
import threading
import time

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from fake_turtlebot_sim.clock import MotionClock, PhaseLock
from fake_turtlebot_sim.parameters import parse_parameters
from fake_turtlebot_sim.ros_messages import RobotMessages
from fake_turtlebot_sim.simulated_robot import RobotModel, SimulatedRobot
from fake_turtlebot_sim.velocity_command import VelocityLimits

QUEUE_SIZE = 10  # a fifth of a second at 50 Hz: what a slow subscriber may be late


class FakeTurtlebot:
    """Simulates a TurtleBot 2.

    Subscribers: cmd_vel (geometry_msgs/Twist).
    Publishers: odom (nav_msgs/Odometry), joint_states (sensor_msgs/JointState), /tf.
    """

    def __init__(self, parameters):
        self._lock = threading.Lock()
        self._publish_tf = parameters.publish_tf
        self._simulated_time = not rospy.rostime.is_wallclock()
        self._motion_clock = MotionClock(self._read_clock())
        self._period_ns = round(1e9 / parameters.rate)
        limits = VelocityLimits(
            parameters.max_linear_speed,
            parameters.max_angular_speed,
            parameters.max_linear_acceleration,
            parameters.max_angular_acceleration,
        )
        model = RobotModel(
            parameters.wheel_separation,
            parameters.wheel_radius,
            parameters.cmd_vel_timeout,
            limits,
        )
        pose = (parameters.initial_x, parameters.initial_y, parameters.initial_yaw)
        self._robot = SimulatedRobot(model, pose)
        joints = (parameters.left_wheel_joint, parameters.right_wheel_joint)
        self._messages = RobotMessages(parameters.odom_frame, parameters.base_frame, joints)
        self._odom = rospy.Publisher("odom", Odometry, queue_size=QUEUE_SIZE)
        self._joints = rospy.Publisher("joint_states", JointState, queue_size=QUEUE_SIZE)
        # Absolute, as every listener of tf2 subscribes to it.
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=QUEUE_SIZE)
        rospy.Subscriber("cmd_vel", Twist, self._on_cmd_vel, queue_size=1, tcp_nodelay=True)

    def spin(self):
        """Publish until shut down."""
        lock = PhaseLock(self._period_ns, time.monotonic_ns())
        while not rospy.is_shutdown():
            self._cycle()
            lock.complete(time.monotonic_ns())
            time.sleep(max(0, lock.deadline_ns - time.monotonic_ns()) * 1e-9)

    def _read_clock(self):
        return rospy.Time.now().to_nsec() if self._simulated_time else time.monotonic_ns()

    def _on_cmd_vel(self, twist):
        with self._lock:
            now_ns = self._motion_clock.update(self._read_clock())
            accepted = self._robot.command((twist.linear.x, twist.angular.z), now_ns)
        if not accepted:
            rospy.logwarn_once("cmd_vel: a velocity is not a finite number; ignored")

    def _cycle(self):
        with self._lock:
            stamp = rospy.Time.now()
            self._robot.advance(self._motion_clock.update(self._read_clock()))
            state = self._robot.state()
        self._messages.fill(state, stamp)
        self._odom.publish(self._messages.odometry)
        self._joints.publish(self._messages.joints)
        if self._publish_tf:
            self._tf.publish(TFMessage([self._messages.transform]))


def main():
    """Run the node and return its exit code."""
    if not rosgraph.is_master_online():
        print("fake_turtlebot: no ROS master; start roscore or use roslaunch", file=sys.stderr)
        return 1
    rospy.init_node("fake_turtlebot")
    try:
        parameters = parse_parameters(rospy.get_param("~", {}))
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 1
    FakeTurtlebot(parameters).spin()
    return 0
