"""The ROS node: joy (sensor_msgs/Joy) in, cmd_vel (geometry_msgs/Twist) out."""

import gc
import threading
from time import monotonic, time_ns

import diagnostic_updater
import rospy
from diagnostic_msgs.msg import DiagnosticStatus

from joy_to_twist.console import Console
from joy_to_twist.lean_joy import LeanJoy
from joy_to_twist.limits import ZERO
from joy_to_twist.parameters import load
from joy_to_twist.teleoperation import Teleoperation
from node_kit.careful_connections import connection_of, tell_of_bad_messages
from node_kit.prompt_publisher import VelocityPublisher
from node_kit.start import run
from node_kit.suspension import Suspensions
from node_kit.throttle import Throttle

NODE_NAME = "NewJoy2Twist"
LOOK_ROUND_S = 0.25  # how soon it is noticed that the joystick node has left
DELIVERY_TIME_S = 0.1  # for the last zero, which an exit at once may lose
BURST = 100  # Joy messages read at once, at most: all of a burst, but never a long backlog
READ_BYTES = 4096  # room for some tens of them, which Python makes anew for every message


class Joy2Twist:
    """Turns every joystick message into a velocity, and leaves the robot standing.

    Subscribes: joy (sensor_msgs/Joy).
    Publishes: cmd_vel (geometry_msgs/Twist), never latched, in the frame of the base (REP-103);
    /diagnostics (diagnostic_msgs/DiagnosticArray).
    Private parameters with their defaults (README.md says what each is for):
        axis_linear: 1, axis_angular: 0, scale_linear: 1.0, scale_linear_turbo: 1.0,
        scale_angular: 1.0, scale_angular_turbo: scale_angular,
        enable_button: -1, enable_turbo_button: -1, require_enable_button: with enable_button,
        inverted_reverse: false, axis_curve: 1.0, stop_button: -1, stop_reset_button: -1,
        joy_timeout: 0.5 s, max_joy_age: 0.0 s, arm_on_neutral: false, vigilance_timeout: 0.0 s,
        stop_messages: 5, output_rate: 20.0 Hz,
        max_linear_speed: 0.0 m/s, max_angular_speed: 0.0 rad/s,
        max_linear_acceleration: 0.0 m/s2, max_angular_acceleration: 0.0 rad/s2,
        gamepad_axes: -1, log_rate: 50.0 Hz, diagnostic_period: 1.0 s.
    """

    def __init__(self, parameters):
        """Take parameters.Parameters. The node is initialised, not anonymous: only one drives."""
        self.console = Console(parameters.log_rate)
        tell_of_bad_messages(self.console.warn)
        self.timer = threading.Event()  # set to have the time looked at now
        self.teleoperation = Teleoperation(parameters, self.console.warn, self.timer.set)
        self.safety = self.teleoperation.safety
        for line in self.teleoperation.mapping.describe():
            self.console.info(line)
        self.uses_age = parameters.max_joy_age > 0
        # ROS time [ns]; without simulated time read the short way, as it is for every message.
        self.read_clock_ns = time_ns if rospy.rostime.is_wallclock() else simulated_time_ns
        self.suspensions = Suspensions()
        self.lock = threading.Lock()  # one velocity at a time, and none after the last zero
        self.stopped = threading.Event()

        self.cmd_vel = VelocityPublisher("cmd_vel", self.console.warn)
        self.hold_new = parameters.arm_on_neutral
        rospy.on_shutdown(self.shutdown)
        self.diagnostics = diagnostic_updater.Updater()
        self.diagnostics.setHardwareID("none")
        self.diagnostics.add("joystick", self.diagnose)
        self.may_diagnose = Throttle(1.0 / parameters.diagnostic_period)
        self.may_diagnose_new = Throttle(1.0 / LOOK_ROUND_S)
        self.diagnosed = None  # the state on /diagnostics
        self.joy = rospy.Subscriber(
            "joy", LeanJoy, self.callback, queue_size=BURST, buff_size=READ_BYTES, tcp_nodelay=True
        )
        threading.Thread(target=self.watch, daemon=True).start()

    def callback(self, joy):
        """Publish the velocity first, because displaying takes longer; then display the axes."""
        now = monotonic()
        age_ns = self.read_clock_ns() - joy.stamp_ns if self.uses_age else 0
        with self.lock:
            self.notice_suspension(now)
            sender = connection_of(joy)
            self.publish(self.teleoperation.joy(joy.axes, joy.buttons, now, age_ns, sender))
        self.console.display(joy.axes, now)

    def notice_suspension(self, now):
        """Stop if this process was suspended: what is in its sockets is old."""
        stop = self.teleoperation.suspended(self.suspensions.number(), now)
        if stop is not None:
            self.publish(stop)

    def publish(self, velocity):
        """Publish a velocity, or None, until the node is stopped."""
        if not self.stopped.is_set():
            self.cmd_vel.publish(velocity, self.safety.released, self.hold_new)

    def watch(self):
        """Stop the robot when the joystick falls silent or leaves, and repeat what is to repeat.

        A thread of its own with a clock of its own: rospy's timers follow the simulated time, which
        may stand still or jump. Nobody drives unwatched: should it fail, the node ends.
        """
        try:
            while not self.stopped.is_set():
                self.timer.wait(self.look())
        finally:
            rospy.signal_shutdown("the watch over the joystick has ended")

    def look(self):
        """Look at the time and the joystick once; for how long [s] nothing will be due."""
        with self.lock:
            now = monotonic()
            self.notice_suspension(now)
            if self.joy.get_num_connections() == 0:
                self.publish(self.teleoperation.left(now))
            self.publish(self.safety.tick(now))
            self.teleoperation.listeners(self.cmd_vel.listeners, self.cmd_vel.name, now)
            self.timer.clear()
            due = min(self.safety.due, now + LOOK_ROUND_S)
            is_new = self.safety.state != self.diagnosed
        wanted = self.may_diagnose.ready(now) or (is_new and self.may_diagnose_new.ready(now))
        if wanted and self.diagnostics.publisher.get_num_connections():
            self.diagnostics.force_update()
        return max(0.0, due - monotonic())

    def diagnose(self, status):
        """Fill in the diagnostic status, a DiagnosticStatusWrapper."""
        with self.lock:
            well, state, details = self.teleoperation.summary(monotonic())
        self.diagnosed = state
        status.summary(DiagnosticStatus.OK if well else DiagnosticStatus.WARN, state)
        for name, value in details.items():
            status.add(name, value)
        return status

    def shutdown(self):
        """Leave the robot standing: zero velocity, and the time to deliver it."""
        with self.lock:
            self.stopped.set()
            self.cmd_vel.publish(ZERO)
        self.console.goodbye("Stopping the node ...")
        # Not rospy.sleep: in simulated time without a clock it never returns.
        threading.Event().wait(DELIVERY_TIME_S)


def simulated_time_ns():
    """What /clock says [ns]."""
    return rospy.Time.now().to_nsec()


def spin(parameters):
    """Be the node until it is shut down."""
    Joy2Twist(parameters)
    gc.freeze()  # what is there now stays: the garbage collector need not look at it again
    rospy.spin()


def main():
    """Run the node until it is stopped; return its exit code."""
    return run(NODE_NAME, load, spin)
