"""The link to the robot: turns packets into messages, and sends commands."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any, Callable

import rospy
from kobuki_msgs.msg import RobotStateEvent

from kobuki_driver.errors import PortError
from kobuki_driver.io.ports import ports
from kobuki_driver.io.serial_port import SerialPort
from kobuki_driver.link import port_advice
from kobuki_driver.link.link_monitor import LinkEvent, LinkMonitor
from kobuki_driver.parameters import KobukiParameters
from kobuki_driver.robot.identification import Identification
from kobuki_driver.robot.velocity_control import ZERO, VelocityControl, VelocityResult
from kobuki_driver.ros.base_topics import BaseTopics
from kobuki_protocol import commands, messages, robot_packets
from kobuki_protocol.base_control import Velocity, base_control
from kobuki_protocol.events import events
from kobuki_protocol.feedback import Core, Feedback
from kobuki_protocol.framing import Framer
from kobuki_protocol.identity import Controller, FirmwareVersion
from kobuki_protocol.odometry import Odometry

SOFTWARE = "1.0.0"  # version of this driver, in version_info
MOST_WAITING = 100  # commands, while the port is closed
LAST_ZEROS = 3  # at the end, as a packet may be damaged


class KobukiLink:
    """Serves the robot. The main thread reads and writes; callbacks only set what to write."""

    def __init__(
        self, parameters: KobukiParameters, topics: BaseTopics, report: Callable[..., None]
    ) -> None:
        """Start without a port; report(line, is_bad) logs a line."""
        self._parameters, self._topics, self._report = parameters, topics, report
        self._lock = threading.Lock()
        self.control = VelocityControl(parameters.cmd_vel_timeout, parameters.acceleration_limiter)
        self.feedback = Feedback()
        self._odometry = Odometry(parameters.use_imu_heading)
        self._identification = Identification()
        self._waiting: deque[commands.Command] = deque(maxlen=MOST_WAITING)
        self._port: SerialPort | None = None
        self._topics.latch("events/robot_state", RobotStateEvent(RobotStateEvent.OFFLINE))

    @property
    def is_online(self) -> bool:
        """Return whether packets come from the robot."""
        return self.control.is_online

    def open(self, port: SerialPort, now_s: float) -> None:
        """Use a port that was just opened."""
        self._port, self._framer, self._monitor = port, Framer(), LinkMonitor(now_s)

    def close(self) -> None:
        """Record that the port was closed."""
        self._port = None
        self._switch(is_online=False)

    def take(self, data: bytes, now_s: float, stamp: rospy.Time) -> bool:
        """Process the bytes of a read, if any; return whether to command the robot."""
        payloads = self._framer.feed(data)
        packets = [(payload, robot_packets.parse(payload)) for payload in payloads]
        cores = sum(any(isinstance(part, Core) for part in parts) for _, parts in packets)
        damaged = self._framer.damaged
        for event in self._monitor.take(len(data), cores, damaged, now_s):
            self._on_link_event(event, now_s)
        for payload, parts in packets:
            self._take_packet(parts, now_s, stamp)
            self._topics.stream(payload)
        if cores:
            self._topics.odometry(self._odometry.state, self._stamp(stamp))
        return cores > 0 or (self._monitor.was_online and not (data or self._monitor.is_online))

    def _stamp(self, now: rospy.Time) -> rospy.Time:
        """Return the time at which the robot made the packet, without its delay in the port."""
        late_ns = round(1e9 * self._odometry.late_s)
        return rospy.Time(0, max(0, now.to_nsec() - late_ns))

    def _take_packet(self, parts: list[Any], now_s: float, stamp: rospy.Time) -> None:
        before, self.feedback = self.feedback, self.feedback.updated(parts)
        now = self.feedback
        self._topics.events(events(before, now, self._parameters.battery))
        if any(isinstance(part, Core) for part in parts):
            with self._lock:
                self._odometry.update(now.core, now.inertia, now_s)
            self._topics.sensors(now, self._odometry.gyro_heading, self._stamp(stamp))
        for answer in self._identification.take(parts):
            self._introduce(answer)

    def _introduce(self, answer: object) -> None:
        known = self._identification
        if isinstance(answer, Controller):
            self._topics.latch("controller_info", messages.controller_info(answer))
        elif known.hardware and known.firmware and known.unique_id:
            about = known.hardware, known.firmware, known.unique_id
            self._topics.latch("version_info", messages.version_info(*about, software=SOFTWARE))
        if isinstance(answer, FirmwareVersion) and known.objection():
            self._report(known.objection(), is_bad=True)

    def command_robot(self, now_s: float) -> None:
        """Send a base control, waiting commands and requests."""
        with self._lock:
            if self.control.expires(now_s):
                timeout_s = self._parameters.cmd_vel_timeout
                self._report(
                    f"no velocity came for {timeout_s:.2f} s: the robot stops until the next one",
                    is_bad=True,
                )
            velocity = self.control.velocity(now_s)
            if not self._identification.may_drive(now_s):
                velocity = ZERO
            waiting = list(self._waiting)
            self._waiting.clear()
        self._write(base_control(*velocity))
        self._topics.control(velocity)
        for command in (*waiting, *self._identification.requests(now_s)):
            self._write(command)

    def _write(self, command: commands.Command) -> None:
        if self._port:
            data = commands.build(command)
            self._port.write(data)
            self._topics.sent(data)

    def rest(self) -> None:
        """Stop the robot when the driver exits."""
        self.stop()
        try:
            for _ in range(LAST_ZEROS if self._monitor.was_online else 0):
                self._write(base_control(*ZERO))
        except PortError:
            pass  # the port has failed already

    def _on_link_event(self, event: LinkEvent, now_s: float) -> None:
        path, monitor = self._parameters.device_port, self._monitor
        if event is LinkEvent.ONLINE:
            self._identification.begin(now_s)
            self._switch(is_online=True)
            self._report(port_advice.online(path))
        elif event is LinkEvent.LOST:
            self._framer.reset()
            self._switch(is_online=False)
            self._report(port_advice.lost(path), is_bad=True)
        elif event is LinkEvent.SILENT:
            self._report(port_advice.silent(path), is_bad=True)
        elif event is LinkEvent.FOREIGN:
            self._report(port_advice.foreign(path, monitor.count, ports()), is_bad=True)
        else:
            self._report(port_advice.damaged(path, monitor.damaged), is_bad=True)

    def _switch(self, is_online: bool) -> None:
        if is_online == self.is_online:
            return
        with self._lock:
            self.control.switch_robot(is_online)
            if not is_online:
                self._odometry.rest()
        state = RobotStateEvent.ONLINE if is_online else RobotStateEvent.OFFLINE
        self._topics.latch("events/robot_state", RobotStateEvent(state))

    def command(self, velocity: Velocity, now_s: float) -> VelocityResult:
        """Set a velocity; for callbacks, like the methods below."""
        with self._lock:
            return self.control.command(velocity, now_s)

    def stop(self) -> None:
        """Stop until the next velocity."""
        with self._lock:
            self.control.stop()

    def switch_motors(self, is_on: bool) -> None:
        """Switch the motors on or off; while they are off, velocities are ignored."""
        with self._lock:
            self.control.switch_motors(is_on)

    def reset_odometry(self) -> None:
        """Return the odometry to the origin."""
        with self._lock:
            self._odometry.reset()

    def send(self, command: commands.Command) -> None:
        """Send a command with the next base control."""
        with self._lock:
            self._waiting.append(command)
