"""./tutorial faults --soak: the recording and a classroom without faults, and what they need."""

import contextlib
import csv
import math
import os
import tempfile
import time

import rospkg

from node_kit.questions import call
from tutorial_faults.live import hosts
from tutorial_faults.live.samples import complaints, growth, sample
from tutorial_faults.live.talker import Talker
from tutorial_testing.processes import Program
from tutorial_testing.waiting import wait_for

ROBOTS = 10
PERIOD_S = 10.0
# All of them, but for the cockpit, whose name is its own.
NODES = frozenset(
    [
        "/classroom",
        "/fake_turtlebot",
        "/myjoystick2twist",
        "/robot_1/myjoystick2twist",
        "/robot_1/rosbag",
        "/robot_2/myjoystick2twist",
        "/robot_2/rosbag",
        "/robot_state_publisher",
        "/rosbag",
        "/rosout",
    ]
)
STARTS_S = 600.0  # for all to start, on a busy machine


class Soak:
    """What was measured."""

    def __init__(self):
        """Nothing yet."""
        self.samples, self.rates, self.laps = [], [], []

    def hear(self, line):
        """Take a line of soak_observer."""
        kind, *numbers = line.split()
        into = self.rates if kind == "rate" else self.laps
        into.append((time.monotonic(), *map(float, numbers)))

    def drift_m(self):
        """How far from where the first lap closed each one does, along the floor [m]."""
        if not self.laps:
            return []
        _, x, y, _ = self.laps[0]
        return [math.hypot(lap[1] - x, lap[2] - y) for lap in self.laps]


def programs():
    """The command lines: the recording's launch file, and a classroom with two students."""
    bag = os.path.join(rospkg.RosPack().get_path("joy2twist"), "bag", "joy.bag")
    yield "roslaunch", "joy2twist", "launch_bag.launch", "rviz:=false"
    yield "roslaunch", "--wait", "fake_turtlebot_sim", "classroom.launch", f"robots:={ROBOTS}"
    for number in (1, 2):
        yield (
            "roslaunch", "--wait", "joy2twist", "student.launch", f"name:=robot_{number}",
            "rviz:=false", f"bag:={bag}", "loop:=true",
        )  # fmt: skip


def node_pids(uri):
    """From each node's name to its process, as the master knows them."""
    state = call(uri, "getSystemState")[1] or []
    names = {name for kind in state for _, names in kind for name in names}
    uris = {name: call(uri, "lookupNode", name)[1] for name in names}
    pids = {name: node and call(node, "getPid")[1] for name, node in uris.items()}
    return {name: pid for name, pid in pids.items() if pid and "observer" not in name}


def soak(hours, picture):
    """Soak for so long; the exit code. picture: of the path of a file."""
    measured = Soak()
    with contextlib.ExitStack() as stack:
        home = os.path.join(stack.enter_context(tempfile.TemporaryDirectory()), "home")
        os.mkdir(home)
        the_hosts = stack.enter_context(hosts.Hosts(home, 0))
        environment = the_hosts.robot_environment
        os.environ.update(environment)
        uri = environment["ROS_MASTER_URI"]
        for command in programs():
            stack.enter_context(Program(*command, DISPLAY="", **environment))
        wait_for(lambda: call(uri, "getPid")[1], "master", STARTS_S)
        stack.enter_context(Talker("soak_observer", hear=measured.hear)).wait_ready()
        wait_for(lambda: set(node_pids(uri)) >= NODES, "nodes", STARTS_S)
        pids = node_pids(uri)
        began = time.monotonic()
        with contextlib.suppress(KeyboardInterrupt):
            while time.monotonic() - began < hours * 3600:
                now = time.monotonic() - began
                measured.samples += filter(None, [sample(now, *one) for one in pids.items()])
                _write(measured, picture)
                time.sleep(PERIOD_S)
    return _report(measured, began, picture)


def _write(measured, picture):
    with open(f"{picture}.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([measured.samples[0]._fields, *measured.samples])


def _report(measured, began, picture):
    for node in sorted({one.node for one in measured.samples}):
        grown = growth(measured.samples, node)
        last = [one for one in measured.samples if one.node == node][-1]
        more = "" if grown is None else f"; grew by {grown[0]} kB, {grown[1]}, {grown[2]}"
        print(f"{node}: {last.memory_kb} kB, {last.threads} threads, {last.files} files{more}")
    hertz = [odometry / seconds for _, seconds, odometry, _ in measured.rates]
    if hertz:
        print(f"/odom: {min(hertz):.2f} to {max(hertz):.2f} Hz")
    drift = measured.drift_m()
    print(f"{len(drift)} laps, each closes within {max(drift, default=0.0):.4f} m of the first")
    lines = complaints(measured.samples)
    print("\n".join(lines or ["nothing grew"]))
    draw(measured, began, picture)
    return int(bool(lines))


def draw(measured, began, picture):
    """Write the picture: memory of each node, rate of /odom, where each lap closes."""
    import matplotlib as mpl  # noqa: PLC0415  slow to load, and not needed before

    mpl.use("Agg")
    from matplotlib import pyplot  # noqa: PLC0415

    figure, (memory, rate, drift) = pyplot.subplots(3, 1, figsize=(9, 10), sharex=True)
    for node in sorted({one.node for one in measured.samples}):
        its = [one for one in measured.samples if one.node == node]
        memory.plot([o.at_s / 60 for o in its], [o.memory_kb / 1024 for o in its], label=node)
    memory.set_ylabel("resident memory [MB]")
    memory.legend(fontsize=6, ncol=2)
    rate.plot(
        [(at - began) / 60 for at, *_ in measured.rates], [n / s for _, s, n, _ in measured.rates]
    )
    rate.set_ylabel("/odom [Hz]")
    times = [(at - began) / 60 for at, *_ in measured.laps]
    drift.plot(times, [1000 * metres for metres in measured.drift_m()], ".-")
    drift.set_ylabel("where a lap closes,\nfrom the first [mm]")
    drift.set_xlabel("time [min]")
    figure.savefig(picture)
