"""The two machines of the hunt: robot and workstation, in namespaces of their own where granted.

Nothing of it touches the machine's own network or folders, and all is gone with its first process.
"""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from tutorial_faults.live.kinds import LINK, MOUNT, SIMULATED
from tutorial_faults.live.talker import Talker
from tutorial_testing.ports import free_port
from tutorial_testing.two_hosts.network import Host

INSIDE = "TUTORIAL_FAULTS_INSIDE"  # set in the namespaces
ROBOT, WORKSTATION = "10.99.0.1", "10.99.0.2"
HOME_BYTES = 16 << 20  # of the small disk that a fault fills


def move_in(arguments):
    """Become the same program in namespaces of its own; return if they are not granted."""
    if INSIDE in os.environ:
        return
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    # Of processes, too: when the first one ends, by whatever, so do all.
    enter = [
        "unshare",
        *user,
        "--net",
        "--mount",
        "--pid",
        "--fork",
        "--kill-child",
        "--mount-proc",
    ]
    tried = shutil.which("unshare") and subprocess.run(
        [*enter, "true"], capture_output=True, check=False
    )
    if tried and tried.returncode == 0:
        os.environ[INSIDE] = "yes"
        os.execvp(enter[0], [*enter, sys.executable, "-m", "tutorial_faults", *arguments])
    os.environ[INSIDE] = ""


class Hosts:
    """The robot, on which this process is, and the workstation. A context manager.

    granted: which of LINK, MOUNT and SIMULATED there are; refused: why the others are not.
    """

    def __init__(self, folder, seed):
        """folder: for logs, on a small disk if that is granted. seed: of what the cable loses."""
        self._stack = contextlib.ExitStack()
        self._folder, self._seed = folder, seed
        self.granted, self.refused = {SIMULATED}, {}
        self.robot_environment, self.workstation_environment = {}, {}
        self.workstation_prefix = []
        self.relay = None

    def __enter__(self):
        os.environ.pop("ROS_HOSTNAME", None)  # it would outdo ROS_IP
        if not os.environ.get(INSIDE):
            self.refused = dict.fromkeys((LINK, MOUNT), "no namespaces of our own are granted")
            port = free_port()
            address = {"ROS_IP": "127.0.0.1", "ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
            self.robot_environment = self.workstation_environment = self._environment(address)
            return self
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
        self._mount()
        master = {"ROS_MASTER_URI": f"http://{ROBOT}:11311"}
        try:
            self._connect()
        except (OSError, subprocess.SubprocessError, TimeoutError) as error:
            self.refused[LINK] = f"no network of our own: {error}"
            master = {"ROS_MASTER_URI": "http://127.0.0.1:11311", "ROS_IP": "127.0.0.1"}
        robot = {"ROS_IP": ROBOT, **master}
        workstation = {"ROS_IP": WORKSTATION, **master}
        self.robot_environment = self._environment(robot)
        self.workstation_environment = self._environment(workstation)
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def _environment(self, given):
        return {"ROS_HOME": self._folder, **given}

    def _mount(self):
        done = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={HOME_BYTES}", "faults", self._folder],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode == 0:
            self.granted.add(MOUNT)
            self._stack.callback(subprocess.run, ["umount", "-l", self._folder], check=False)
        else:
            self.refused[MOUNT] = f"no small disk may be mounted: {done.stderr.strip()}"

    def _connect(self):
        """Lay the cable: each end is an own device of its host, and the relay holds both."""
        if not Path("/dev/net/tun").exists():
            raise OSError("there is no /dev/net/tun")
        host = Host()
        self._stack.callback(host.close)
        self.relay = self._stack.enter_context(Talker("relay", self._seed, "robot", "station"))
        self.relay.wait_ready()
        _ip("link", "set", "station", "netns", host.command()[2])
        for run, name, address in ((_ip, "robot", ROBOT), (host.ip, "station", WORKSTATION)):
            run("address", "add", f"{address}/24", "dev", name)
            run("link", "set", name, "up")
        self.workstation_prefix = host.command()
        self.granted.add(LINK)

    def ill(self, name, value):
        """Give the cable an ill, see relay; 0: none."""
        self.relay.tell(name, value)


def _ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, timeout=30)
