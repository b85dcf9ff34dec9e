"""The two machines of TWO_MACHINES.md: the robot, which has the master, and the workstation."""

import re
import subprocess
from pathlib import Path

from tutorial_testing.processes import REPOSITORY
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import wait_for

from .network import Network

ROBOT, WORKSTATION = "robot", "workstation"


def page_blocks():
    """Return the page's commands: name of a host -> (address, variables, launch command)."""
    page = (REPOSITORY / "common/doc/TWO_MACHINES.md").read_text()
    blocks = re.findall(r"^```bash\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    lines = {host: block.splitlines() for host, block in zip((ROBOT, WORKSTATION), blocks)}
    return {
        host: (re.search(r"ROS_IP=(\S+)", variables)[1], variables, launch)
        for host, (variables, launch) in lines.items()
    }


class Scene(Robot):
    """Both hosts and their programs. A context manager that leaves nothing behind."""

    def begin(self):
        self._blocks = page_blocks()
        addresses = {host: self.address(host) for host in self._blocks}
        self.network = self._stack.enter_context(Network(addresses))

    def address(self, host):
        return self._blocks[host][0]

    def start(self, host, command, **options):
        """Start a command on a host, with the page's variables: a processes.Program."""
        _, variables, _ = self._blocks[host]
        script = f"{variables}\nexec {command}"
        command = [str(REPOSITORY / "tutorial"), "run", "bash", "-ec", script]
        # Without a screen, so that RViz is left out.
        return self._stack.enter_context(self.network[host].start(*command, DISPLAY="", **options))

    def launch_robot(self):
        self.robot = self.start(ROBOT, self._blocks[ROBOT][2])
        wait_for(lambda: "core service" in self.robot.output, "master of the robot")
        address = self.address(ROBOT)
        environment = {"ROS_MASTER_URI": f"http://{address}:11311", "ROS_IP": address}
        self.observe(self.network[ROBOT].command(*OBSERVER), **environment)

    def launch_workstation(self, launch=None):
        """Start a launch command on the workstation, by default the page's."""
        self.workstation = self.start(WORKSTATION, launch or self._blocks[WORKSTATION][2])

    def launch_pilot(self):
        """Start the pilot at the workstation, whose joystick tell() moves."""
        command = f"'{Path(__file__).with_name('pilot.py')}'"
        self._pilot = self.start(WORKSTATION, command, stdin=subprocess.PIPE)
        wait_for(self._pilot_lines, "pilot")

    def tell(self, word):
        """Tell the pilot to drive, release or neutral; return the time [s] of the Joy."""
        count = len(self._pilot_lines())
        self._pilot.type(word)
        line = wait_for(lambda: self._pilot_lines()[count:], f"pilot that does {word}")[0]
        return float(line.split()[1])

    def drive(self):
        """Hold LB and the stick until the robot drives; return its first Moment."""
        began = self.tell("drive")
        return self.first(lambda m: m.stamp > began and m.v > 0, "driving robot")

    def _pilot_lines(self):
        return [line for line in self._pilot.output.splitlines(keepends=True) if line[-1] == "\n"]
