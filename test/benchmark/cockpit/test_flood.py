"""A driver beside viewers that flood: time of an input, memory of the server."""

import json
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import rospkg
from live import FAKE_TURTLEBOT, master, running

from tutorial_testing import flood as flood_program
from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import memory_kb
from tutorial_testing.waiting import wait_for

PROBE = str(Path(__file__).with_name("probe.py"))
ALONE = 1000  # inputs
FLOODERS, FLOOD_S, INPUTS_PER_S = 30, 60, 50
MOST_FLOODED_S, MOST_MORE_KB, LEAST_DRIVEN = 0.05, 20_000, 0.95
START_S = 90
READ = {"stdout": subprocess.PIPE, "text": True}


def start_robot(stack):
    """Start a robot and joy2twist; return once that hears a joystick."""
    config = f"{rospkg.RosPack().get_path('joy2twist')}/config/f710_d.yaml"
    subprocess.run(["rosparam", "load", config, "/NewJoy2Twist"], check=True)
    joy2twist = ["rosrun", "joy2twist", "joy2twist.py", "_arm_on_neutral:=true", "_log_rate:=0"]
    for command in (joy2twist, FAKE_TURTLEBOT):
        stack.enter_context(running(command))
    info = ["rostopic", "info", "/joy"]
    told = lambda: subprocess.run(info, check=False, capture_output=True).stdout  # noqa: E731
    wait_for(lambda: b"NewJoy2Twist" in told(), "joy2twist", START_S)


def start_cockpit(stack):
    """(process, port, tokens to look and to drive) of a cockpit that serves its page."""
    port = str(free_port())
    command = [node_path("cockpit", "cockpit.py"), "--port", port, "--lan"]
    process = stack.enter_context(running(command, **READ))
    lines = [process.stdout.readline() for _ in range(2)]
    return process, port, [line.partition("token=")[2].strip() for line in lines]


def drive(port, count, token):
    """Return (time that 99 of 100 inputs take at most [s], share of all that arrived)."""
    command = [sys.executable, PROBE, port, str(count), token]
    done = subprocess.run(command, check=True, timeout=300, **READ)
    took = sorted(json.loads(done.stdout))
    return took[int(0.99 * len(took))], len(took) / count


def test_the_driver_goes_on_beside_thirty_viewers_that_flood(figure):
    """All that the schema allows, as fast as the server takes it."""
    with ExitStack() as stack:
        stack.enter_context(master())
        start_robot(stack)
        server, port, (to_look, to_drive) = start_cockpit(stack)
        alone_s, _ = drive(port, ALONE, to_drive)
        before_kb = memory_kb(server.pid)
        command = [sys.executable, flood_program.__file__, port, to_look, str(FLOODERS)]
        flood = stack.enter_context(running([*command, str(FLOOD_S)], **READ))
        assert flood.stdout.readline() == "ready\n"
        flooded_s, driven = drive(port, FLOOD_S * INPUTS_PER_S, to_drive)
        during_kb = memory_kb(server.pid) - before_kb
        taken = json.loads(flood.stdout.readline())["sent"] / FLOOD_S
        wait_for(
            lambda: memory_kb(server.pid) - before_kb <= MOST_MORE_KB, "memory as before", START_S
        )
    what = (
        f"an input until /cmd_vel beside {FLOODERS} viewers that flood for {FLOOD_S} s, 99 of 100"
    )
    found = f"{1e3 * flooded_s:.1f} ms ({1e3 * alone_s:.1f} ms without them)"
    figure(what, found, f"<= {1e3 * MOST_FLOODED_S:.1f} ms")
    figure("velocities for inputs meanwhile", f"{driven:.1%}", f"> {LEAST_DRIVEN:.0%}")
    figure("messages taken", f"{taken:.0f}/s", "")
    most = f"<= {MOST_MORE_KB / 1000:.0f} MB afterwards"
    figure("memory of the server during the flood", f"{during_kb / 1000:+.1f} MB", most)
    assert flooded_s <= MOST_FLOODED_S
    assert driven > LEAST_DRIVEN
