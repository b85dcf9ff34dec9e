"""Twenty clients of npm, of which one does not read: delays, losses, processor time.

ROSBRIDGE in the environment starts a rosbridge that you have built, and takes a port, such as
`roslaunch rosbridge_server rosbridge_websocket.launch address:=127.0.0.1`: it then serves as many
clients with the same topics, after the bridge has ended.
"""

import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
import roslaunch  # noqa: F401  fails here, not in a program, without ROS
from live import QUIET, master, processor_time, running

from tutorial_testing.claims import claim
from tutorial_testing.foxglove.clients import Clients
from tutorial_testing.npm import modules
from tutorial_testing.processes import free_port
from tutorial_testing.waiting import wait_for

CLIENTS, MEASURED_S, HZ = 20, 60, 50
STAMPS = "/stamps"
BASE = "/mobile_base/sensors"
TOPICS = ("/odom", "/tf", "/scan", "/joint_states", f"{BASE}/imu_data", f"{BASE}/core")
MOST_LATE_MS, MOST_RATIO = 50.0, 1.2
HERE = Path(__file__).parent


@pytest.fixture
def robot():
    """A TurtleBot in a room, and a node that publishes the time."""
    launch = ["roslaunch", "turtlebot_bringup", "minimal.launch", "world:=room"]
    with master(), running(launch, **QUIET), running([sys.executable, HERE / "stamps.py"], **QUIET):
        yield


@contextmanager
def serving(command, port):
    """Run a server; yield its process."""
    with running([*command, f"port:={port}"], **QUIET) as process:
        yield process


def used(process, seconds):
    """Return the processor time [s/s] of a process and its children meanwhile."""
    began_s, before_s = time.monotonic(), processor_time(process.pid)
    time.sleep(seconds)
    return (processor_time(process.pid) - before_s) / (time.monotonic() - began_s)


def beside_clients(process, port):
    """Return (processor time [s/s], reports of the clients that read)."""
    with Clients(f"ws://127.0.0.1:{port}") as clients:
        connected = [clients.connect(str(k)) for k in range(CLIENTS)]
        for client in connected:
            client.do("subscribe", topics=[STAMPS], then="delays")
            client.do("subscribe", topics=TOPICS, then="count")
        stuck, *readers = connected
        stuck.do("stopReading")
        for client in readers:  # all have subscribed, and all is connected
            wait_for(lambda client=client: client.next("report", "report")["numbers"], "stamps")
        share = used(process, MEASURED_S)
        return share, [client.next("report", "report") for client in readers]


def beside_rosbridge_clients(process, port):
    """Return (processor time [s/s], messages each second) of a rosbridge."""
    url = f"ws://127.0.0.1:{port}"
    command = ["node", HERE / "rosbridge_clients.mjs", url, modules(), str(CLIENTS)]
    with running([*command, STAMPS, *TOPICS], stdout=subprocess.PIPE, text=True) as clients:
        for line in clients.stdout:
            if int(line) > 0.9 * HZ * CLIENTS:
                break
        return used(process, MEASURED_S), clients.stdout


@claim("foxglove_bridge: 19 of 20 clients lose nothing while one does not read; 99 of 100 < 50 ms")
def test_one_client_that_does_not_read_costs_the_others_nothing(figure, robot):
    port = free_port()
    with serving(["roslaunch", "foxglove_bridge", "foxglove_bridge.launch"], port) as process:
        wait_for_port(port)
        share, reports = beside_clients(process, port)
    delays_ms = sorted(delay for report in reports for delay in report["delays_ms"])
    late_ms = delays_ms[int(0.99 * len(delays_ms))]
    median_ms = delays_ms[len(delays_ms) // 2]
    lost = sum(b - a - 1 for it in reports for a, b in zip(it["numbers"], it["numbers"][1:]))
    count = sum(report["count"] for report in reports)
    figure("messages to 19 clients", f"{count} in {MEASURED_S} s", "")
    figure("lost of those that are numbered", str(lost), "0")
    figure("publisher to client, median", f"{median_ms:.1f} ms", "")
    figure("publisher to client, 99 of 100", f"{late_ms:.1f} ms", f"< {MOST_LATE_MS:.0f} ms")
    figure("processor time beside 20 clients", f"{share:.1%}", "")
    command = os.environ.get("ROSBRIDGE")
    if command:
        port = free_port()
        with serving(command.split(), port) as process:
            wait_for_port(port)
            other, _ = beside_rosbridge_clients(process, port)
        figure("the same by rosbridge", f"{other:.1%}", "")
        figure("ratio", f"{share / other:.2f}", f"<= {MOST_RATIO}")
        assert share / other <= MOST_RATIO
    assert lost == 0 and late_ms < MOST_LATE_MS
    assert min(len(report["numbers"]) for report in reports) > 0.95 * HZ * MEASURED_S


def wait_for_port(port):
    """Wait until a server listens."""

    def is_listening():
        listening = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
        return f":{port:04X} 0" in listening

    wait_for(is_listening, f"port {port}", 60)
