"""./tutorial test faults --soak: the recording and a classroom without faults, and what grows."""

import contextlib
import csv
import os
import tempfile
import time

import rospkg

from node_kit.questions import call
from tutorial_faults.live import hosts
from tutorial_faults.live.samples import Sample, complaints, growth, sample
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ROBOTS, STUDENTS = 10, (1, 2)
PERIOD_S = 10.0
STARTS_S = 600.0  # for all to start, on a busy machine
# All nodes but the cockpit, whose name differs.
NODES = {
    "/classroom", "/fake_turtlebot", "/myjoystick2twist", "/robot_state_publisher", "/rosbag",
    "/rosout", *(f"/robot_{n}/{name}" for n in STUDENTS for name in ("myjoystick2twist", "rosbag")),
}  # fmt: skip


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
    for node in sorted({one.node for one in samples}):
        *_, last = [one for one in samples if one.node == node]
        grown = growth(samples, node)
        more = "" if grown is None else f"; grew by {grown[0]} kB, {grown[1]}, {grown[2]}"
        print(f"{node}: {last.memory_kb} kB, {last.threads} threads, {last.files} files{more}")
    if table:
        csv.writer(table).writerows([Sample._fields, *samples])
    lines = complaints(samples)
    print("\n".join(lines or ["nothing grew"]))
    return int(bool(lines))
