"""The program that launch files start as mobile_base: the driver or the simulation."""

from __future__ import annotations

import argparse
import os
import sys
from typing import Iterable

import rosgraph

from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from kobuki_driver.choice import SIMULATION, USUAL_PORT, VARIABLE, BaseOptions, Choice, choose
from kobuki_driver.parameters import KobukiParameters
from node_kit.parameters.declaration import declared
from node_kit.ros.graph.ros_api import call
from node_kit.ros.lifecycle.announcement import full_name

NODE_NAME = "mobile_base"


def main() -> int:
    """Choose the driver or the simulation, and run it; return the exit code."""
    reader = argparse.ArgumentParser(allow_abbrev=False)
    reader.add_argument("--port", default="", help="serialport:= of the launch file")
    reader.add_argument("--simulation", default="", help="simulation:= of the launch file")
    given, rest = reader.parse_known_args(rosgraph.myargv(sys.argv)[1:])
    remaps = [word for word in sys.argv[1:] if ":=" in word]
    sys.argv[1:] = [*rest, *remaps]
    try:
        choice = _choice(given.port, given.simulation)
    except ValueError as error:
        print(f"{NODE_NAME}: {error}", file=sys.stderr)
        return 1
    print(f"{NODE_NAME}: {choice.line}", flush=True)
    return _drive(choice.port) if choice.port else _simulate()


def _choice(port: str, simulation: str) -> Choice:
    world = call(rosgraph.get_master_uri(), "getParam", _own("world"))[1]
    return choose(
        BaseOptions(
            port=port,
            simulation=simulation,
            world=str(world or ""),
            port_variable=os.environ.get(VARIABLE, ""),
            simulation_variable=os.environ.get(SIMULATION, ""),
            has_usual=os.path.exists(USUAL_PORT),
        )
    )


def _drive(port: str) -> int:
    from kobuki_driver.ros.kobuki_node import main as drive  # noqa: PLC0415 (needs python3-serial)

    _forget(set(declared(SimulatorParameters)) - set(declared(KobukiParameters)))
    sys.argv.append(f"_device_port:={port}")
    return drive()


def _simulate() -> int:
    from fake_turtlebot_sim.ros.fake_turtlebot_node import main as simulate  # noqa: PLC0415

    _forget(set(declared(KobukiParameters)) - set(declared(SimulatorParameters)))
    return simulate()


def _forget(names: Iterable[str]) -> None:
    """Delete the other program's parameters, which the node would report as unknown."""
    for name in names:
        call(rosgraph.get_master_uri(), "deleteParam", _own(name))


def _own(name: str) -> str:
    return f"{full_name(NODE_NAME)}/{name}"
