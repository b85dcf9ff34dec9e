"""Run nodes together with an observer of their topics, or a probe, on a separate master."""

import json
import os
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path

import rosgraph

from tutorial_testing.processes import free_port
from tutorial_testing.waiting import wait_for

HERE = Path(__file__).parent
BARE_NODE = [str(HERE / "bare_node.py")]
FAKE_TURTLEBOT = ["rosrun", "fake_turtlebot_sim", "fake_turtlebot.py"]
JOY2TWIST = [
    "rosrun", "joy2twist", "joy2twist.py", "_enable_button:=4", "_enable_turbo_button:=5",
    "_arm_on_neutral:=true", "_max_joy_age:=0.5", "_max_linear_speed:=5.0",
    "_max_angular_speed:=5.0",
]  # fmt: skip
PERIOD_NS = 20_000_000
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@contextmanager
def running(command, **options):
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


def observe(commands, topics, seconds):
    """Run nodes and return (what the observer heard, processor time of each node [s/s])."""
    observer = [sys.executable, str(HERE / "observer.py"), str(seconds), *topics]
    with ExitStack() as stack:
        nodes = [stack.enter_context(running(command, **QUIET)) for command in commands]
        watcher = stack.enter_context(running(observer, stdout=subprocess.PIPE, text=True))
        assert watcher.stdout.readline().strip() == "ready"
        began_s, before_s = time.monotonic(), [processor_time(node.pid) for node in nodes]
        heard = json.loads(watcher.stdout.readline())
        took_s = time.monotonic() - began_s
        used_s = [processor_time(node.pid) - b for node, b in zip(nodes, before_s)]
    return heard, [node_s / took_s for node_s in used_s]


def delays(kind, rate, count):
    """Return the times [s] until each message of probe.py was answered, sorted."""
    with probing(kind, rate, count) as probe:
        return json.loads(probe.stdout.readline())


def delays_and_processor(kind, rate, count, pid):
    """Return (delays, processor time [s] of the process per message)."""
    with probing(kind, rate, count) as probe:
        before_s = processor_time(pid)
        took_s = json.loads(probe.stdout.readline())
        return took_s, (processor_time(pid) - before_s) / count


@contextmanager
def probing(kind, rate, count):
    """Run probe.py, and yield it when everything is connected and warm."""
    command = [sys.executable, str(HERE / "probe.py"), kind, str(rate), str(count)]
    with running(command, stdout=subprocess.PIPE, text=True) as probe:
        assert probe.stdout.readline() == "ready\n"
        yield probe


def processor_time(pid):
    """Return the processor time [s] that a process and its running children have used."""
    children = map(int, Path(f"/proc/{pid}/task/{pid}/children").read_text().split())
    own_s = time.clock_gettime(~pid << 3 | 2)  # as clock_getcpuclockid(3); /proc has 10 ms only
    return own_s + sum(map(processor_time, children))


def topics_of(count, *names):
    """Return the names under each robot of ~robots, and /tf."""
    return ["/tf"] + [f"/robot_{k + 1}/{name}" for k in range(count) for name in names]


def lost_periods(heard):
    """Return how many periods of 50 Hz are missing in the stamps of all topics."""
    series = [record["stamps"] for record in heard.values()]
    pairs = [pair for stamps in series for pair in zip(stamps, stamps[1:])]
    return sum(round((b - a) / PERIOD_NS) - 1 for a, b in pairs)
