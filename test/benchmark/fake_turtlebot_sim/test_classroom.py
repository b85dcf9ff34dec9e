"""A classroom: thirty robots, ten of them driven from a recording by students, all topics heard."""

import json
import os
import subprocess
import sys
import time
from contextlib import ExitStack
from threading import Timer
from xmlrpc.client import ServerProxy

import pytest
from live import FAKE_TURTLEBOT, HERE, lost_periods, master, processor_time, running, topics_of

ROBOTS = 30
DRIVEN = [f"robot_{number}" for number in range(1, 11)]
SECONDS = 20
START_S = 120  # for all programs, on a busy machine
BAG = HERE.parents[2] / "joy2twist" / "bag" / "joy.bag"
TOPICS = topics_of(ROBOTS, "odom", "joint_states")
TOPICS += [f"/{name}/{topic}" for name in DRIVEN for topic in ("joy", "cmd_vel")]
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@pytest.fixture(scope="module", autouse=True)
def ros_master():
    with master():
        # As the first roslaunch sets it; ten at once would quarrel about which is the first.
        ServerProxy(os.environ["ROS_MASTER_URI"]).setParam("/classroom", "/run_id", "classroom")
        yield


def student(name):
    """Return the command line that starts what one student starts."""
    arguments = [f"name:={name}", f"bag:={BAG}", "loop:=true", "rviz:=false"]
    return ["roslaunch", "joy2twist", "student.launch", *arguments]


def test_a_classroom(figure):
    with ExitStack() as stack:
        simulator = stack.enter_context(running([*FAKE_TURTLEBOT, f"_robots:={ROBOTS}"]))
        students = [stack.enter_context(running(student(name), **QUIET)) for name in DRIVEN]
        command = [sys.executable, str(HERE / "observer.py"), str(SECONDS), *TOPICS]
        observer = stack.enter_context(running(command, stdout=subprocess.PIPE, text=True))
        too_late = Timer(START_S, observer.kill)
        stack.callback(too_late.cancel)
        too_late.start()
        assert observer.stdout.readline().strip() == "ready"
        too_late.cancel()

        began_s, programs = time.monotonic(), (simulator, *students)
        before = [processor_time(one.pid) for one in programs]
        heard = json.loads(observer.stdout.readline())
        took_s = time.monotonic() - began_s
        used = [(processor_time(one.pid) - b) / took_s for one, b in zip(programs, before)]
    rate = sum(len(record["arrivals"]) for record in heard.values()) / SECONDS
    lost = sum(lost_periods(heard[topic]) for topic in topics_of(ROBOTS, "odom"))
    what = f"classroom: {ROBOTS} robots, {len(DRIVEN)} of them driven"
    figure(what, f"{rate:,.0f} messages/s, {lost} periods lost", "0")
    each = sum(used[1:]) / len(DRIVEN)
    figure("processor time: simulator; a student", f"{used[0]:.0%}; {each:.1%}", "")
    assert lost == 0
