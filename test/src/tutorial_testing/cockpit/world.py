"""A robot, its joy2twist and a cockpit: on this machine, or on another host of a network."""

import contextlib
import os
import re
import signal
import subprocess
import threading
import time
from pathlib import Path
from typing import NamedTuple

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

HERE = Path(__file__).resolve().parent
START_S = 90.0  # of a machine that is busy with much else
RESTING = 50  # odometry messages, a second of them, in which nothing moves


class Moment(NamedTuple):
    """An odometry message: its stamp [s], v [m/s], w [rad/s], x, y [m] of the frame odom."""

    stamp: float
    v: float
    w: float
    x: float
    y: float

    @property
    def moves(self):
        return bool(self.v or self.w)


class World:
    """Everything but the browser. A context manager that leaves nothing behind.

    launch: what to launch beside the cockpit. host: a two_hosts.network.Host on which all of it
    runs, and its address, from which the page is then opened with a token; else this machine.
    """

    def __init__(self, *launch, host=None, address="127.0.0.1"):
        self._launch = launch or (str(HERE / "world.launch"),)
        self._host, self._address = host, address
        self._stack = contextlib.ExitStack()
        self._port = free_port()
        self.odometry = []  # all Moments so far
        self.environment = {
            "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}", "ROS_IP": "127.0.0.1",
            "DISPLAY": "",
        }  # fmt: skip

    def __enter__(self):
        self.launched = self.run("roslaunch", *self._launch)
        wait_for(lambda: "core service" in self.launched.output, "master", START_S)
        self._observe()
        wait_for(lambda: self.odometry, "odometry", START_S)
        self.start_cockpit()
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def run(self, *command):
        """Start a program beside the robot: a processes.Program."""
        start = self._host.start if self._host else Program
        return self._stack.enter_context(start(*command, **self.environment))

    def _observe(self):
        command = [str(HERE / "observer.py")]
        observer = subprocess.Popen(
            self._host.command(*command) if self._host else command,
            stdout=subprocess.PIPE, env={**os.environ, **self.environment}, text=True,
        )  # fmt: skip
        self._stack.enter_context(observer)
        self._stack.callback(observer.terminate)

        def read():
            with contextlib.suppress(ValueError):  # closed at the end
                for line in observer.stdout:
                    self.odometry.append(Moment(*map(float, line.split())))

        threading.Thread(target=read, daemon=True).start()

    def start_cockpit(self):
        """Start the cockpit, or restart it under the same address."""
        lan = ["--lan"] if self._host else []
        self.cockpit = self.run(node_path("cockpit", "cockpit.py"), "--port", str(self._port), *lan)
        shown = wait_for(lambda: re.search(r"to drive: \S+|open http\S+", self.cockpit.output),
                         "address of the cockpit", START_S)  # fmt: skip
        token = re.search(r"\?token=\S+", shown[0])
        self.address = f"http://{self._address}:{self._port}/{token[0] if token else ''}"

    def signal_cockpit(self, number):
        """Send a signal to all of the cockpit; returns the time [s] just before."""
        pids = self.cockpit.left_behind()
        now = time.time()
        for pid in pids:
            os.kill(pid, number)
        return now

    def kill_cockpit(self):
        """Let the cockpit end as by a lack of memory; returns the time [s] just before."""
        now = self.signal_cockpit(signal.SIGKILL)
        self.cockpit.wait()
        return now

    @property
    def now(self):
        return self.odometry[-1]

    def wait_for_rest(self):
        """Wait until the robot stands; return the stamp [s] of the message that first says so."""
        wait_for(lambda: not self.now.moves, "robot at rest")
        moments = list(self.odometry)
        last = max((i for i, moment in enumerate(moments) if moment.moves), default=-1)
        return moments[last + 1].stamp

    def stays_at_rest(self):
        """Whether nothing moves in the next second of odometry."""
        count = len(self.odometry)
        wait_for(lambda: len(self.odometry) >= count + RESTING, "odometry")
        return not any(moment.moves for moment in self.odometry[count:])
