"""The topics of a Kobuki beside velocity and odometry: kobuki_node's, in its namespace."""

from __future__ import annotations

from math import cos, sin
from sys import float_info
from typing import Any, Callable

import rospy
from geometry_msgs.msg import Quaternion, Vector3
from kobuki_msgs import msg
from sensor_msgs.msg import Imu
from std_msgs.msg import Header, Int16MultiArray, String

from fake_turtlebot_sim.kobuki_protocol import commands
from fake_turtlebot_sim.simulator.differential_drive import wrap_angle
from fake_turtlebot_sim.simulator.kobuki import EVENTS, QUEUE, core, stream
from fake_turtlebot_sim.simulator.parameters import Parameters
from fake_turtlebot_sim.simulator.ros_clock import Motion
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from node_kit.log import Log
from node_kit.rospy_patches.prompt_publisher import PromptPublisher

# Published once: what a Kobuki answers when its driver asks.
LATCHED = {
    "version_info": msg.VersionInfo("1.0.4", "1.2.0", "simulated", [0, 0, 0], 3),  # both features
    "controller_info": msg.ControllerInfo(msg.ControllerInfo.DEFAULT, 100.0, 0.1, 2.0),
    "events/robot_state": msg.RobotStateEvent(msg.RobotStateEvent.ONLINE),
}
# Of heading and turning [rad2, rad2/s2]: about x and y nothing is known (kobuki_node).
COVARIANCE = (float_info.max, 0.0, 0.0, 0.0, float_info.max, 0.0, 0.0, 0.0, 0.05)
NEVER_SENT = {"power_system": msg.PowerSystemEvent, "digital_input": msg.DigitalInputEvent}
GYRO_READINGS = 2  # in a packet


class KobukiTopics:
    """Sensors, events and commands of a Kobuki, and a topic that presses its buttons."""

    def __init__(
        self, prefix: str, robot: SimulatedRobot, parameters: Parameters, motion: Motion, log: Log
    ) -> None:
        """Take the prefix of all names; in a world WorldTopics has the events of bumpers."""
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
        """Take the commands that change nothing here; the cockpit shows LEDs and sounds."""
        outputs = commands.Outputs()
        encoded: dict[str, tuple[type, Callable[[Any], bytes]]] = {
            "led1": (msg.Led, lambda led: outputs.led(1, led.value)),
            "led2": (msg.Led, lambda led: outputs.led(2, led.value)),
            "sound": (msg.Sound, lambda sound: commands.sound(sound.value)),
            "digital_output": (msg.DigitalOutput, lambda o: outputs.digital(o.values, o.mask)),
            "external_power": (msg.ExternalPower, lambda o: outputs.power(o.source, o.state)),
            "controller_info": (
                msg.ControllerInfo,
                lambda i: commands.controller(i.type, (i.p_gain, i.i_gain, i.d_gain)),
            ),
        }
        for name, (kind, encode) in encoded.items():
            rospy.Subscriber(base + name, kind, self._on_command, callback_args=encode)

    def messages(self, stamp: rospy.Time) -> list[tuple[PromptPublisher, Any]]:
        """Return what subscribers are to get; call once a period, while the motion is held."""
        sensors = [(topic, make) for topic, make in self._sensors if topic.listeners]
        made = [(topic, message) for topic, make in sensors for message in make(stamp)]
        if made:
            self._rate_before = self._robot.state().w
        self._sent.clear()
        return made

    def _core(self, stamp: rospy.Time) -> list[msg.SensorState]:
        packet = core(stamp.to_nsec(), self._robot, self._pressed)
        packet.header.stamp = stamp
        return [packet]

    def _imu(self, stamp: rospy.Time) -> list[Imu]:
        state = self._robot.state()
        imu, half = self._turning(stamp, state.w), 0.5 * state.yaw
        imu.orientation = Quaternion(0.0, 0.0, sin(half), cos(half))
        imu.orientation_covariance = imu.angular_velocity_covariance = COVARIANCE
        return [imu]

    def _raw_imu(self, stamp: rospy.Time) -> list[Imu]:
        earlier = rospy.Time(0, max(0, stamp.to_nsec() - self._reading_ns))
        return [self._turning(*reading) for reading in zip((earlier, stamp), self._raw_rates())]

    def _turning(self, stamp: rospy.Time, rate: float) -> Imu:
        header = Header(0, stamp, f"{self._prefix}gyro_link")
        return Imu(header=header, angular_velocity=Vector3(0.0, 0.0, rate))

    def _raw_rates(self) -> tuple[float, float]:
        """Return the rate [rad/s] in the middle of the period, about, and at its end."""
        rate = self._robot.state().w
        return 0.5 * (self._rate_before + rate), rate

    def _dock_ir(self, stamp: rospy.Time) -> list[msg.DockInfraRed]:
        return [msg.DockInfraRed(Header(0, stamp, f"{self._prefix}dock_ir_link"), bytes(3))]

    def _stream(self, stamp: rospy.Time) -> list[String]:
        left, right = self._robot.turned
        heading = wrap_angle((right - left) * self._rad_per_turned)
        (state,), rate = self._core(stamp), self._robot.state().w
        data = stream(state, heading, rate, self._raw_rates())
        return [String(f"{{ {data.hex(' ').upper()} }}")]

    def _control(self, _stamp: rospy.Time) -> list[Int16MultiArray]:
        return [Int16MultiArray(data=commands.control_values(*self._robot.target))]

    def _raw_commands(self, _stamp: rospy.Time) -> list[String]:
        sent = [*self._sent, commands.base_control(*self._robot.target)]
        return [String(f"[ {' '.join(f'0x{byte:02x}' for byte in packet)} ]") for packet in sent]

    def _on_command(self, message: Any, encode: Callable[[Any], bytes]) -> None:
        try:
            with self._motion.hold():
                self._sent.append(encode(message))
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
