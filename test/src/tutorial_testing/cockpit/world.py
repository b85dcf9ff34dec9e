"""A robot, its joy2twist and a cockpit: on this machine, or on another host of a network."""

import re
from pathlib import Path

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import wait_for

LAUNCH = str(Path(__file__).resolve().with_name("world.launch"))


class World(Robot):
    """Everything but the browser. A context manager that leaves nothing behind.

    arguments: of world.launch. host: a two_hosts.network.Host on which all of it runs, and its
    address, from which the page is then opened with a token; else this machine.
    """

    def __init__(self, *arguments, host=None, address="127.0.0.1"):
        super().__init__()
        self._arguments = arguments
        self._host, self._address = host, address
        self._port = free_port()
        self.environment = {
            "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "ROS_IP": "127.0.0.1",
            "DISPLAY": "",
        }  # fmt: skip

    def begin(self):
        launched = self.run("roslaunch", LAUNCH, *self._arguments)
        wait_for(lambda: "core service" in launched.output, "master")
        self.observe(self._host.command(*OBSERVER) if self._host else OBSERVER, **self.environment)
        self.start_cockpit()

    def run(self, *command):
        """Start a program beside the robot: a processes.Program."""
        start = self._host.start if self._host else Program
        return self._stack.enter_context(start(*command, **self.environment))

    def start_cockpit(self):
        """Start the cockpit, or restart it under the same address."""
        lan = ["--lan"] if self._host else []
        self.cockpit = self.run(node_path("cockpit", "cockpit.py"), "--port", str(self._port), *lan)
        shown = wait_for(lambda: re.search(r"to drive: \S+|open http\S+", self.cockpit.output),
                         "address of the cockpit")  # fmt: skip
        token = re.search(r"\?token=\S+", shown[0])
        self.address = f"http://{self._address}:{self._port}/{token[0] if token else ''}"
