"""A robot, its joy2twist and a cockpit: on this machine, or on another host of a network."""

import re
from pathlib import Path

from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program, free_port
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import wait_for


class World(Robot):
    """Everything but the browser. A context manager that leaves nothing behind.

    arguments: of the launch file. host, address: a two_hosts.network.Host on which all of it runs,
    in place of this machine. lan: open the page with a token.
    """

    launch = (str(Path(__file__).resolve().with_name("world.launch")),)

    def __init__(self, *arguments, host=None, address="127.0.0.1", lan=False):
        super().__init__()
        self._arguments = arguments
        self._host, self._address, self._options = host, address, ["--lan"] if host or lan else []
        self.port = free_port()
        self.environment = {
            "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "ROS_IP": "127.0.0.1",
            "DISPLAY": "",
        }  # fmt: skip

    def begin(self):
        self.launched = self.run("roslaunch", *self.launch, *self._arguments)
        wait_for(lambda: "core service" in self.launched.output, "master")
        self.observe(self._host.command(*OBSERVER) if self._host else OBSERVER, **self.environment)
        self.start_cockpit()

    def run(self, *command):
        """Start a program beside the robot: a processes.Program."""
        start = self._host.start if self._host else Program
        return self._stack.enter_context(start(*command, **self.environment))

    def start_cockpit(self):
        """Start the cockpit, or restart it under the same address."""
        command = node_path("cockpit", "cockpit.py"), "--port", str(self.port), *self._options
        self.cockpit = self.run(*command)
        self.find_page()

    def find_page(self):
        shown = lambda: re.search(r"to drive: \S+|open http\S+", self.cockpit.output)  # noqa: E731
        wait_for(shown, "address of the cockpit")
        token = self.token("drive")
        self.address = f"http://{self._address}:{self.port}/{f'?token={token}' if token else ''}"

    def token(self, role):
        """Return the printed token to "look" or to "drive", or None."""
        match = re.search(rf"to {role}: .*token=(\S+)", self.cockpit.output)
        return match and match[1]


class EarlyWorld(World):
    """A World whose cockpit is started before the master.

    look: called with the World while its cockpit waits.
    """

    def __init__(self, look):
        super().__init__()
        self._look = look

    def begin(self):
        self.cockpit = self.run(node_path("cockpit", "cockpit.py"), "--port", str(self.port))
        wait_for(lambda: "waiting for a ROS master" in self.cockpit.output, "its line")
        self._look(self)
        super().begin()

    def start_cockpit(self):
        self.find_page()
