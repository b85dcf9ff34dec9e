"""The live system: gamepad, driver, joy2twist, mux and simulator, started once and repaired."""

import collections
import contextlib
import os
import time

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from node_kit.careful_connections import sender_of
from node_kit.questions import call
from tutorial_faults.invariants import Violation
from tutorial_faults.live import judge
from tutorial_faults.live.table import FAULTS, TELEOP, VIGILANCE_S
from tutorial_testing import rig
from tutorial_testing.hands import DRIVE, RELEASED
from tutorial_testing.nodes import init_node
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, wait_for

ENDS_S = 1.5 + BUSY_S  # for a node to exit, when asked to
MOVES_S = 4.0  # to release all and drive again, at least
DRIVES_S = 90.0  # after which a system that does not drive is deaf
STARTS_S = 0.3  # a node that is restarted does nothing sooner: it loads rospy


class World(rig.Rig):
    """All processes of the system and a viewer beside it. A context manager that ends them all.

    stream: what was seen in a trial. This process is also the other programs that send nonsense.
    """

    def __init__(self, command):
        """command: in place of joy2twist, if any."""
        super().__init__(vigilance_timeout=VIGILANCE_S)
        self._command, self.is_deaf = command, False
        self.odometry = collections.deque(maxlen=1)  # the stream has all of a trial
        self.stream, self.seed = [], 0

    def begin(self):
        uri = os.environ["ROS_MASTER_URI"]
        self.programs["master"] = Program("rosmaster", "--core", "-p", uri.rsplit(":", 1)[1])
        self._stack.callback(self._end_nodes)
        wait_for(lambda: call(uri, "getPid")[1], "master")
        # Or every line of a node's log asks the master first.
        call(uri, "setParam", "/rosout_disable_topics_generation", False)
        init_node("hunt", disable_signals=True, disable_rosout=True)
        super().begin()
        topics = ("/odom", "/joy", "/cmd_vel", f"/{TELEOP}")
        self.programs["viewer"] = Program("rostopic", "hz", *topics)
        wait_for(lambda: self.odometry, "odometry", DRIVES_S)

    def listen(self):
        super().listen()
        stamp = lambda odometry: (odometry.header.stamp.to_sec(), odometry.twist.twist)  # noqa: E731
        self._hear("odom", Odometry, judge.WHEELS, stamp)
        self._hear("cmd_vel", Twist, judge.COMMAND, lambda twist: (time.time(), twist))

    def _hear(self, topic, message_class, what, read):
        def hear(message):
            if sender_of(message) != rospy.get_name():
                at_s, twist = read(message)
                velocity = (twist.linear.x, twist.linear.y, 0.0, 0.0, 0.0, twist.angular.z)
                self._see(what, velocity, at_s)

        subscriber = rospy.Subscriber(topic, message_class, hear, queue_size=1000, tcp_nodelay=True)
        self._stack.callback(subscriber.unregister)

    def _see(self, what, value, at_s=None):
        self.stream.append(judge.Event(at_s or time.time(), what, value))

    def given(self, node):
        program, parameters, remaps = super().given(node)
        if node == rig.DRIVER and self._command:
            return self._command, parameters, {**remaps, "/cmd_vel": f"/{TELEOP}"}
        return program, parameters, remaps

    def signal(self, part, number):
        """Send a signal to a process, as far as it lives."""
        with contextlib.suppress(ProcessLookupError):
            if not self.programs[part].ended:
                os.kill(self.programs[part].pid, number)

    def restart(self, node):
        """Wait until a node that was asked to exit does; report it if it does not; start it."""
        program, now = self.programs[node], time.time()
        with contextlib.suppress(AssertionError):
            program.wait(ENDS_S)
        if program.left_behind():
            what = f"{node} has not exited, or left a process behind, after {ENDS_S} s"
            self._see(judge.SEEN, Violation("g", now, what))
        self.start(node)

    def hit(self, name):
        """Do what a fault of the table does."""
        now = time.time()
        FAULTS[name].do(self)
        self._see(judge.BEGINS, name, now)
        if time.time() - now > judge.LATE_S:
            self._see(judge.LATE, time.time() - now)

    def heal(self, name):
        """Undo it."""
        now = time.time()
        FAULTS[name].undo(self)
        is_restart = FAULTS[name].family in ("kill", "end")
        self._see(judge.ENDS, name, time.time() + STARTS_S if is_restart else now)

    def hold(self):
        """Hold LB and the stick after a release, in a new stream; return what the hands show."""
        for node in self.nodes:
            if self.programs[node].ended:
                self.start(node)
        self.hands.show(RELEASED)
        self.wait_for_rest(time.time())
        time.sleep(rig.REST_S)
        self.stream, shown = [], self.hands.new_record()
        self.hands.show(DRIVE)
        return shown

    def act(self, plan):
        """Drive, and do what a Plan says; return the stream."""
        self.seed = plan.seed
        self.hands.be_radio(any(name == "silence:gamepad" for *_, name in plan.hits))
        try:
            shown = self.drive_by(self.hold, try_s=MOVES_S, deadline_s=DRIVES_S)
        except AssertionError as error:
            self.is_deaf = True
            self._see(judge.SEEN, Violation("h", time.time(), f"before the faults: {error}"))
            return self.stream
        acts = [(at_s, self.hands.show, shows) for at_s, shows in plan.hands]
        acts += [(at_s, self.hit, name) for at_s, _, name in plan.hits]
        acts += [(end_s, self.heal, name) for _, end_s, name in plan.hits]
        acts.append((plan.ends_s, self.hands.show, RELEASED))
        began_s = time.monotonic()
        for at_s, do, what in sorted(acts, key=lambda act: act[0]):
            time.sleep(max(0.0, began_s + at_s - time.monotonic()))
            do(what)
        return [*self.stream, *(judge.Event(at_s, judge.HANDS, shows) for at_s, shows in shown)]
