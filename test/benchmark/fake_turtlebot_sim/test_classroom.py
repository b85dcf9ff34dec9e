"""A classroom on one machine: 30 robots, 10 of them driven by the recording, all topics heard.

Messages a second and processor time, with student.launch and with bare relays in its place.
"""

import json
import os
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from threading import Timer
from xmlrpc.client import ServerProxy

import pytest
from live import FAKE_TURTLEBOT, HERE, lost_periods, master, processor_time, running, topics_of

ROBOTS = 30
DRIVEN = [f"robot_{number}" for number in range(1, 11)]
SECONDS = 20
START_S = 120  # for all programs, on a busy machine
BAG = HERE.parents[2] / "joy2twist" / "bag" / "joy.bag"
BARE_RELAY = HERE.parent / "joy2twist" / "bare_relay.py"
TOPICS = topics_of(ROBOTS, "odom", "joint_states")
TOPICS += [f"/{name}/{topic}" for name in DRIVEN for topic in ("joy", "cmd_vel")]
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@pytest.fixture(scope="module", autouse=True)
def ros_master():
    with master():
        # As the first roslaunch sets it; ten at once would quarrel about who is the first.
        ServerProxy(os.environ["ROS_MASTER_URI"]).setParam("/classroom", "/run_id", "classroom")
        yield


def student(stack, name):
    """Start what one student starts; returns a function for the ids of: joy2twist, and all."""
    arguments = [f"name:={name}", f"bag:={BAG}", "loop:=true", "rviz:=false"]
    command = ["roslaunch", "joy2twist", "student.launch", *arguments]
    launch = stack.enter_context(running(command, **QUIET))

    def ids():
        children = Path(f"/proc/{launch.pid}/task/{launch.pid}/children").read_text().split()
        relay = [
            pid for pid in children if "joy2twist.py" in Path(f"/proc/{pid}/cmdline").read_text()
        ]
        return relay, [launch.pid]

    return ids


def bare(stack, name):
    """The same with the least that rospy can do, and without roslaunch."""
    options = {**QUIET, "env": {**os.environ, "ROS_NAMESPACE": f"/{name}"}}
    play = ["rosrun", "rosbag", "play", "-q", "--loop", "--wait-for-subscribers"]
    relay = stack.enter_context(running([str(BARE_RELAY)], **options))
    player = stack.enter_context(running([*play, str(BAG), "/joy:=joy"], **options))
    return lambda: ([relay.pid], [relay.pid, player.pid])


def measure(driver):
    """(what was heard, processor time [s/s] of: the simulator, one relay, all of one driver)."""
    with ExitStack() as stack:
        simulator = stack.enter_context(running([*FAKE_TURTLEBOT, f"_robots:={ROBOTS}"]))
        drivers = [driver(stack, name) for name in DRIVEN]
        observer = [sys.executable, str(HERE / "observer.py"), str(SECONDS), *TOPICS]
        watcher = stack.enter_context(
            running(observer, stdout=subprocess.PIPE, universal_newlines=True)
        )
        too_late = Timer(START_S, watcher.kill)
        stack.callback(too_late.cancel)
        too_late.start()
        assert watcher.stdout.readline().strip() == "ready"
        too_late.cancel()
        relays = [pid for ids in drivers for pid in ids()[0]]
        whole = [pid for ids in drivers for pid in ids()[1]]
        assert len(relays) == len(DRIVEN)

        def used():
            of_relays, of_all = (sum(map(processor_time, pids)) for pids in (relays, whole))
            return processor_time(simulator.pid), of_relays / len(DRIVEN), of_all / len(DRIVEN)

        began_s, before = time.monotonic(), used()
        heard = json.loads(watcher.stdout.readline())
        took_s = time.monotonic() - began_s
        return heard, [(after - each) / took_s for after, each in zip(used(), before)]


def test_a_classroom(figure):
    _, (_, bare_relay, _) = measure(bare)
    heard, (simulator, relay, whole) = measure(student)
    rate = sum(len(record["arrivals"]) for record in heard.values()) / SECONDS
    lost = sum(lost_periods(heard[topic]) for topic in topics_of(ROBOTS, "odom"))
    figure(
        f"classroom: {ROBOTS} robots, {len(DRIVEN)} of them driven",
        f"{rate:,.0f} messages/s, {lost} periods lost",
        "0",
    )
    figure(
        "processor time: simulator; a driver; its joy2twist / a bare relay",
        f"{simulator:.0%}; {whole:.1%}; {relay:.1%} / {bare_relay:.1%} = {relay / bare_relay:.2f}",
        "ratio ≤ 1.5",
    )
    assert lost == 0
    assert relay <= 1.5 * bare_relay
