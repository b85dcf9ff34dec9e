"""The ROS node joy_node: a gamepad in, joy (sensor_msgs/Joy) out."""

from __future__ import annotations

import select
import threading
from time import monotonic
from typing import Any, Iterable

import diagnostic_updater
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from sensor_msgs.msg import Joy

from gamepad.driver.driver import Driver
from gamepad.driver.parameters import DriverParameters, load
from gamepad.driver.report import DriverReport
from gamepad.driver.state import Message
from gamepad.errors import DeviceError
from gamepad.gamepads import mode_hint
from gamepad.io.device import Finder, JoystickDevice
from node_kit.io.suspension import Suspensions
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log

NODE_NAME = "joy_node"
QUEUE_SIZE = 100  # both a press and its release must arrive
# How long the end may wait for the last message, and then for its delivery [s].
LONGEST_END_S, DELIVERY_TIME_S = 0.3, 0.1
LOOK_S = 0.1  # period at which to look for a missing gamepad and for a shutdown


class JoyNode:
    """Publishes the state of one gamepad, in place of ROS Noetic's joy_node of the package joy.

    Publishes: joy (sensor_msgs/Joy; frame_id is the path of the device),
        /diagnostics (diagnostic_msgs/DiagnosticArray).
    Private parameters with their defaults: DriverParameters, as a table in README.md.
    """

    def __init__(self, parameters: DriverParameters) -> None:
        """Register topics; the node is initialised."""
        self.log = Log()
        self.suspensions = Suspensions()
        self.suspended = 0  # number of suspensions that were handled
        self.is_ending = threading.Event()
        self.has_ended = threading.Event()  # the last message was published
        rospy.on_shutdown(self.end)
        self.driver = Driver(parameters)
        self.finder = Finder(parameters.dev, parameters.dev_name)
        self.joy = rospy.Publisher("joy", Joy, queue_size=QUEUE_SIZE, tcp_nodelay=True)
        self.message = Joy()
        self.report = DriverReport(parameters, self.joy.resolved_name)
        self.diagnostics = diagnostic_updater.Updater()
        self.diagnostics.setHardwareID("none")
        self.diagnostics.add("Joystick Driver Status", self.diagnose)

    def run(self) -> None:
        """Open the gamepad and publish its state, again after each loss, until shut down."""
        try:
            while not self.is_ending.is_set():
                device = self.wait_for_gamepad()
                if device:
                    try:
                        self.follow(device)
                    finally:
                        device.close()
        finally:
            self.has_ended.set()

    def end(self) -> None:
        """Publish released sticks, and then nothing more."""
        self.is_ending.set()
        if self.has_ended.wait(LONGEST_END_S):
            threading.Event().wait(DELIVERY_TIME_S)

    def wait_for_gamepad(self) -> JoystickDevice | None:
        """Return an open JoystickDevice, or None if the node is shut down."""
        reported = ""
        while not self.is_ending.is_set():
            if monotonic() >= self.driver.opens_at:
                try:
                    return self.finder.open()
                except DeviceError as error:
                    if str(error) != reported:
                        reported = str(error)
                        self.log.warn(reported)
            self.report_if_due()
            self.is_ending.wait(LOOK_S)
        return None

    def follow(self, device: JoystickDevice) -> None:
        """Publish the state of an open gamepad until it is lost or the node is shut down."""
        self.message.header.frame_id = device.path
        self.driver.opened(device.triggers, device.kernel_device)
        self.report.opened(device.path, device.name)
        try:
            # Before a line is logged: joydev reports movements until the first read as part of the
            # state at opening, which does not count as touched.
            self.take_in(device, until=monotonic())
            self.log.info(f"Opened joystick {device.path} {device.name}")
            hint = mode_hint(device.usb_id)
            if hint:
                self.log.info(hint)
            while not self.is_ending.is_set():
                self.take_in(device, min(self.driver.due, self.report.next))
                self.report_if_due()
            self.publish(self.driver.lost(monotonic()))
        except DeviceError as error:
            self.publish(self.driver.lost(monotonic()))
            self.report.lost()
            self.log.warn(f"{error} The sticks were released. Looking for it.")
        if self.driver.unknown_events:
            self.log.warn(f"{self.driver.unknown_events} events of unknown types were ignored.")

    def take_in(self, device: JoystickDevice, until: float) -> None:
        """Wait for events until a time [s], at most LOOK_S, and publish. Raises DeviceError."""
        # Not poll(), whose timeout is in whole milliseconds.
        timeout = max(0.0, min(until - monotonic(), LOOK_S))
        readable, _, _ = select.select([device], (), (), timeout)
        if self.suspensions.number() != self.suspended:
            self.suspended = self.suspensions.number()
            raise DeviceError("This node was suspended: the sticks may have moved.")
        if readable:
            self.publish(self.driver.read(device.read(), monotonic()))
        if self.driver.is_lifeless(monotonic()):
            raise DeviceError(f"Lost the joystick {device.path}: it sends no sign of life.")
        self.publish(self.driver.tick(monotonic()))

    def publish(self, messages: Iterable[Message]) -> None:
        """Publish pairs of axes and buttons."""
        for axes, buttons in messages:
            self.message.header.stamp = rospy.Time.now()
            self.message.axes = axes
            self.message.buttons = buttons
            self.joy.publish(self.message)
            self.report.published += 1

    def report_if_due(self) -> None:
        """Publish the diagnostics once a period."""
        if self.report.due(monotonic()):
            self.diagnostics.force_update()

    def diagnose(self, status: Any) -> Any:
        """Fill in the diagnostic status, a DiagnosticStatusWrapper."""
        well, summary = self.report.summary()
        status.summary(DiagnosticStatus.OK if well else DiagnosticStatus.ERROR, summary)
        subscribers = self.joy.get_num_connections()
        for name, value in self.report.details(self.driver, subscribers, monotonic()):
            status.add(name, value)
        return status


def main() -> int:
    """Run the node until it is stopped; return its exit code."""
    return run(NODE_NAME, load, lambda parameters: JoyNode(parameters).run())
