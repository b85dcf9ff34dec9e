"""The topics of kobuki_node other than velocity and odometry, in its namespace."""

from __future__ import annotations

from typing import Any, Callable

import rospy
from kobuki_msgs import msg
from sensor_msgs.msg import Imu
from std_msgs.msg import Int16MultiArray, String

from fake_turtlebot_sim.ros.ros_clock import MotionLock
from fake_turtlebot_sim.simulator.differential_drive import wrap_angle
from fake_turtlebot_sim.simulator.kobuki_feedback import sensors, with_gyro
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from kobuki_protocol import command_messages, commands, messages, robot_packets
from kobuki_protocol.base_control import base_control, control_values
from kobuki_protocol.events import EVENTS, QUEUE
from kobuki_protocol.feedback import Feedback, RawGyro
from kobuki_protocol.identity import Controller, FirmwareVersion, HardwareVersion, UniqueId
from node_kit.ros.log import Log
from node_kit.ros.rospy_patches.prompt_publisher import PromptPublisher

IDENTITY = HardwareVersion(4, 0, 1), FirmwareVersion(0, 2, 1), UniqueId((0, 0, 0))
# Published once: the answers of a Kobuki to its driver's requests.
LATCHED = {
    "version_info": messages.version_info(*IDENTITY, software="simulated"),
    "controller_info": messages.controller_info(Controller()),
    "events/robot_state": msg.RobotStateEvent(msg.RobotStateEvent.ONLINE),
}
NEVER_SENT = {"power_system": msg.PowerSystemEvent, "digital_input": msg.DigitalInputEvent}
GYRO_READINGS = 2  # in a packet


class KobukiTopics:
    """The sensors, events and commands of a Kobuki, and a topic that presses its buttons."""

    def __init__(
        self,
        prefix: str,
        robot: SimulatedRobot,
        parameters: SimulatorParameters,
        motion: MotionLock,
        log: Log,
    ) -> None:
        """Take the prefix of all names; in a world, WorldTopics publishes the bumper events."""
        self._prefix, self._robot, self._motion, self._log = prefix, robot, motion, log
        self._rad_per_turned = parameters.wheel_radius / parameters.wheel_separation
        self._reading_ns = parameters.period_ns() // GYRO_READINGS
        self._pressed = [False] * 3  # buttons
        self._rate_before = 0.0  # [rad/s] in the last period
        self._sent: list[bytes] = []  # commands, since the last packet
        base = f"{prefix}mobile_base/"
        self._sensors: list[tuple[PromptPublisher, Callable[[rospy.Time], list[Any]]]] = [
            (PromptPublisher(f"{base}sensors/core", msg.SensorState), self._core),
            (PromptPublisher(f"{base}sensors/imu_data", Imu), self._imu),
            (PromptPublisher(f"{base}sensors/imu_data_raw", Imu), self._raw_imu),
            (PromptPublisher(f"{base}sensors/dock_ir", msg.DockInfraRed), self._dock_ir),
            (PromptPublisher(f"{base}debug/raw_data_stream", String), self._stream),
            (PromptPublisher(f"{base}debug/raw_control_command", Int16MultiArray), self._control),
        ]
        self._commands = PromptPublisher(f"{base}debug/raw_data_command", String)
        self._sensors.append((self._commands, self._raw_commands))
        silent = {**NEVER_SENT, **({} if parameters.world else {name: e for name, e, _ in EVENTS})}
        for name, kind in silent.items():
            rospy.Publisher(f"{base}events/{name}", kind, queue_size=QUEUE)
        self._button = rospy.Publisher(f"{base}events/button", msg.ButtonEvent, queue_size=QUEUE)
        for name, latched in LATCHED.items():
            rospy.Publisher(base + name, type(latched), queue_size=1, latch=True).publish(latched)
        self._subscribe(f"{base}commands/")
        rospy.Subscriber(f"{base}commands/motor_power", msg.MotorPower, self._on_motor_power)
        rospy.Subscriber(f"{base}press", msg.ButtonEvent, self._on_press)

    def _subscribe(self, base: str) -> None:
        """Subscribe to commands without effect here; the cockpit shows LEDs and sounds."""
        encoder = command_messages.CommandEncoder()
        for name, kind in command_messages.TOPICS.items():
            rospy.Subscriber(base + name, kind, self._on_command, callback_args=(encoder, name))

    def messages(self, stamp: rospy.Time) -> list[tuple[PromptPublisher, Any]]:
        """Return the messages to publish; call it once a period, with the motion held."""
        sensors = [(topic, make) for topic, make in self._sensors if topic.listeners]
        made = [(topic, message) for topic, make in sensors for message in make(stamp)]
        if made:
            self._rate_before = self._robot.state().w
        self._sent.clear()
        return made

    def _feedback(self, stamp: rospy.Time) -> Feedback:
        return sensors(stamp.to_nsec(), self._robot, self._pressed)

    def _core(self, stamp: rospy.Time) -> list[msg.SensorState]:
        return [messages.sensor_state(self._feedback(stamp), stamp)]

    def _imu(self, stamp: rospy.Time) -> list[Imu]:
        state = self._robot.state()
        return [messages.imu(state.yaw, state.w, stamp, self._prefix)]

    def _raw_imu(self, stamp: rospy.Time) -> list[Imu]:
        earlier = rospy.Time(0, max(0, stamp.to_nsec() - self._reading_ns))
        gyro = RawGyro.of(0, [(0.0, 0.0, rate) for rate in self._raw_rates()])
        return messages.raw_imu(gyro, (earlier, stamp), self._prefix)

    def _raw_rates(self) -> tuple[float, float]:
        """Return the rate [rad/s] at the middle of the period, estimated, and at its end."""
        rate = self._robot.state().w
        return 0.5 * (self._rate_before + rate), rate

    def _dock_ir(self, stamp: rospy.Time) -> list[msg.DockInfraRed]:
        return [messages.dock_infrared(Feedback(), stamp, self._prefix)]

    def _stream(self, stamp: rospy.Time) -> list[String]:
        left, right = self._robot.turned
        heading = wrap_angle((right - left) * self._rad_per_turned)
        rate = self._robot.state().w
        feedback = with_gyro(self._feedback(stamp), heading, rate, self._raw_rates())
        return [messages.stream_text(robot_packets.build(*feedback.parts()))]

    def _control(self, _stamp: rospy.Time) -> list[Int16MultiArray]:
        return [Int16MultiArray(data=control_values(*self._robot.target))]

    def _raw_commands(self, _stamp: rospy.Time) -> list[String]:
        sent = [*self._sent, commands.build(base_control(*self._robot.target))]
        return [messages.command_text(packet) for packet in sent]

    def _on_command(self, message: Any, to: tuple[command_messages.CommandEncoder, str]) -> None:
        encoder, topic = to
        try:
            with self._motion.hold():
                self._sent.append(commands.build(encoder.command(topic, message)))
        except ValueError as error:
            self._log.error(f"{self._prefix}mobile_base/commands: {error}; ignored")

    def _on_motor_power(self, message: msg.MotorPower) -> None:
        if message.state not in (msg.MotorPower.ON, msg.MotorPower.OFF):
            line = f"motor_power: {message.state} is neither 0 (off) nor 1 (on)"
            self._log.error(
                f"{self._prefix}mobile_base/commands/{line}; the motors stay as they are"
            )
            return
        with self._motion.hold() as now:
            self._robot.switch_motors(message.state == msg.MotorPower.ON, now.motion_ns)

    def _on_press(self, event: msg.ButtonEvent) -> None:
        if event.button < len(self._pressed):
            self._pressed[event.button] = event.state == msg.ButtonEvent.PRESSED
            self._button.publish(event)
