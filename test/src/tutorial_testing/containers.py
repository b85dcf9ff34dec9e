"""Containers on a Docker engine: compose, and the robot in one of them."""

import contextlib
import os
import subprocess
from pathlib import Path

from tutorial_testing.ports import free_port
from tutorial_testing.robot import OBSERVER, Robot
from tutorial_testing.waiting import wait_for

SOURCE = Path(os.environ.get("CHECKED_SOURCE") or Path(__file__).resolve().parents[3])
INSIDE = "/home/student/ros1_tutorial"
PORT = free_port()  # 8080 may be another test's
PAGE = f"http://localhost:{PORT}/"
WITH_TESTS = f'PYTHONPATH=$PYTHONPATH:{INSIDE}/test/src exec "$@"'


def run(*command, text="", **environment):
    """Run a command to its end; return what it prints. AssertionError if it fails.

    text: for its standard input.
    """
    done = subprocess.run(
        command, env={**os.environ, **environment}, cwd=SOURCE, text=True, timeout=300, input=text,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{' '.join(command)}: {done.returncode}\n{done.stdout}"
    return done.stdout


class Compose:
    """The services of a file in docker/: a context manager that ends them."""

    def __init__(self, file="compose.yaml", **environment):
        self._command = ("docker-compose", "-f", f"docker/{file}")
        self._environment = {"COCKPIT_PORT": str(PORT), **environment}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(AssertionError):
            self("down", "--timeout", "5")

    def __call__(self, *words):
        return run(*self._command, *words, **self._environment)

    def container(self, service):
        """Return the id of a service's container."""
        return self("ps", "-q", service).split()[-1]


class RobotInside(Robot):
    """The robot of a container, seen through its odometry."""

    def __init__(self, container):
        super().__init__()
        inside = ("./tutorial", "run", "bash", "-c", WITH_TESTS, "-")
        self._inside = ("docker", "exec", "-i", container, *inside)

    def begin(self):
        wait_for(self._answers, "the simulated robot in the container")
        self.observe([*self._inside, *OBSERVER])

    def _answers(self):
        command = [*self._inside, "rosnode", "ping", "-c", "1", "/fake_turtlebot"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return "time=" in done.stdout
