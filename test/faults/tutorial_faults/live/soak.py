"""./tutorial test faults --soak: the recording and a classroom without faults, and what grows."""

import contextlib
import csv
import os
import re
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import rospkg

from node_kit.questions import call
from tutorial_faults.live import hosts
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ROBOTS, STUDENTS = 10, (1, 2)
PERIOD_S = 10.0
STARTS_S = 600.0  # for all to start, on a busy machine
SETTLES_S = 60.0  # after which nothing new is opened
MOST_GROWTH_KB = 2048
# All nodes but the cockpit, whose name differs.
NODES = {
    "/classroom", "/fake_turtlebot", "/myjoystick2twist", "/robot_state_publisher", "/rosbag",
    "/rosout", *(f"/robot_{n}/{name}" for n in STUDENTS for name in ("myjoystick2twist", "rosbag")),
}  # fmt: skip


class Sample(NamedTuple):
    """One process at one time [s] since the start: memory [kB], threads, open files."""

    at_s: float
    node: str
    memory_kb: int
    threads: int
    files: int


def sample(at_s, node, pid):
    """Return the Sample of a process, or None if it has exited."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
        files = len(os.listdir(f"/proc/{pid}/fd"))
    except OSError:
        return None
    memory, threads = (
        int(re.findall(rf"^{name}:\s+(\d+)", status, re.M)[0]) for name in ("VmRSS", "Threads")
    )
    return Sample(at_s, node, memory, threads, files)


def growth(samples):
    """Return (memory [kB], threads, files) by which a node has grown after it settled.

    The smallest of the last tenth of the time, as a thread that answers one question is no growth;
    of memory beyond the smallest of the first tenth, of threads and files beyond the largest of the
    first minute. None: unknown.
    """
    before = [one for one in samples if one.at_s <= SETTLES_S]
    after = [one for one in samples if one.at_s > SETTLES_S]
    if not before or not after:
        return None
    tenth = max(1, len(after) // 10)
    last, first = after[-tenth:], after[:tenth]
    memory = min(one.memory_kb for one in last) - min(one.memory_kb for one in first)
    threads, files = (
        min(getattr(one, name) for one in last) - max(getattr(one, name) for one in before)
        for name in ("threads", "files")
    )
    return memory, threads, files


def findings(samples):
    """Return (a line about each node, whether any has grown)."""
    lines, is_bad = [], False
    for node in sorted({one.node for one in samples}):
        its = [one for one in samples if one.node == node]
        line = f"{node}: {its[-1].memory_kb} kB, {its[-1].threads} threads, {its[-1].files} files"
        grown = growth(its)
        if grown is None:
            lines.append(f"{line}; did not live for longer than {SETTLES_S:.0f} s: WRONG")
        else:
            is_wrong = grown[0] > MOST_GROWTH_KB or max(grown[1:]) > 0
            by = f"grew by {grown[0]} kB, {grown[1]} threads, {grown[2]} files"
            lines.append(f"{line}; {by}{': WRONG' * is_wrong}")
        is_bad = is_bad or "WRONG" in lines[-1]
    return lines, is_bad


def commands():
    """Yield the command lines: the recording's launch file, and a classroom with students."""
    bag = os.path.join(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")
    yield "roslaunch", "joy2twist", "launch_bag.launch", "rviz:=false"
    yield "roslaunch", "--wait", "cockpit", "classroom.launch", f"robots:={ROBOTS}"
    for number in STUDENTS:
        yield (
            "roslaunch", "--wait", "joy2twist", "student.launch", f"name:=robot_{number}",
            "rviz:=false", f"bag:={bag}", "loop:=true",
        )  # fmt: skip


def node_pids(uri):
    """Return {name of a node: its process}, as a master knows them."""
    state = call(uri, "getSystemState")[1] or []
    names = {name for kind in state for _, names in kind for name in names}
    uris = {name: call(uri, "lookupNode", name)[1] for name in names}
    pids = {name: node and call(node, "getPid")[1] for name, node in uris.items()}
    return {name: pid for name, pid in pids.items() if pid}


def soak(hours, table):
    """Soak for so long; return the exit code. table: a file for the samples, or None."""
    samples = []
    with contextlib.ExitStack() as stack:
        home = stack.enter_context(tempfile.TemporaryDirectory())
        the_hosts = stack.enter_context(hosts.Hosts(home, 0))
        os.environ.update(the_hosts.robot_environment)
        uri = the_hosts.robot_environment["ROS_MASTER_URI"]
        for command in commands():
            stack.enter_context(Program(*command, DISPLAY=""))
            wait_for(lambda: call(uri, "getPid")[1], "master", STARTS_S)
        wait_for(lambda: set(node_pids(uri)) >= NODES, "nodes", STARTS_S)
        pids, began = node_pids(uri), time.monotonic()
        with contextlib.suppress(KeyboardInterrupt):
            while time.monotonic() - began < hours * 3600:
                now = time.monotonic() - began
                samples += filter(None, [sample(now, *one) for one in pids.items()])
                time.sleep(PERIOD_S)
    lines, is_bad = findings(samples)
    print("\n".join(lines))
    if table:
        csv.writer(table).writerows([Sample._fields, *samples])
    return int(is_bad)
