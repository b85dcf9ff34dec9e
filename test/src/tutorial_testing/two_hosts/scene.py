"""The two machines of TWO_MACHINES.md: the robot with the master, and the workstation."""

import contextlib
import re
import subprocess
from pathlib import Path
from typing import NamedTuple

from tutorial_testing.waiting import wait_for

from .network import Network

HERE = Path(__file__).resolve().parent
OBSERVER = HERE.parent / "cockpit" / "observer.py"
REPOSITORY = HERE.parents[3]
ROBOT, WORKSTATION = "robot", "workstation"


def page_blocks():
    """Return the page's commands: name of the host -> (its address, its variables, its launch)."""
    page = (REPOSITORY / "common/doc/TWO_MACHINES.md").read_text()
    blocks = re.findall(r"^```bash\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    lines = {host: block.splitlines() for host, block in zip((ROBOT, WORKSTATION), blocks)}
    return {
        host: (re.search(r"ROS_IP=(\S+)", variables)[1], variables, launch)
        for host, (variables, launch) in lines.items()
    }


class Moment(NamedTuple):
    """An odometry message: its stamp [s], v [m/s], x, y [m] of the frame odom."""

    time: float
    v: float
    x: float
    y: float


class Scene:
    """Both hosts and what runs on them. A context manager that leaves nothing behind."""

    def __init__(self):
        self._blocks = page_blocks()
        self._stack = contextlib.ExitStack()

    def __enter__(self):
        addresses = {host: self.address(host) for host in self._blocks}
        self.network = self._stack.enter_context(Network(addresses))
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def address(self, host):
        """Return the IPv4 address of a host, as the page has it."""
        return self._blocks[host][0]

    def start(self, host, command, **options):
        """Start a command on a host, with the page's variables: a processes.Program."""
        _, variables, _ = self._blocks[host]
        script = f"{variables}\nexec {command}"
        command = [str(REPOSITORY / "tutorial"), "run", "bash", "-ec", script]
        # Without a screen, so that RViz is left out.
        return self._stack.enter_context(self.network[host].start(*command, DISPLAY="", **options))

    def launch_robot(self, arguments=""):
        """Start the page's launch on the robot and watch its odometry."""
        self.robot = self.start(ROBOT, f"{self._blocks[ROBOT][2]} {arguments}")
        wait_for(lambda: "core service" in self.robot.output, "master of the robot")
        self._observer = self.start(ROBOT, f"'{OBSERVER}'")
        wait_for(lambda: self.odometry, "odometry of the robot")

    def launch_workstation(self, launch=None):
        """Start a launch on the workstation, by default the page's."""
        self.workstation = self.start(WORKSTATION, launch or self._blocks[WORKSTATION][2])

    def launch_pilot(self):
        """Let a person sit at the workstation, whose joystick tell() moves."""
        self._pilot = self.start(WORKSTATION, f"'{HERE}/pilot.py'", stdin=subprocess.PIPE)
        wait_for(self._pilot_lines, "pilot")

    def tell(self, word):
        """Tell the pilot to drive, release or neutral; return the time [s] of the Joy."""
        told = len(self._pilot_lines())
        self._pilot.type(word)
        line = wait_for(lambda: self._pilot_lines()[told:], f"pilot that does {word}")[0]
        return float(line.split()[1])

    def _pilot_lines(self):
        return [line for line in self._pilot.output.splitlines(keepends=True) if line[-1] == "\n"]

    @property
    def odometry(self):
        """All Moments so far."""
        lines = self._observer.output.splitlines()[:-1]  # the last may be half written
        moments = [line.split() for line in lines if line[0].isdigit()]
        return [Moment(*map(float, (at, v, x, y))) for at, v, _, x, y in moments]

    def moment(self, condition, what):
        """Wait for an odometry message for which condition(Moment) holds; return the first one."""
        return wait_for(lambda: next(filter(condition, self.odometry), None), what)
