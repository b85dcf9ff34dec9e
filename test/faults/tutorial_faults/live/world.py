"""The live system: gamepad, driver, joy2twist, mux and simulator, started once and repaired."""

import contextlib
import os
import signal
import time
from pathlib import Path

import rospkg

from node_kit.questions import call
from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.live.helpers import PYTHON, Helper, beat
from tutorial_faults.live.judge import Injury, Record
from tutorial_faults.live.kinds import BASE, DRIVER, JOY2TWIST, MUX, NODES, SAFETY, VIGILANCE_S
from tutorial_testing import rig
from tutorial_testing.hands import DRIVE, RELEASED, Hands
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, wait_for

NAMES = {
    DRIVER: rig.JOYSTICK, JOY2TWIST: rig.DRIVER, MUX: rig.MUX, BASE: rig.BASE, SAFETY: rig.SAFETY,
}  # fmt: skip
CELL = Path(__file__).resolve().parents[2] / "cell.yaml"
ENDS_S = 1.5 + BUSY_S  # for a node to exit, when asked to
STARTS_S = 4.0  # to release all and drive again, at least
DRIVES_S = 90.0  # after which a system that does not drive is deaf
MASTER_S = 120.0  # for its first answer, on a machine that is busy with something else


class World:
    """All processes of the system and those beside it. A context manager that ends them all."""

    def __init__(self, hosts, folder, node=(), is_cell=False):
        """hosts: hosts.Hosts. folder: for the FIFO. node: a command in place of joy2twist's.

        is_cell: whether it drives in CELL, where a safety controller backs it off.
        """
        self.hosts, self._node, self._is_cell = hosts, node, is_cell
        self._nodes = (*NODES, SAFETY) if is_cell else NODES
        self._stack = contextlib.ExitStack()
        self._packages = rospkg.RosPack()  # which looks through all folders once
        self.programs, self.record = {}, Record()
        self._newest = None  # events.Wheels
        self._pressed = {"bumpers": 0.0, "drops": 0.0}  # how many are
        self._device = os.path.join(folder, "js0")
        self.is_used_up = False  # it cannot be repaired for the next trial

    def __enter__(self):
        enter = self._stack.enter_context
        try:
            self._stack.callback(beat(lambda *late: self.record.late.append(late)))
            self.master = enter(self._start_master())
            self.hands = enter(Hands(self._device))
            self._stack.callback(self._end_nodes)
            for node in reversed(self._nodes):
                self.start(node)
            environment = {**os.environ, **self.hosts.robot_environment}
            helpers = [
                enter(Helper("observer", environment=environment, hear=self._hear)),
                enter(Helper("stranger", "--listens", environment=environment)),
                enter(Helper("stranger", environment=environment)),
            ]
            for one in helpers:
                one.wait_ready()
            self._observer, self.viewer, self.stranger = helpers
            wait_for(lambda: self._newest, "odometry", DRIVES_S)
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def _start_master(self):
        environment = self.hosts.robot_environment
        uri = environment["ROS_MASTER_URI"]
        port = uri.rsplit(":", 1)[1]
        master = Program("rosmaster", "--core", "-p", port, **environment)
        wait_for(lambda: call(uri, "getPid")[1], "master", MASTER_S)
        # Or every line of a node's log asks the master first.
        call(uri, "setParam", "/rosout_disable_topics_generation", False)
        return master

    def _end_nodes(self):
        for program in self.programs.values():
            program.__exit__()

    # ------------------------------------------------------------------------------- the nodes

    def start(self, node):
        """Start a node, or restart it."""
        at_station = node in (DRIVER, JOY2TWIST)
        prefix = self.hosts.workstation_prefix if at_station else ()
        environment = (
            self.hosts.workstation_environment if at_station else self.hosts.robot_environment
        )
        old = self.programs.get(node)
        self.programs[node] = Program(*prefix, *self._command(node), **environment)
        if old:
            old.__exit__()

    def _command(self, node):
        cell = str(CELL) if self._is_cell else ""
        given = rig.given_to(NAMES[node], self._device, world=cell, vigilance_timeout=VIGILANCE_S)
        package, name, parameters, remaps = given
        if node == JOY2TWIST and self._node:
            # The preset is that of teleop_twist_joy, too; arming and vigilance are ours.
            ours = ("arm_on_neutral", "log_rate", "vigilance_timeout")
            parameters = {key: one for key, one in parameters.items() if key not in ours}
            remaps = {**remaps, "/cmd_vel": "/cmd_vel_mux/input/teleop"}
            return [*self._node, *rig.arguments(parameters, remaps)]
        script = os.path.join(self._packages.get_path(package), "scripts", name)
        return [PYTHON, script, *rig.arguments(parameters, remaps)]

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
        for node in self._nodes:
            self.signal(node, signal.SIGINT)
        for node in self._nodes:
            self.await_end(node, asked_s)
        return self.record.reported

    # ------------------------------------------------------------------------------ the record

    def _hear(self, line):
        kind, *numbers = line.split()
        at_s, x, y, z = map(float, numbers)
        if kind == "wheels":
            self._newest = Wheels(at_s, x, z)
            self.record.wheels.append(self._newest)
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

    @property
    def moves(self):
        """Whether the newest odometry says so."""
        return self._newest is not None and bool(self._newest.v or self._newest.w)

    # ------------------------------------------------------------------------- between trials

    def repair(self):
        """Start again what has exited."""
        for node in self._nodes:
            if self.programs[node].ended:
                self.start(node)

    def drive(self, heading_rad):
        """Release all, then hold LB and the stick until the robot moves, in a new record.

        heading_rad: into which it is turned in the middle of a cell. Raises AssertionError if it
        never moves.
        """

        def once():
            self.repair()
            self.hands.show(RELEASED)
            began = time.time()
            wait_for(lambda: self._newest.at_s > began and not self.moves, "robot at rest")
            if self._is_cell:
                self._observer.write(heading_rad)
            time.sleep(rig.REST_S)
            self.begin_record()
            self.hands.show(DRIVE)
            end = time.monotonic() + STARTS_S
            while time.monotonic() < end and not self.moves:
                time.sleep(0.005)
            return self.moves

        wait_for(once, "robot that drives", DRIVES_S)

    def last_words(self):
        """Return the last lines of each node's output."""
        return [
            f"  {node}: {line}"
            for node, program in self.programs.items()
            for line in program.output.splitlines()[-3:]
        ]
