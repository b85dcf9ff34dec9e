"""The ROS node: joy (sensor_msgs/Joy) in, cmd_vel (geometry_msgs/Twist) out."""

from __future__ import annotations

import gc
import struct
import threading
from time import monotonic, time_ns
from typing import Any

import diagnostic_updater
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from sensor_msgs.msg import Joy

from joy_to_twist.parameters import Parameters, load
from joy_to_twist.ros.console import Console
from joy_to_twist.states import State
from joy_to_twist.teleoperation import Teleoperation
from node_kit.io.suspension import Suspensions
from node_kit.ros.lifecycle.start import run
from node_kit.ros.rospy_patches.connections import header_of, report_bad_messages
from node_kit.ros.rospy_patches.prompt_publisher import VelocityPublisher
from node_kit.rules.arming import SILENCE_S, ZERO, Velocity
from node_kit.rules.throttle import Throttle

NODE_NAME = "NewJoy2Twist"
LOOK_ROUND_S = 0.25  # period at which to check whether the joystick node has exited
DELIVERY_TIME_S = 0.1  # for the last zero, which an immediate exit may lose
BURST = 100  # most Joy messages in the queue: a whole burst, but no long backlog
READ_BYTES = 4096  # a few tens of messages; Python allocates this for every message


# Layout of a serialised Joy, little-endian: seq, secs, nsecs (uint32 each), the length of frame_id
# and its bytes, the number of axes and as many float32, the number of buttons and as many int32.
_STAMP = struct.Struct("<4xII")
_COUNT = struct.Struct("<I")
_FRAME_LENGTH_AT = 12


class LeanJoy(Joy):
    """A Joy to subscribe with, which reads only axes, buttons and stamp_ns.

    rospy lets the message class read its bytes. After a pause, when the CPU's caches are cold, the
    general code (a Header, a Time, a decoded frame_id) takes most of the time between a message and
    its velocity.
    """

    __slots__ = ("data",)

    def __init__(self) -> None:
        """Do nothing: deserialize() is the only source of these messages."""

    def deserialize(self, data: bytes) -> LeanJoy:
        """Read axes (floats) and buttons (ints). Raises struct.error if the bytes are cut."""
        self.data = data
        at = _FRAME_LENGTH_AT
        at += 4 + _COUNT.unpack_from(data, at)[0]
        axes = _COUNT.unpack_from(data, at)[0]
        self.axes = struct.unpack_from(f"<{axes}f", data, at + 4)  # type: ignore[misc]
        at += 4 + 4 * axes
        buttons = _COUNT.unpack_from(data, at)[0]
        self.buttons = struct.unpack_from(f"<{buttons}i", data, at + 4)  # type: ignore[misc]
        return self

    @property
    def stamp_ns(self) -> int:
        """The stamp [ns], by the clock of the joystick node."""
        secs, nsecs = _STAMP.unpack_from(self.data)
        return secs * 1_000_000_000 + nsecs


class Joy2Twist:
    """Turns every joystick message into a velocity, and stops the robot at the end.

    Subscribes: joy (sensor_msgs/Joy).
    Publishes: cmd_vel (geometry_msgs/Twist), never latched, in the frame of the base (REP-103);
    /diagnostics (diagnostic_msgs/DiagnosticArray).
    Private parameters with their defaults: see parameters.py, or the table in README.md.
    """

    def __init__(self, parameters: Parameters) -> None:
        """Register the topics. The node is initialised, and not anonymous: only one may drive."""
        self.console = Console(parameters.log_rate)
        report_bad_messages(self.console.warn)
        self.timer = threading.Event()  # set to call look() at once
        self.teleoperation = Teleoperation(parameters, self.console.warn, self.timer.set)
        for line in self.teleoperation.describe():
            self.console.info(line)
        self.uses_age = parameters.max_joy_age > 0
        # ROS time [ns]; the fast function if it is wall time, as it is called for every message.
        self.read_clock_ns = time_ns if rospy.rostime.is_wallclock() else simulated_time_ns
        self.suspensions = Suspensions()
        self.lock = threading.Lock()  # one velocity at a time, and none after the last zero
        self.stopped = threading.Event()

        self.hold_new = parameters.arm_on_neutral
        repeats = 0 < parameters.joy_timeout <= SILENCE_S
        hold_to_run = self.hold_new and repeats
        self.cmd_vel = VelocityPublisher("cmd_vel", self.console.warn, hold_to_run)
        rospy.on_shutdown(self.shutdown)
        self.diagnostics = diagnostic_updater.Updater()
        self.diagnostics.setHardwareID("none")
        self.diagnostics.add("joystick", self.diagnose)
        self.may_diagnose = Throttle(1.0 / parameters.diagnostic_period)
        self.may_diagnose_new = Throttle(1.0 / LOOK_ROUND_S)
        self.diagnosed: State | None = None  # the state on /diagnostics
        self.joy = rospy.Subscriber(
            "joy", LeanJoy, self.callback, queue_size=BURST, buff_size=READ_BYTES, tcp_nodelay=True
        )
        threading.Thread(target=self.watch, daemon=True).start()

    def callback(self, joy: LeanJoy) -> None:
        """Publish the velocity first, because displaying takes longer; then display the axes."""
        now = monotonic()
        age_ns = self.read_clock_ns() - joy.stamp_ns if self.uses_age else 0
        with self.lock:
            self.notice_suspension(now)
            sender = header_of(joy)
            self.publish(self.teleoperation.joy(joy.axes, joy.buttons, now, age_ns, sender))
        self.console.display(joy.axes, now)

    def notice_suspension(self, now: float) -> None:
        """Stop if this process was suspended: the messages in its sockets are old."""
        stop = self.teleoperation.suspended(self.suspensions.number(), now)
        if stop is not None:
            self.publish(stop)

    def publish(self, velocity: Velocity | None) -> None:
        """Publish a velocity, or nothing for None, until the node is stopped."""
        if not self.stopped.is_set():
            self.cmd_vel.publish(velocity, self.teleoperation.released, self.hold_new)

    def watch(self) -> None:
        """Stop the robot when the joystick is silent or exits, and repeat zeros.

        This thread and its clock are separate from rospy's, whose timers follow simulated time,
        which may pause or jump. If this thread fails, the node shuts down.
        """
        try:
            while not self.stopped.is_set():
                self.timer.wait(self.look())
        finally:
            rospy.signal_shutdown("the joystick watchdog has ended")

    def look(self) -> float:
        """Check the time and the joystick once; return the time until the next check [s]."""
        with self.lock:
            now = monotonic()
            self.notice_suspension(now)
            if self.joy.get_num_connections() == 0:
                self.publish(self.teleoperation.left(now))
            self.publish(self.teleoperation.tick(now))
            self.teleoperation.listeners(self.cmd_vel.listeners, self.cmd_vel.name, now)
            self.timer.clear()
            due = min(self.teleoperation.due, now + LOOK_ROUND_S)
            is_new = self.teleoperation.state is not self.diagnosed
        wanted = self.may_diagnose.ready(now) or (is_new and self.may_diagnose_new.ready(now))
        if wanted and self.diagnostics.publisher.get_num_connections():
            self.diagnostics.force_update()
        return max(0.0, due - monotonic())

    def diagnose(self, status: Any) -> Any:
        """Fill in the diagnostic status, a DiagnosticStatusWrapper."""
        with self.lock:
            well, state, details = self.teleoperation.summary(monotonic())
            self.diagnosed = self.teleoperation.state
        status.summary(DiagnosticStatus.OK if well else DiagnosticStatus.WARN, state)
        for name, value in details.items():
            status.add(name, value)
        return status

    def shutdown(self) -> None:
        """Stop the robot: send a zero velocity, and wait for its delivery."""
        with self.lock:
            self.stopped.set()
            self.cmd_vel.publish(ZERO)
        self.console.goodbye("Stopping the node ...")
        # Not rospy.sleep(), which never returns in simulated time without a clock.
        threading.Event().wait(DELIVERY_TIME_S)


def simulated_time_ns() -> int:
    """Return the time of /clock [ns]."""
    return int(rospy.Time.now().to_nsec())


def spin(parameters: Parameters) -> None:
    """Run the node until it is shut down."""
    Joy2Twist(parameters)
    gc.freeze()  # the present objects stay: the garbage collector can skip them
    rospy.spin()


def main() -> int:
    """Run the node until it is stopped; return its exit code."""
    return run(NODE_NAME, load, spin)
