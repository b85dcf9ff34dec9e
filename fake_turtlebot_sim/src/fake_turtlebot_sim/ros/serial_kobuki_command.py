"""The command serial_kobuki: a Kobuki on a pseudo terminal, for the driver of a real one.

Like any device it needs no master; while there is one, its node publishes the robot's true pose.
"""

from __future__ import annotations

import signal
import sys

from fake_turtlebot_sim.io.serial_kobuki.observer_process import ObserverProcess
from fake_turtlebot_sim.io.serial_kobuki.serial_kobuki import SerialKobuki
from fake_turtlebot_sim.serial_kobuki.parameters import NODE_NAME, parse_parameters
from node_kit.errors import StartError
from node_kit.ros.lifecycle.start import private_parameters
from node_kit.ros.log import Log


def show(lines: list[str]) -> None:
    """Print lines to the user."""
    for line in lines:
        print(f"{NODE_NAME}: {line}", flush=True)


def main() -> int:
    """Run until a signal or the observer asks it to exit; return the exit code."""
    log = Log()
    try:
        parameters = parse_parameters(private_parameters(NODE_NAME))
        device = SerialKobuki(
            parameters, ObserverProcess(sys.argv[1:]), lambda line: log.put(show, line)
        )
    except (StartError, ValueError) as error:
        print(f"{NODE_NAME}: {error}", file=sys.stderr)
        return 1

    def end(*_: object) -> None:
        device.is_ending = True

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, end)
    try:
        device.spin()
    finally:
        device.close()
    return 0
