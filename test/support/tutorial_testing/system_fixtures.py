"""Fixtures for tests of the whole system: a free port for a ROS master, a clean clone, hosts."""

import contextlib
import os
import shutil
from pathlib import Path

import pytest

from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.screen import virtual_screen
from tutorial_testing.student import Student
from tutorial_testing.two_hosts.network import Host
from tutorial_testing.two_hosts.scene import Scene
from tutorial_testing.waiting import DEADLINE_S
from tutorial_tools.io.command.lock import WAITS


@pytest.fixture
def master_uri(monkeypatch):
    """A ROS_MASTER_URI with a free port, so that the user's master is left alone."""
    uri = f"http://localhost:{free_port()}"
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    return uri


@pytest.fixture
def host():
    """The test's own host, on which every port is free, as on a user's machine."""
    try:
        own = Host()
    except PermissionError as error:
        pytest.skip(f"no network namespace for the ports 11311 and 8080: {error}")
    yield own
    own.close()


@pytest.fixture(scope="session")
def tutorial():
    return str(REPOSITORY / "tutorial")


@pytest.fixture(scope="session")
def call(tutorial):
    """A function that runs ./tutorial to its end, and returns (exit code, output).

    The output lacks the line that it waits for another test's ./tutorial.
    """

    def run(*words, deadline_s=DEADLINE_S, **environment):
        with Program(tutorial, *words, **environment) as program:
            return program.wait(deadline_s), program.output.replace(f"tutorial: {WAITS}\n", "")

    return run


@pytest.fixture(scope="session")
def suite_workspace():
    return str(Path(os.environ["CMAKE_PREFIX_PATH"].split(":")[0]).parent)


@pytest.fixture
def student(tmp_path, host, tutorial, suite_workspace):
    """A Student on a separate host: roscore uses port 11311 whatever ROS_MASTER_URI says."""
    with contextlib.closing(Student(tmp_path, host, tutorial, suite_workspace)) as typist:
        yield typist


@pytest.fixture(scope="session")
def clone(tmp_path_factory):
    """A copy of the repository, in a folder with a space in its name."""
    folder = tmp_path_factory.mktemp("clone") / "ros1 tutorial"
    ignored = shutil.ignore_patterns(".git", "__pycache__", ".*_cache", ".hypothesis")
    shutil.copytree(REPOSITORY, folder, symlinks=True, ignore=ignored)
    return folder


@pytest.fixture
def own_workspace(suite_workspace, tmp_path, monkeypatch):
    """A TUTORIAL_WORKSPACE with only our build in it, and no workspace sourced."""
    for name in ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH"):
        monkeypatch.delenv(name, raising=False)
    own = tmp_path / "ws"
    own.mkdir()
    for name in ("built", "devel", "python"):
        (own / name).symlink_to(f"{suite_workspace}/{name}")
    monkeypatch.setenv("TUTORIAL_WORKSPACE", str(own))
    return own


@pytest.fixture(scope="session")
def screen():
    with virtual_screen(1200, 800) as name:  # pixels, those of RViz's window in sim.rviz
        yield name


@pytest.fixture
def scene():
    """A two_hosts.scene.Scene: robot and workstation, two hosts joined by a cable."""
    try:
        with Scene() as scene:
            yield scene
    except PermissionError as error:
        pytest.skip(f"network namespaces need root, or a kernel that grants them to users: {error}")
