"""The node kobuki_node: the driver's topics and its serial port."""

from __future__ import annotations

import threading
import time
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from kobuki_msgs import msg
from std_msgs.msg import Empty

from kobuki_driver.errors import PortError
from kobuki_driver.io.serial_port import SerialPort
from kobuki_driver.parameters import KobukiParameters, parse_parameters
from kobuki_driver.robot.diagnostics import entries
from kobuki_driver.robot.velocity_control import VelocityResult
from kobuki_driver.ros.base_topics import BaseTopics, DiagnosticTopic
from kobuki_driver.ros.kobuki_link import KobukiLink
from kobuki_protocol import command_messages
from kobuki_protocol.battery import Battery
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.connections import report_bad_messages
from node_kit.ros.rospy_patches.fresh_only import FreshOnly
from node_kit.rules.throttle import ThrottleEach

NODE_NAME = "kobuki_node"
LOOK_AGAIN_S = 1.0  # between two attempts to open the port
DIAGNOSTICS_S = 1.0
LONGEST_END_S = 0.3  # for the last zero
SAME_LINE_HZ = 0.1  # at which a line is repeated, at most


class KobukiNode:
    """Drives a Kobuki at a serial port; waits for the port and the robot whenever one is missing.

    Subscribers: ~commands/velocity (geometry_msgs/Twist), ~commands/reset_odometry
        (std_msgs/Empty), ~commands/motor_power, led1, led2, digital_output, external_power, sound,
        controller_info (kobuki_msgs)
    Publishers: ~odom (nav_msgs/Odometry), ~joint_states (sensor_msgs/JointState), /tf,
        ~sensors/core (kobuki_msgs/SensorState), ~sensors/dock_ir, ~sensors/imu_data, imu_data_raw
        (sensor_msgs/Imu), ~events/button, bumper, cliff, wheel_drop, power_system, digital_input,
        latched ~events/robot_state, ~version_info, ~controller_info (kobuki_msgs),
        ~debug/raw_data_stream, raw_data_command, raw_control_command, /diagnostics
    Parameters: parameters.KobukiParameters, as a table in README.md
    """

    def __init__(self, parameters: KobukiParameters) -> None:
        """Subscribe; spin() opens the port."""
        self._parameters = parameters
        self._log = Log()
        self._throttle = ThrottleEach(SAME_LINE_HZ)
        report_bad_messages(self._log.warn)
        topics = BaseTopics(parameters, frame_prefix())
        self._line = KobukiLink(parameters, topics, self._report)
        self._diagnostics, self._diagnosed_s = DiagnosticTopic(), 0.0
        self._encoder = command_messages.CommandEncoder()
        self._fresh, self._velocity_lock = FreshOnly(), threading.Lock()
        self._ending, self._has_ended = threading.Event(), threading.Event()
        self._subscribe()
        rospy.on_shutdown(self._end)

    def _subscribe(self) -> None:
        velocity = rospy.Subscriber(
            "~commands/velocity", Twist, self._on_velocity, queue_size=1, tcp_nodelay=True
        )
        self._fresh.watch(velocity)
        rospy.Subscriber("~commands/reset_odometry", Empty, self._on_reset, queue_size=1)
        rospy.Subscriber("~commands/motor_power", msg.MotorPower, self._on_motor_power)
        for name, kind in command_messages.TOPICS.items():
            rospy.Subscriber(f"~commands/{name}", kind, self._on_command, callback_args=name)

    def spin(self) -> None:
        """Serve the robot until shut down."""
        trouble = ""  # the last error, which is reported once
        while not self._ending.is_set():
            try:
                port = SerialPort(self._parameters.device_port)
            except PortError as error:
                if str(error) != trouble:
                    trouble = str(error)
                    self._log.warn(trouble)
                self._diagnose()
                self._ending.wait(LOOK_AGAIN_S)
                continue
            trouble = ""
            self._serve_until_lost(port)
        self._has_ended.set()

    def _serve_until_lost(self, port: SerialPort) -> None:
        try:
            self._serve(port)
        except PortError as error:
            self._report(str(error), is_bad=True)
            self._ending.wait(LOOK_AGAIN_S)
        finally:
            self._line.close()
            port.close()

    def _serve(self, port: SerialPort) -> None:
        self._line.open(port, time.monotonic())
        while not self._ending.is_set():
            data = port.read()
            if self._line.take(data, time.monotonic(), rospy.Time.now()):
                with self._velocity_lock:
                    self._notice_suspension()
                self._line.command_robot(time.monotonic())
            self._diagnose()
        self._line.rest()

    def _diagnose(self) -> None:
        now = time.monotonic()
        if now - self._diagnosed_s < DIAGNOSTICS_S:
            return
        self._diagnosed_s = now
        line = self._line
        battery = Battery.of(line.feedback.core, self._parameters.battery)
        self._diagnostics.publish(
            entries(line.feedback, battery, line.is_online, line.control.has_power)
        )

    def _report(self, line: str, is_bad: bool = False) -> None:
        if self._throttle.ready(line, time.monotonic()):
            (self._log.warn if is_bad else self._log.info)(line)

    def _notice_suspension(self) -> None:
        if self._fresh.notice():
            self._line.stop()
            self._report("the driver was suspended; commands sent meanwhile are ignored")

    def _on_velocity(self, twist: Any) -> None:
        velocity = twist.linear.x, twist.angular.z
        with self._velocity_lock:
            self._notice_suspension()
            if self._ending.is_set() or self._fresh.is_old(twist):
                return
            result = self._line.command(velocity, time.monotonic())
        if result is not VelocityResult.OBEYED:
            self._report(f"commands/velocity: {result.value}", is_bad=True)

    def _on_reset(self, _message: Any) -> None:
        self._line.reset_odometry()

    def _on_motor_power(self, message: Any) -> None:
        if message.state not in (msg.MotorPower.ON, msg.MotorPower.OFF):
            what = f"{message.state} is neither 0 (off) nor 1 (on); the motors stay as they are"
            self._log.error(f"commands/motor_power: {what}")
            return
        is_on = message.state == msg.MotorPower.ON
        self._line.switch_motors(is_on)
        self._log.info(f"the motors are {'on' if is_on else 'off'}, by commands/motor_power")

    def _on_command(self, message: Any, topic: str) -> None:
        try:
            self._line.send(self._encoder.command(topic, message))
        except ValueError as error:
            self._log.error(f"commands: {error}; ignored")

    def _end(self) -> None:
        """Stop the robot, and wait until the last zero was sent."""
        self._line.stop()
        self._ending.set()
        self._has_ended.wait(LONGEST_END_S)


def frame_prefix() -> str:
    """Return the tf_prefix of the namespace with a slash, as in ROS 1, or ""."""
    name = rospy.search_param("tf_prefix")
    return f"{rospy.get_param(name)}/".lstrip("/") if name else ""


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, parse_parameters, lambda p: KobukiNode(p).spin(), keeps_name=True)
