"""Runs the node, or a bare one, beside an observer of its topics, on a master of its own."""

import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import rosgraph

from tutorial_testing.ports import free_port
from tutorial_testing.waiting import wait_for

HERE = Path(__file__).parent
BARE_NODE = [str(HERE / "bare_node.py")]
FAKE_TURTLEBOT = ["rosrun", "fake_turtlebot_sim", "fake_turtlebot.py"]
TICKS_PER_S = os.sysconf("SC_CLK_TCK")
PERIOD_NS = 20_000_000


@contextmanager
def running(command, **options):
    """Run a program in the background; end it afterwards."""
    process = subprocess.Popen(command, **options)
    try:
        yield process
    finally:
        process.terminate()
        process.wait()


@contextmanager
def master():
    """Run a master on a free port, and let the programs started here find it."""
    port = str(free_port())
    os.environ["ROS_MASTER_URI"] = uri = f"http://localhost:{port}"
    with running(["rosmaster", "--core", "-p", port], stdout=subprocess.DEVNULL):
        wait_for(rosgraph.Master("/benchmark", uri).is_online, "master")
        yield


def observe(command, topics, seconds, core=None):
    """Run a node and return (what the observer heard, processor time of the node [s/s])."""
    if core is not None:
        command = ["taskset", "-c", str(core), *command]
    observer = [sys.executable, str(HERE / "observer.py"), str(seconds), *topics]
    with running(command) as node, running(
        observer, stdout=subprocess.PIPE, universal_newlines=True
    ) as watcher:
        assert watcher.stdout.readline().strip() == "ready"
        began_s, used_s = time.monotonic(), processor_time(node.pid)
        heard = json.loads(watcher.stdout.readline())
        watcher.wait()
        used_s, took_s = processor_time(node.pid) - used_s, time.monotonic() - began_s
    return heard, used_s / took_s


def processor_time(pid):
    """Return the processor time [s] that a process and its running children have used."""
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    own_s = (int(fields[11]) + int(fields[12])) / TICKS_PER_S
    return own_s + sum(map(processor_time, children))


def topics_of(count, *names):
    """Return the names under each robot of ~robots, and /tf."""
    return ["/tf"] + [f"/robot_{k + 1}/{name}" for k in range(count) for name in names]


def lost_periods(record):
    """Return how many periods of 50 Hz the stamps of a topic leave out."""
    stamps = record["stamps"]
    return sum(round((b - a) / PERIOD_NS) - 1 for a, b in zip(stamps, stamps[1:]))
