#!/usr/bin/python3
"""Write the READMEs' tables of parameters from the dataclasses that declare them.

--check: compare only, with exit code 1 if a table is old. Run by test/lint.
"""

import importlib
import re
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
SOURCES = [
    "common/node_kit/src", "common/gamepad/src", "common/kobuki_protocol/src",
    "common/stand_ins/kobuki_node/src", "common/stand_ins/foxglove_bridge/src",
    "fake_turtlebot_sim/src", "joy2twist/src",
]  # fmt: skip
TABLES = [  # README, dataclass, prefix of each name
    ("joy2twist/README.md", "joy_to_twist.parameters.Parameters", "~"),
    (
        "fake_turtlebot_sim/README.md",
        "fake_turtlebot_sim.simulator.parameters.SimulatorParameters",
        "~",
    ),
    ("fake_turtlebot_sim/README.md", "fake_turtlebot_sim.mux.parameters.MuxParameters", "~"),
    ("fake_turtlebot_sim/README.md", "fake_turtlebot_sim.mux.parameters.Input", ""),
    ("fake_turtlebot_sim/README.md", "fake_turtlebot_sim.safety.parameters.SafetyParameters", "~"),
    (
        "common/doc/SERIAL_KOBUKI.md",
        "fake_turtlebot_sim.serial_kobuki.parameters.SerialKobukiParameters",
        "~",
    ),
    ("common/stand_ins/kobuki_node/README.md", "kobuki_driver.parameters.KobukiParameters", "~"),
    (
        "common/stand_ins/foxglove_bridge/README.md",
        "foxglove_bridge_server.parameters.BridgeParameters",
        "~",
    ),
    ("common/gamepad/README.md", "gamepad.driver.parameters.DriverParameters", "~"),
]


def main() -> int:
    """Compare or write each table; return the exit code."""
    sys.path[:0] = [str(REPOSITORY / folder) for folder in SOURCES]
    table = importlib.import_module("node_kit.parameters.declaration").table
    old = []
    for name, path, where in TABLES:
        module, _, kind = path.rpartition(".")
        new = table(getattr(importlib.import_module(module), kind), where)
        first = re.escape(new.splitlines()[2].split(" | ")[0])
        readme = REPOSITORY / name
        before = readme.read_text()
        after, count = re.subn(
            rf"(?m)^\|.*\n\|[-|]+\n{first} .*\n(\|.*\n)*", lambda _, new=new: new, before
        )
        assert count == 1, name
        if after != before:
            old.append(name)
            if "--check" not in sys.argv:
                readme.write_text(after)
    if "--check" not in sys.argv or not old:
        return 0
    print("tables of parameters are out of date; ./tutorial lint --fix renews:", *old)
    return 1


if __name__ == "__main__":
    sys.exit(main())
