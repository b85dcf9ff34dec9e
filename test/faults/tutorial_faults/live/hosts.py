"""The two machines of the hunt: robot and workstation, in namespaces of their own where granted.

Nothing of it touches the machine's own network or folders, and all is gone with its first process.
"""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from tutorial_faults.live.helpers import Helper
from tutorial_faults.live.kinds import LINK, MOUNT
from tutorial_testing.ports import free_port
from tutorial_testing.two_hosts.network import Host

INSIDE = "TUTORIAL_FAULTS_INSIDE"  # set in the namespaces
ROBOT, WORKSTATION = "10.99.0.1", "10.99.0.2"
HOME_BYTES = 16 << 20  # of the small disk that a fault fills


def move_in(arguments):
    """Become the same program in namespaces of its own; return if they are not granted."""
    if INSIDE in os.environ:
        return
    # Of processes, too: when the first one ends, so do all.
    enter = ["unshare", *([] if os.geteuid() == 0 else ["--user", "--map-root-user"])]
    enter += ["--net", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
    tried = shutil.which("unshare") and subprocess.run(
        [*enter, "true"], capture_output=True, check=False
    )
    if tried and tried.returncode == 0:
        os.environ[INSIDE] = "yes"
        os.execvp(enter[0], [*enter, sys.executable, "-m", "tutorial_faults", *arguments])
    os.environ[INSIDE] = ""


class Hosts:
    """The robot, on which this process is, and the workstation. A context manager.

    granted: which of LINK and MOUNT there are; refused: why the others are not.
    """

    def __init__(self, folder, seed):
        """folder: for logs, on a small disk if that is granted. seed: of what the cable loses."""
        self._stack = contextlib.ExitStack()
        self._folder, self._seed = folder, seed
        self.granted, self.refused = set(), {}
        self.robot_environment, self.workstation_environment = {}, {}
        self.workstation_prefix = []
        self._relay = None

    def __enter__(self):
        os.environ.pop("ROS_HOSTNAME", None)  # it would take precedence over ROS_IP
        if os.environ.get(INSIDE):
            subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
            self._try(MOUNT, self._mount)
            self._try(LINK, self._connect)
        else:
            self.refused = dict.fromkeys((LINK, MOUNT), "no namespaces of our own are granted")
        linked = LINK in self.granted
        robot, station = (ROBOT, WORKSTATION) if linked else ("127.0.0.1", "127.0.0.1")
        master = f"http://{robot}:{11311 if linked else free_port()}"
        self.robot_environment, self.workstation_environment = (
            {"ROS_HOME": self._folder, "ROS_MASTER_URI": master, "ROS_IP": address}
            for address in (robot, station)
        )
        return self

    def __exit__(self, *error):
        self._stack.__exit__(*error)

    def _try(self, need, take):
        try:
            take()
            self.granted.add(need)
        except (OSError, subprocess.SubprocessError, TimeoutError) as error:
            self.refused[need] = f"no {need}: {error}"

    def _mount(self):
        mount = ["mount", "-t", "tmpfs", "-o", f"size={HOME_BYTES}", "faults", self._folder]
        subprocess.run(mount, capture_output=True, check=True)
        self._stack.callback(subprocess.run, ["umount", "-l", self._folder], check=False)

    def _connect(self):
        """Lay the cable: each end is a device of its host, and the relay holds both."""
        if not Path("/dev/net/tun").exists():
            raise OSError("there is no /dev/net/tun")
        host = Host()
        self._stack.callback(host.close)
        self._relay = self._stack.enter_context(Helper("relay", self._seed, "robot", "station"))
        self._relay.wait_ready()
        _ip("link", "set", "station", "netns", host.command()[2])
        for run, name, address in ((_ip, "robot", ROBOT), (host.ip, "station", WORKSTATION)):
            run("address", "add", f"{address}/24", "dev", name)
            run("link", "set", name, "up")
        self.workstation_prefix = host.command()

    def ill(self, kind, value):
        """Make the cable ill, see relay; 0: healthy."""
        self._relay.write(kind, value)


def _ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, timeout=30)
