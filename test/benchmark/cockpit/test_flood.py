"""A driver beside viewers that flood: how long an input takes."""

import subprocess
import sys
from contextlib import ExitStack

from live import FAKE_TURTLEBOT, JOY2TWIST, delays, master, running

from tutorial_testing import flood as flood_program
from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port

ALONE = 1000  # inputs
FLOODERS, FLOOD_S, INPUTS_PER_S = 30, 60, 50
MOST_FLOODED_S, LEAST_DRIVEN = 0.05, 0.95
READ = {"stdout": subprocess.PIPE, "text": True}


def start_cockpit(stack):
    """(port, tokens to look and to drive) of a cockpit that serves its page."""
    port = str(free_port())
    command = [node_path("cockpit", "cockpit.py"), "--port", port, "--lan"]
    process = stack.enter_context(running(command, **READ))
    lines = [process.stdout.readline() for _ in range(2)]
    return port, [line.partition("token=")[2].strip() for line in lines]


def test_the_driver_goes_on_beside_thirty_viewers_that_flood(figure):
    """All that the schema allows, as fast as the server takes it."""
    with ExitStack() as stack:
        stack.enter_context(master())
        for command in (JOY2TWIST, FAKE_TURTLEBOT):
            stack.enter_context(running(command))
        port, (to_look, to_drive) = start_cockpit(stack)
        page, count = f"page:{port}:{to_drive}", FLOOD_S * INPUTS_PER_S
        alone_s = delays(page, INPUTS_PER_S, ALONE)
        command = [sys.executable, flood_program.__file__, port, to_look, str(FLOODERS)]
        flood = stack.enter_context(running([*command, str(FLOOD_S)], **READ))
        assert flood.stdout.readline() == "ready\n"
        flooded_s = delays(page, INPUTS_PER_S, count)
    late_s, usual_s = (one[int(0.99 * len(one))] for one in (flooded_s, alone_s))
    driven = len(flooded_s) / count
    what = (
        f"an input until /cmd_vel beside {FLOODERS} viewers that flood for {FLOOD_S} s, 99 of 100"
    )
    found = f"{1e3 * late_s:.1f} ms ({1e3 * usual_s:.1f} ms without them)"
    figure(what, found, f"<= {1e3 * MOST_FLOODED_S:.1f} ms")
    figure("velocities for inputs meanwhile", f"{driven:.1%}", f"> {LEAST_DRIVEN:.0%}")
    assert late_s <= MOST_FLOODED_S
    assert driven > LEAST_DRIVEN
