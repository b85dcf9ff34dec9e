"""Twenty clients of npm, of which one does not read: delays, losses, processor time.

ROSBRIDGE in the environment starts a rosbridge that you have built, and takes a port, such as
`roslaunch rosbridge_server rosbridge_websocket.launch address:=127.0.0.1`: it then serves as many
clients that read with the same topics, after the bridge has ended. (One that does not read stops
rosbridge for all.)
"""

import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from statistics import median

import pytest
import rosgraph
from live import QUIET, master, processor_time, running

from tutorial_testing.claims import claim
from tutorial_testing.foxglove.clients import Clients
from tutorial_testing.npm import modules
from tutorial_testing.processes import free_port
from tutorial_testing.waiting import wait_for

CLIENTS, HZ = 20, 50
MEASURED_S, ALONE_S = 60, 10
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
        graph = rosgraph.Master("/benchmark")
        wait_for(lambda: {"/odom", STAMPS} <= set(dict(graph.getTopicTypes())), "robot")
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
        wait_for(lambda: set(TOPICS) <= set(connected[0].channels()), "channels")
        stuck, *readers = connected
        stuck.do("stopReading")
        for client in readers:  # all have subscribed, and all is connected
            wait_for(lambda client=client: client.next("report", "report")["numbers"], "stamps")
        share = used(process, MEASURED_S)
        return share, [client.next("report", "report") for client in readers]


def beside_rosbridge_clients(process, port):
    """Return (processor time [s/s], messages) of a rosbridge."""
    url = f"ws://127.0.0.1:{port}"
    command = ["node", HERE / "rosbridge_clients.mjs", url, modules(), str(CLIENTS - 1)]
    with running([*command, STAMPS, *TOPICS], stdout=subprocess.PIPE, text=True) as clients:
        for line in clients.stdout:
            if int(line) > HZ * CLIENTS * (len(TOPICS) - 1):
                break
        share = used(process, MEASURED_S)
        return share, sum(int(clients.stdout.readline()) for _ in range(MEASURED_S))


def late_ms(delays_ms):
    """Return the delay that 99 of 100 do not exceed."""
    return sorted(delays_ms)[int(0.99 * len(delays_ms))]


def alone_ms(port):
    """Return late_ms() of a single client."""
    with Clients(f"ws://127.0.0.1:{port}") as clients:
        client = clients.connect()
        client.do("subscribe", topics=[STAMPS], then="delays")
        time.sleep(ALONE_S)
        return late_ms(client.next("report", "report")["delays_ms"])


@claim("foxglove_bridge: 19 of 20 clients lose nothing while one does not read; 99 of 100 < 50 ms")
def test_one_client_that_does_not_read_costs_the_others_nothing(figure, robot):
    port = free_port()
    with serving(["roslaunch", "foxglove_bridge", "foxglove_bridge.launch"], port) as process:
        wait_for_port(port)
        usual_ms = alone_ms(port)
        share, reports = beside_clients(process, port)
    delays_ms = [delay for report in reports for delay in report["delays_ms"]]
    most_ms = max(MOST_LATE_MS, 2 * usual_ms)  # a busy machine adds as much for a single client
    lost = sum(b - a - 1 for it in reports for a, b in zip(it["numbers"], it["numbers"][1:]))
    count = sum(report["count"] for report in reports)
    figure("messages to 19 clients", f"{count} in {MEASURED_S} s", "")
    figure("lost of those that are numbered", str(lost), "0")
    figure("publisher to client, median", f"{median(delays_ms):.1f} ms", "")
    measured = f"{late_ms(delays_ms):.1f} ms ({usual_ms:.1f} ms to a single client)"
    figure("publisher to client, 99 of 100", measured, f"< {most_ms:.0f} ms")
    figure("processor time beside 20 clients", f"{share:.1%}", "")
    command = os.environ.get("ROSBRIDGE")
    if command:
        port = free_port()
        with serving(command.split(), port) as process:
            wait_for_port(port)
            other, count = beside_rosbridge_clients(process, port)
        figure("the same by rosbridge", f"{other:.1%}, {count} messages", "")
        figure("ratio", f"{share / other:.2f}", f"<= {MOST_RATIO}")
        assert share / other <= MOST_RATIO
    assert lost == 0 and late_ms(delays_ms) < most_ms
    assert min(len(report["numbers"]) for report in reports) > 0.95 * HZ * MEASURED_S


def wait_for_port(port):
    """Wait until a server listens."""

    def is_listening():
        listening = Path("/proc/net/tcp").read_text() + Path("/proc/net/tcp6").read_text()
        return f":{port:04X} 0" in listening

    wait_for(is_listening, f"port {port}", 60)
