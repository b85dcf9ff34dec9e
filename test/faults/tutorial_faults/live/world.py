"""The live system: gamepad, driver, joy2twist, mux and simulator, started once and repaired."""

import contextlib
import json
import os
import signal
import time

import rospkg
import yaml

from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.invariants import unended
from tutorial_faults.live.beat import beat
from tutorial_faults.live.hands import HandsOnPad
from tutorial_faults.live.judge import Injury, Record
from tutorial_faults.live.kinds import BASE, DRIVER, JOY2TWIST, LINK, MUX, NODES, VIGILANCE_S
from tutorial_faults.live.master import Master
from tutorial_faults.live.plan import DRIVE, RELEASED
from tutorial_faults.live.talker import PYTHON, Talker
from tutorial_testing.processes import Program
from tutorial_testing.waiting import BUSY_S, wait_for

NAMES = {
    DRIVER: "/joy_node",
    JOY2TWIST: "/NewJoy2Twist",
    MUX: "/cmd_vel_mux",
    BASE: "/fake_turtlebot",
}
ENDS_S = 1.5 + BUSY_S  # for a node to end, when told to
RESTS_S = 0.6  # for which a multiplexer wants to see a sender rest
STARTS_S = 4.0  # to release all and drive again, at least
DRIVES_S = 90.0  # after which a system that does not drive is deaf


class World:
    """All processes of the system and those beside it. A context manager that ends them all."""

    def __init__(self, hosts, folder, node=(), simulated=False):
        """hosts: hosts.Hosts. folder: for the FIFO. node: a command in place of joy2twist's."""
        self.hosts, self.simulated = hosts, simulated
        self._folder, self._node = folder, node
        self._stack = contextlib.ExitStack()
        self._packages = rospkg.RosPack()  # which looks through all folders once
        self.programs = {}
        self.record = Record()
        self._newest = None  # events.Wheels
        self.master = Master(hosts.robot_environment)
        beat(lambda *late: self.record.late.append(late))

    def __enter__(self):
        enter = self._stack.enter_context
        try:
            self.master.start(self.simulated)
            self._stack.push(self.master)
            if self.simulated:
                self.clock = enter(self._talker("clock"))
                self.clock.wait_ready()
            self.hands = enter(HandsOnPad(os.path.join(self._folder, "js0")))
            self._stack.callback(self._end_nodes)
            for node in reversed(NODES):
                self.start(node)
            self.observer = enter(self._talker("observer", hear=self._hear))
            self.viewer = enter(self._talker("stranger", "--listens"))
            self.stranger = enter(self._talker("stranger"))
            for one in (self.observer, self.viewer, self.stranger):
                one.wait_ready()
            wait_for(lambda: self._newest, "odometry", DRIVES_S)
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def _talker(self, *words, hear=None):
        environment = {**os.environ, **self.hosts.robot_environment}
        return Talker(*words, environment=environment, hear=hear)

    def _end_nodes(self):
        for program in self.programs.values():
            program.__exit__()

    # ------------------------------------------------------------------------------- the nodes

    def start(self, node):
        """Start a node, or start it anew."""
        command, parameters, remaps = self._command(node)
        arguments = [f"_{name}:={json.dumps(value)}" for name, value in parameters.items()]
        arguments += [f"{name}:={to}" for name, to in remaps.items()]
        at_station = node in (DRIVER, JOY2TWIST)
        prefix = self.hosts.workstation_prefix if at_station else ()
        environment = (
            self.hosts.workstation_environment if at_station else self.hosts.robot_environment
        )
        old = self.programs.get(node)
        self.programs[node] = Program(*prefix, *command, *arguments, **environment)
        if old:
            old.__exit__()

    def _command(self, node):
        find = self._packages.get_path
        if node == DRIVER:
            script, given, remaps = "gamepad/joy_node", {"dev": self.hands.path}, {}
        elif node == JOY2TWIST:
            preset = _read(find("joy2twist"), "config", "f710_d.yaml")
            given = {**preset, "arm_on_neutral": True, "log_rate": 0}
            given["vigilance_timeout"] = VIGILANCE_S
            script, remaps = "joy2twist/joy2twist.py", {"cmd_vel": "cmd_vel_mux/input/teleop"}
            if self._node:
                # The preset is that of teleop_twist_joy, too; arming is ours.
                return self._node, preset, {**remaps, "/cmd_vel": "/cmd_vel_mux/input/teleop"}
        elif node == MUX:
            script = "fake_turtlebot_sim/cmd_vel_mux.py"
            given = _read(find("fake_turtlebot_sim"), "config", "cmd_vel_mux.yaml")
            remaps = {"cmd_vel_mux/output": "cmd_vel"}
        else:
            script, given, remaps = "fake_turtlebot_sim/fake_turtlebot.py", {}, {}
        package, name = script.split("/")
        return (PYTHON, os.path.join(find(package), "scripts", name)), given, remaps

    def signal(self, node, number):
        """Send a signal to a node, as far as it lives."""
        with contextlib.suppress(ProcessLookupError):
            if not self.programs[node].ended:
                os.kill(self.programs[node].pid, number)

    def end(self):
        """Press Ctrl-C at all nodes, from the gamepad to the base; the Violations of (g)."""
        asked_s, ended_s, wrong = time.time(), {}, []
        self.repair()
        for node in NODES:
            self.signal(node, signal.SIGINT)
        for node in NODES:
            with contextlib.suppress(AssertionError):
                self.programs[node].wait(ENDS_S)
                ended_s[node] = time.time()
                if self.programs[node].left_behind():
                    wrong.append(Violation("g", asked_s, f"{node} left a process behind"))
        return wrong + unended(asked_s, {node: ended_s.get(node) for node in NODES}, ENDS_S)

    # ------------------------------------------------------------------------------ the record

    def _hear(self, line):
        kind, *numbers = line.split()
        at_s, x, y, z = map(float, numbers)
        if kind == "wheels":
            self._newest = Wheels(at_s, x, z)
            self.record.wheels.append(self._newest)
        elif kind in ("command", "asked"):
            into = self.record.commands if kind == "command" else self.record.asked
            into.append(Twist(at_s, (x, y, 0.0, 0.0, 0.0, z)))
        elif kind == "late":
            self.record.late.append((at_s, x))

    def begin_record(self):
        """Begin a new record."""
        self.record = Record(hands=self.hands.new_record())

    def injure(self, kind):
        """Write down that a fault of this kind begins now: its judge.Injury."""
        injury = Injury(kind, time.time())
        self.record.injuries.append(injury)
        return injury

    @property
    def moves(self):
        """Whether the newest odometry says so."""
        return self._newest is not None and bool(self._newest.v or self._newest.w)

    # ------------------------------------------------------------------------- between trials

    def repair(self):
        """Start again what has ended."""
        for node in NODES:
            if self.programs[node].ended:
                self.start(node)

    def drive(self):
        """Release all, then hold LB and the stick until the robot moves, in a new record.

        Raises AssertionError if it never does.
        """

        def once():
            self.repair()
            self.hands.show(RELEASED)
            began = time.time()
            wait_for(lambda: self._stands_since(began), "robot at rest")
            time.sleep(RESTS_S)
            self.begin_record()
            self.hands.show(DRIVE)
            end = time.monotonic() + STARTS_S
            while time.monotonic() < end and not self.moves:
                time.sleep(0.005)
            return self.moves

        wait_for(once, "robot that drives", DRIVES_S)

    def _stands_since(self, began):
        return self._newest.at_s > began and not self.moves

    @property
    def linked(self):
        """Whether there is a cable between two hosts."""
        return LINK in self.hosts.granted

    def last_words(self):
        """From each node to the end of its output."""
        return {node: program.output[-2000:] for node, program in self.programs.items()}


def _read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return yaml.safe_load(file)
