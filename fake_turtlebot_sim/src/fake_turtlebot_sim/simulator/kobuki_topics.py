"""The topics of a Kobuki beside velocity and odometry: kobuki_node's, in its namespace."""

from __future__ import annotations

from math import cos, sin
from sys import float_info
from typing import Any

import rospy
from geometry_msgs.msg import Quaternion, Vector3
from kobuki_msgs import msg
from sensor_msgs.msg import Imu
from std_msgs.msg import Header

from fake_turtlebot_sim.simulator.kobuki import EVENTS, QUEUE, core
from fake_turtlebot_sim.simulator.ros_clock import Motion
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from node_kit.rospy_patches.prompt_publisher import PromptPublisher

VERSION = msg.VersionInfo("1.0.4", "1.2.0", "simulated", [0, 0, 0], 3)  # both features
# Of heading and turning [rad2, rad2/s2]: about x and y nothing is known (kobuki_node).
COVARIANCE = (float_info.max, 0.0, 0.0, 0.0, float_info.max, 0.0, 0.0, 0.0, 0.005)
WITHOUT_EFFECT = {  # commands that change nothing here; the cockpit shows LEDs and sounds
    "led1": msg.Led, "led2": msg.Led, "sound": msg.Sound, "digital_output": msg.DigitalOutput,
    "external_power": msg.ExternalPower, "controller_info": msg.ControllerInfo,
}  # fmt: skip
NEVER_SENT = {"power_system": msg.PowerSystemEvent, "digital_input": msg.DigitalInputEvent}


class KobukiTopics:
    """Sensors, events and commands of a Kobuki, and a topic that presses its buttons."""

    def __init__(self, prefix: str, robot: SimulatedRobot, motion: Motion, in_world: bool) -> None:
        """Take the prefix of all names; in a world WorldTopics has the events of bumpers."""
        self._prefix, self._robot, self._motion = prefix, robot, motion
        self._pressed = [False] * 3  # buttons
        base = f"{prefix}mobile_base/"
        self._sensors = [
            (PromptPublisher(f"{base}sensors/core", msg.SensorState), self._core),
            (PromptPublisher(f"{base}sensors/imu_data", Imu), self._imu),
            (PromptPublisher(f"{base}sensors/imu_data_raw", Imu), self._raw_imu),
            (PromptPublisher(f"{base}sensors/dock_ir", msg.DockInfraRed), self._dock_ir),
        ]
        silent = NEVER_SENT if in_world else {**NEVER_SENT, **{name: e for name, e, _ in EVENTS}}
        for name, kind in silent.items():
            rospy.Publisher(f"{base}events/{name}", kind, queue_size=QUEUE)
        self._button = rospy.Publisher(f"{base}events/button", msg.ButtonEvent, queue_size=QUEUE)
        online = msg.RobotStateEvent(msg.RobotStateEvent.ONLINE)
        for name, latched in (("version_info", VERSION), ("events/robot_state", online)):
            rospy.Publisher(base + name, type(latched), queue_size=1, latch=True).publish(latched)
        for name, kind in WITHOUT_EFFECT.items():
            rospy.Subscriber(f"{base}commands/{name}", kind)
        rospy.Subscriber(f"{base}commands/motor_power", msg.MotorPower, self._on_motor_power)
        rospy.Subscriber(f"{base}press", msg.ButtonEvent, self._on_press)

    def messages(self, stamp: rospy.Time) -> list[tuple[PromptPublisher, Any]]:
        """Return what subscribers are to get; call while the motion is held."""
        return [(topic, make(stamp)) for topic, make in self._sensors if topic.listeners]

    def _core(self, stamp: rospy.Time) -> msg.SensorState:
        packet = core(stamp.to_nsec(), self._robot, self._pressed)
        packet.header.stamp = stamp
        return packet

    def _raw_imu(self, stamp: rospy.Time) -> Imu:
        header = Header(0, stamp, f"{self._prefix}gyro_link")
        return Imu(header=header, angular_velocity=Vector3(0.0, 0.0, self._robot.state().w))

    def _imu(self, stamp: rospy.Time) -> Imu:
        imu, half = self._raw_imu(stamp), 0.5 * self._robot.state().yaw
        imu.orientation = Quaternion(0.0, 0.0, sin(half), cos(half))
        imu.orientation_covariance = imu.angular_velocity_covariance = COVARIANCE
        return imu

    def _dock_ir(self, stamp: rospy.Time) -> msg.DockInfraRed:
        return msg.DockInfraRed(Header(0, stamp, f"{self._prefix}dock_ir_link"), bytes(3))

    def _on_motor_power(self, message: msg.MotorPower) -> None:
        with self._motion.hold() as now:
            self._robot.switch_motors(message.state == msg.MotorPower.ON, now.motion_ns)

    def _on_press(self, event: msg.ButtonEvent) -> None:
        if event.button < len(self._pressed):
            self._pressed[event.button] = event.state == msg.ButtonEvent.PRESSED
            self._button.publish(event)
