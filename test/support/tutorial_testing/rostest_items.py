"""Collect each rostest as a pytest item: a NAME.test in a folder ros, or a NAME.py alone.

Where permitted (to root), each gets its own network: a master still calls the port of a node that
died, which by then another test's node may use.
"""

import functools
import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tutorial_testing.processes import command_line, signal_all, with_environment
from tutorial_testing.waiting import wait_for

RESULTS = Path(os.environ.get("TUTORIAL_RESULTS", ".")) / "rostests"
ONE = Path(__file__).parents[1] / "one.test"
MARKED = re.compile(r"\bpytest\.mark\.(\w+)")
BROKEN = ("error", "failure")  # as JUnit files note it; rosunit notes no skips


def pytest_addoption(parser):
    parser.addoption("--times", type=int, default=1, metavar="N", help="run each rostest N times")


def starts_rostests(config):
    """Return whether this process is to run rostests, and is no worker of xdist."""
    is_asked = any("ros" in Path(argument).parts for argument in config.args)
    return is_asked and not hasattr(config, "workerinput")


def pytest_configure(config):
    if starts_rostests(config):
        signal.signal(signal.SIGHUP, signal.default_int_handler)  # as Ctrl-C, it ends all
        shutil.rmtree(RESULTS, ignore_errors=True)
        RESULTS.mkdir(parents=True)


def pytest_unconfigure(config):
    if starts_rostests(config):
        end_all(RESULTS)


def pytest_collect_file(file_path, parent):
    beside, is_named = file_path.with_suffix(".test"), parent.session.isinitpath(file_path)
    is_alone = file_path.suffix == ".py" and not beside.exists() and not is_named
    is_alone = is_alone and file_path.name != "conftest.py"
    if file_path.parent.name == "ros" and (is_alone or file_path == beside):
        return RosFile.from_parent(parent, path=file_path)
    return None


def pytest_pycollect_makemodule(module_path, parent):  # if a file is named
    is_rostest = module_path.parent.name == "ros"
    return RosFile.from_parent(parent, path=module_path) if is_rostest else None


class RosFile(pytest.File):
    def collect(self):
        beside = self.path.with_suffix(".test")
        command = [beside] if beside.exists() else [ONE, f"name:={self.path.stem}"]
        for turn in range(self.config.option.times):
            name = f"{self.path.stem}_{turn + 1}" if turn else self.path.stem
            test = RosTest.from_parent(self, name=name, command=command)
            for mark in MARKED.findall(self.path.with_suffix(".py").read_text()):
                test.add_marker(mark)
            yield test


class RosTest(pytest.Item):
    def __init__(self, command, **options):
        super().__init__(**options)
        self.command = command

    def runtest(self):
        home = Path(tempfile.mkdtemp(prefix=f"{self.name}.", dir=RESULTS))
        environment = {**os.environ, "ROS_HOME": str(home), "ROS_IP": "127.0.0.1"}
        environment.pop("ROS_HOSTNAME", None)  # no address of the user's is in that network
        with open(home / "output", "w+", errors="replace") as output:
            try:
                code = subprocess.call(
                    [*own_network(), "rostest", *self.command],
                    env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                )  # fmt: skip
            finally:
                end_all(home)
            output.seek(0)
            print(output.read())
        # A truncated file raises ParseError; failures without a name show in the exit code.
        files = [ElementTree.parse(path) for path in home.rglob("rosunit-*.xml")]
        cases = [case for file in files for case in file.iter("testcase")]
        failed = [case.get("name") for case in cases for note in case if note.tag in BROKEN]
        said = f"{', '.join(failed) or 'no test by name'} of {len(cases)} failed, exit code {code}"
        assert cases and not failed and not code, said

    def reportinfo(self):
        return self.path, None, self.name


@functools.lru_cache(1)
def own_network():
    """Return the command prefix that gives a command its own network; empty if not permitted."""
    words = ["unshare", "--net", "sh", "-c", 'ip link set lo up && exec "$@"', "-"]
    done = subprocess.run([*words, "true"], stderr=subprocess.DEVNULL, check=False)
    return words if done.returncode == 0 else []


def end_all(home):
    """Kill the processes of rostests, known by ROS_HOME: roslaunch gives each node a session."""

    def left():
        pids = with_environment(f"ROS_HOME={home}")
        signal_all(pids, signal.SIGKILL)
        return [f"{pid}: {command_line(pid)}".replace("\0", " ") for pid in pids]

    wait_for(lambda: not left(), f"end of all that has ROS_HOME={home}", seen=left)
