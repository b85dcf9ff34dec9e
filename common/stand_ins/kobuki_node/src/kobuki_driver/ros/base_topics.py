"""The topics that the driver publishes, those of kobuki_node, in the node's namespace."""

from __future__ import annotations

from typing import Any

import diagnostic_updater
import rospy
from kobuki_msgs import msg
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Int16MultiArray, String
from tf2_msgs.msg import TFMessage

from kobuki_driver.parameters import KobukiParameters
from kobuki_driver.robot.diagnostics import Entry
from kobuki_protocol import messages
from kobuki_protocol.base_control import Velocity, control_values
from kobuki_protocol.events import QUEUE, Event
from kobuki_protocol.feedback import READING_PERIOD_S, Feedback
from kobuki_protocol.framing import packet
from kobuki_protocol.odometry import OdometryState
from kobuki_protocol.odometry_messages import YAW_VARIANCE_OF_WHEELS, OdometryMessages
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

EVENTS = {
    "button": msg.ButtonEvent,
    "bumper": msg.BumperEvent,
    "cliff": msg.CliffEvent,
    "wheel_drop": msg.WheelDropEvent,
    "power_system": msg.PowerSystemEvent,
    "digital_input": msg.DigitalInputEvent,
}
LATCHED = {
    "version_info": msg.VersionInfo,
    "controller_info": msg.ControllerInfo,
    "events/robot_state": msg.RobotStateEvent,
}
PROMPT = {
    "odom": Odometry,
    "joint_states": JointState,
    "sensors/core": msg.SensorState,
    "sensors/dock_ir": msg.DockInfraRed,
    "sensors/imu_data": Imu,
    "sensors/imu_data_raw": Imu,
    "debug/raw_data_stream": String,
    "debug/raw_data_command": String,
    "debug/raw_control_command": Int16MultiArray,
}
READING = rospy.Duration.from_sec(READING_PERIOD_S)


class BaseTopics:
    """The publishers. Messages other than events and latched ones are made only for subscribers."""

    def __init__(self, parameters: KobukiParameters, prefix: str) -> None:
        """Create the publishers; prefix: for the frames."""
        self._prefix = prefix
        self._prompt = {name: PromptPublisher(f"~{name}", kind) for name, kind in PROMPT.items()}
        self._tf = PromptPublisher("/tf", TFMessage) if parameters.publish_tf else None
        self._queued = {
            f"events/{name}": rospy.Publisher(f"~events/{name}", kind, queue_size=QUEUE)
            for name, kind in EVENTS.items()
        }
        for name, kind in LATCHED.items():
            self._queued[name] = rospy.Publisher(f"~{name}", kind, queue_size=QUEUE, latch=True)
        self._odometry = OdometryMessages(
            prefix + parameters.odom_frame,
            prefix + parameters.base_frame,
            (parameters.wheel_left_joint_name, parameters.wheel_right_joint_name),
        )
        self._odometry.joints.effort = [0.0, 0.0]
        if not parameters.use_imu_heading:
            self._odometry.odometry.pose.covariance[-1] = YAW_VARIANCE_OF_WHEELS
        self._transforms = TFMessage([self._odometry.transform])

    def odometry(self, state: OdometryState, stamp: rospy.Time) -> None:
        """Publish pose, transform and wheel joints."""
        self._odometry.write(state, stamp)
        if self._tf:
            self._tf.publish(self._transforms)
        self._prompt["odom"].publish(self._odometry.odometry)
        self._prompt["joint_states"].publish(self._odometry.joints)

    def sensors(self, feedback: Feedback, heading: float, stamp: rospy.Time) -> None:
        """Publish the sensor values of a packet; heading: the gyro's [rad]."""
        prefix = self._prefix
        if self._is_wanted("sensors/core"):
            self._send("sensors/core", messages.sensor_state(feedback, stamp))
        if self._is_wanted("sensors/imu_data"):
            rate = feedback.inertia.turn_rate
            self._send("sensors/imu_data", messages.imu(heading, rate, stamp, prefix))
        if self._is_wanted("sensors/dock_ir"):
            self._send("sensors/dock_ir", messages.dock_infrared(feedback, stamp, prefix))
        if self._is_wanted("sensors/imu_data_raw") and stamp.to_nsec() > 3 * READING.to_nsec():
            count = len(feedback.gyro.readings)
            stamps = [stamp - READING * (count - 1 - k) for k in range(count)]
            for imu in messages.raw_imu(feedback.gyro, stamps, prefix):
                self._send("sensors/imu_data_raw", imu)

    def stream(self, payload: bytes) -> None:
        """Publish a received packet."""
        if self._is_wanted("debug/raw_data_stream"):
            self._send("debug/raw_data_stream", messages.stream_text(packet(payload)))

    def sent(self, data: bytes) -> None:
        """Publish a sent packet."""
        if self._is_wanted("debug/raw_data_command"):
            self._send("debug/raw_data_command", messages.command_text(data))

    def control(self, velocity: Velocity) -> None:
        """Publish the velocity that was commanded."""
        if self._is_wanted("debug/raw_control_command"):
            values = Int16MultiArray(data=control_values(*velocity))
            self._send("debug/raw_control_command", values)

    def events(self, made: list[Event]) -> None:
        """Publish events."""
        for name, event in made:
            self._queued[f"events/{name}"].publish(event)

    def latch(self, name: str, message: Any) -> None:
        """Publish a message on a latched topic."""
        self._queued[name].publish(message)

    def _is_wanted(self, name: str) -> bool:
        return self._prompt[name].listeners > 0

    def _send(self, name: str, message: Any) -> None:
        self._prompt[name].publish(message)


class DiagnosticTopic:
    """Publishes entries on /diagnostics."""

    def __init__(self) -> None:
        """Start without entries."""
        self._updater = diagnostic_updater.Updater()
        self._updater.setHardwareID("Kobuki")
        self._entries: dict[str, Entry] = {}

    def publish(self, entries: list[Entry]) -> None:
        """Publish entries, whose names are the same in each call."""
        for entry in entries:
            if entry.name not in self._entries:
                self._updater.add(entry.name, lambda status, of=entry.name: self._fill(status, of))
            self._entries[entry.name] = entry
        self._updater.force_update()

    def _fill(self, status: Any, name: str) -> Any:
        entry = self._entries[name]
        status.summary(entry.level, entry.text)
        for key, value in entry.values.items():
            status.add(key, str(value))
        return status
