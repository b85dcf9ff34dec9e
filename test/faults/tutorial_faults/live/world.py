"""The live system: gamepad, driver, joy2twist, mux and simulator, started once and repaired."""

import collections
import contextlib
import os
import signal
import time
from pathlib import Path

from node_kit.questions import call
from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.live.helpers import Helper, beat
from tutorial_faults.live.judge import Injury, Record
from tutorial_faults.live.kinds import BASE, DRIVER, JOY2TWIST, MUX, NODES, SAFETY, VIGILANCE_S
from tutorial_testing import rig
from tutorial_testing.hands import DRIVE, RELEASED
from tutorial_testing.processes import Program
from tutorial_testing.robot import Moment
from tutorial_testing.waiting import BUSY_S, wait_for

NAMES = {
    DRIVER: rig.JOYSTICK, JOY2TWIST: rig.DRIVER, MUX: rig.MUX, BASE: rig.BASE, SAFETY: rig.SAFETY,
}  # fmt: skip
CELL = Path(__file__).resolve().parents[2] / "cell.yaml"
ENDS_S = 1.5 + BUSY_S  # for a node to exit, when asked to
STARTS_S = 4.0  # to release all and drive again, at least
DRIVES_S = 90.0  # after which a system that does not drive is deaf
MASTER_S = 120.0  # for its first answer, on a machine that is busy with something else


class World(rig.Rig):
    """All processes of the system and those beside it. A context manager that ends them all."""

    def __init__(self, hosts, node=(), is_cell=False):
        """hosts: hosts.Hosts. node: a command in place of joy2twist's.

        is_cell: whether it drives in CELL, where a safety controller backs it off.
        """
        super().__init__(world=str(CELL) if is_cell else "", vigilance_timeout=VIGILANCE_S)
        self.nodes = (*NODES, SAFETY) if is_cell else NODES
        self.odometry = collections.deque(maxlen=1)  # of a long hunt; a record has all of a trial
        self.hosts, self._node, self._is_cell = hosts, node, is_cell
        self.record = Record()
        self._pressed = {"bumpers": 0.0, "drops": 0.0}  # how many are
        self.is_used_up = False  # it cannot be repaired for the next trial

    def begin(self):
        enter = self._stack.enter_context
        self._stack.callback(beat(lambda *late: self.record.late.append(late)))
        self.master = enter(self._start_master())
        super().begin()
        environment = {**os.environ, **self.hosts.robot_environment}
        self._observer, self.viewer, self.stranger = helpers = [
            enter(Helper("observer", environment=environment, hear=self._hear)),
            enter(Helper("stranger", "--listens", environment=environment)),
            enter(Helper("stranger", environment=environment)),
        ]
        for one in helpers:
            one.wait_ready()
        wait_for(lambda: self.odometry, "odometry", DRIVES_S)

    def listen(self):
        """Leave it to the observer, as this process is busy with the faults."""

    def _start_master(self):
        environment = self.hosts.robot_environment
        uri = environment["ROS_MASTER_URI"]
        port = uri.rsplit(":", 1)[1]
        master = Program("rosmaster", "--core", "-p", port, **environment)
        wait_for(lambda: call(uri, "getPid")[1], "master", MASTER_S)
        # Or every line of a node's log asks the master first.
        call(uri, "setParam", "/rosout_disable_topics_generation", False)
        return master

    # ------------------------------------------------------------------------------- the nodes

    def start(self, node):
        """Start a node, or restart it."""
        if node in (DRIVER, JOY2TWIST):
            prefix = self.hosts.workstation_prefix
            super().start(node, *prefix, **self.hosts.workstation_environment)
        else:
            super().start(node, **self.hosts.robot_environment)

    def given(self, node):
        """Return (program, parameters, remaps) of a node."""
        program, parameters, remaps = super().given(NAMES[node])
        if node == JOY2TWIST and self._node:
            # The preset is that of teleop_twist_joy, too; arming and vigilance are ours.
            ours = {*rig.LAUNCHED, "vigilance_timeout"}
            parameters = {key: one for key, one in parameters.items() if key not in ours}
            remaps = {**remaps, "/cmd_vel": "/cmd_vel_mux/input/teleop"}
            return self._node, parameters, remaps
        return program, parameters, remaps

    def signal(self, node, number):
        """Send a signal to a node, as far as it lives."""
        with contextlib.suppress(ProcessLookupError):
            if not self.programs[node].ended:
                os.kill(self.programs[node].pid, number)

    def await_end(self, node, asked_s):
        """Wait until a node that was asked to exit at a time [s] does; record it if it does not."""
        program = self.programs[node]
        try:
            program.wait(ENDS_S)
        except AssertionError:
            self.signal(node, signal.SIGKILL)
            self.report("g", f"{node} did not exit within {ENDS_S} s", asked_s)
        if program.left_behind():
            self.report("g", f"{node} left a process behind", asked_s)

    def end(self):
        """Press Ctrl-C at all nodes, from the gamepad to the base; return the Violations of (g)."""
        self.repair()
        self.begin_record()
        asked_s = time.time()
        for node in self.nodes:
            self.signal(node, signal.SIGINT)
        for node in self.nodes:
            self.await_end(node, asked_s)
        return self.record.reported

    # ------------------------------------------------------------------------------ the record

    def _hear(self, line):
        kind, *numbers = line.split()
        at_s, x, y, z = map(float, numbers)
        if kind == "wheels":
            self.odometry.append(Moment(at_s, x, z))
            self.record.wheels.append(Wheels(at_s, x, z))
        elif kind == "late":
            self.record.late.append((at_s, x))
        elif kind in ("bumpers", "drops"):
            self._pressed[kind] = x
            getattr(self.record, kind).append((at_s, x))
        else:
            into = self.record.commands if kind == "command" else self.record.asked
            into.append(Twist(at_s, (x, y, 0.0, 0.0, 0.0, z)))

    def begin_record(self):
        """Begin a new record."""
        now, pressed = time.time(), self._pressed
        self.record = Record(hands=self.hands.new_record(), is_safe=self._is_cell)
        self.record.bumpers.append((now, pressed["bumpers"]))
        self.record.drops.append((now, pressed["drops"]))

    def injure(self, kind):
        """Record that a fault of this kind begins now; return its judge.Injury."""
        injury = Injury(kind, time.time())
        self.record.injuries.append(injury)
        return injury

    def report(self, letter, what, at_s=None):
        """Record a Violation that the judge cannot see."""
        self.record.reported.append(Violation(letter, at_s or time.time(), what))

    # ------------------------------------------------------------------------- between trials

    def repair(self):
        """Start again what has exited."""
        for node in self.nodes:
            if self.programs[node].ended:
                self.start(node)

    def drive(self, heading_rad):
        """Release all, then hold LB and the stick until the robot moves, in a new record.

        heading_rad: into which it is turned in the middle of a cell. Raises AssertionError if it
        never moves.
        """

        def hold():
            self.repair()
            self.hands.show(RELEASED)
            self.wait_for_rest(time.time())
            if self._is_cell:
                self._observer.write(heading_rad)
            time.sleep(rig.REST_S)
            self.begin_record()
            self.hands.show(DRIVE)

        self.drive_by(hold, try_s=STARTS_S, deadline_s=DRIVES_S)

    def last_words(self):
        """Return the last lines of each node's output."""
        return [
            f"  {node}: {line}"
            for node, program in self.programs.items()
            for line in program.output.splitlines()[-3:]
        ]
