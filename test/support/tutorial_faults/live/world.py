"""The live system: gamepad, driver, joy2twist, mux and simulator, started once and repaired."""

import contextlib
import os
import time

import rospy
from geometry_msgs.msg import Twist

from node_kit.ros.graph.ros_api import call
from node_kit.ros.rospy_patches.connections import sender_of
from tutorial_faults.live import judge
from tutorial_faults.live.table import BASE, FAULTS, TELEOP, VIGILANCE_S
from tutorial_testing import rig
from tutorial_testing.hands import DRIVE, RELEASED
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program, signal_all
from tutorial_testing.serial_rig import SerialRig
from tutorial_testing.waiting import BUSY_S, wait_for

ENDS_S = 1.5 + BUSY_S  # for a node to exit, when asked to
MOVES_S = 4.0  # to release all and drive again, at least
DRIVES_S = 90.0  # after which a system that does not drive has failed
REPORTS_S = 0.5  # for which a base that was restarted is watched, at least


class World(rig.Rig):
    """All processes of the system, and a viewer. A context manager that ends them all.

    This process also acts as the other programs, which send nonsense.
    """

    sees_truth = False  # whether wheels are seen even while their base is down

    def __init__(self, command):
        """command: in place of joy2twist, if any."""
        super().__init__(vigilance_timeout=VIGILANCE_S)
        self._command, self.is_deaf = command, False
        self._stream, self._hits, self.seed = [], {}, 0

    def begin(self):
        uri = os.environ["ROS_MASTER_URI"]
        self.programs["master"] = Program("rosmaster", "--core", "-p", uri.rsplit(":", 1)[1])
        self._stack.callback(self._end_nodes)
        wait_for(lambda: call(uri, "getPid")[1], "master")
        # Otherwise every log line of a node asks the master first.
        call(uri, "setParam", "/rosout_disable_topics_generation", False)
        init_node("hunt", disable_signals=True, disable_rosout=True)
        super().begin()
        topics = ("/odom", "/joy", "/cmd_vel", f"/{TELEOP}")
        self.programs["viewer"] = Program("rostopic", "hz", *topics)
        velocities = rospy.Subscriber("cmd_vel", Twist, self._hear, queue_size=1000)
        self._stack.callback(velocities.unregister)
        wait_for(lambda: self.odometry, "odometry", DRIVES_S)

    def _hear(self, twist):
        if sender_of(twist) != rospy.get_name():
            self._see(judge.COMMAND, judge.velocity(twist.linear.x, twist.angular.z))

    def _see(self, what, value, at_s=None):
        self._stream.append(judge.Event(at_s or time.time(), what, value))

    def given(self, node):
        program, parameters, remaps = super().given(node)
        if node == rig.DRIVER and self._command:
            return self._command, parameters, {**remaps, "/cmd_vel": f"/{TELEOP}"}
        return program, parameters, remaps

    def signal(self, part, number):
        part = self.base if part == BASE else part
        if not self.programs[part].ended:
            signal_all([self.programs[part].pid], number)

    def restart(self, node):
        """Wait until a node has exited as asked, or report that it has not; start it again."""
        node = self.base if node == BASE else node
        program, now = self.programs[node], time.time()
        with contextlib.suppress(AssertionError):
            program.wait(ENDS_S)
        if program.left_behind():
            what = f"{node} has not exited, or left a process behind, after {ENDS_S} s"
            self._see(judge.SEEN, judge.Violation("g", now, what))
        self.start(node)

    def hit(self, name):
        now = time.time()
        self._hits[name] = FAULTS[name].do(self)
        next(self._hits[name])
        self._see(judge.BEGINS, name, now)
        if time.time() - now > judge.LATE_S:
            self._see(judge.LATE, time.time() - now)

    def heal(self, name):
        now = time.time()
        next(self._hits.pop(name), None)
        is_restart = FAULTS[name].is_restart
        self._see(judge.ENDS, name, time.time() + judge.STARTS_S if is_restart else now)

    def hold(self):
        """Hold LB and the stick after a release, and start a new record of events."""
        for node in self.nodes:
            if self.programs[node].ended:
                self.start(node)
        self.hands.show(RELEASED)
        self.wait_for_rest(time.time())
        time.sleep(rig.REST_S)
        self._stream = []
        self.odometry.clear()
        shown = self.hands.new_record()
        self.hands.show(DRIVE)
        return shown

    def _release(self, plan):
        """Release all, once a restarted base has reported its wheels for a while."""
        restarts = any(name in ("kill:base", "end:base") for *_, name in plan.hits)
        if restarts and not self.sees_truth:
            restarted_s = max(at_s for at_s, what, _ in self._stream if what == judge.ENDS)
            wait_for(lambda: self.since(restarted_s), "base that was restarted")
            back_s = self.since(restarted_s)[0].stamp
            wait_for(lambda: self.since(back_s + REPORTS_S), "its odometry")
        self.hands.show(RELEASED)

    def act(self, plan):
        """Drive, and do what a Plan says; return the stream of judge.Events."""
        self.seed = plan.seed
        self.hands.be_radio(any(name == "silence:gamepad" for *_, name in plan.hits))
        try:
            shown = self.drive_by(self.hold, try_s=MOVES_S, deadline_s=DRIVES_S)
        except AssertionError as error:
            self.is_deaf, now = True, time.time()
            what = judge.Violation("h", now, f"before the faults: {error}")
            return [judge.Event(now, judge.SEEN, what)]
        acts = [(at_s, self.hands.show, shows) for at_s, shows in plan.hands]
        acts += [(at_s, self.hit, name) for at_s, _, name in plan.hits]
        acts += [(end_s, self.heal, name) for _, end_s, name in plan.hits]
        acts.append((plan.ends_s, self._release, plan))
        began_s = time.monotonic()
        for at_s, do, what in sorted(acts, key=lambda act: act[0]):
            time.sleep(max(0.0, began_s + at_s - time.monotonic()))
            do(what)
        stream = [judge.Event(at_s, judge.HANDS, shows) for at_s, shows in shown]
        for moment in list(self.odometry):
            velocity = judge.velocity(moment.v, moment.w)
            stream.append(judge.Event(moment.stamp, judge.WHEELS, velocity))
        return [*stream, *self._stream]


class SerialWorld(World, SerialRig):
    """With a Kobuki on a serial line, and its driver as the base."""

    sees_truth = True
