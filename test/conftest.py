"""The libraries of all packages, for tests that run outside of a workspace, too."""

import os
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
FOLDERS = (
    *("*/src", "common", "common/*/src", "common/stand_ins/*/src"),
    *("test/faults", "test/exercises", "test/ros2", "test/benchmark/fake_turtlebot_sim"),
)
sys.path[:0] = [str(folder) for pattern in FOLDERS for folder in REPOSITORY.glob(pattern)]
os.environ["TURTLEBOT_SIMULATION"] = "true"  # no test drives a robot that is plugged in here
# The longest of ros and system begin first, as many as run at once; the others run beside them.
LONGEST = (
    "test_shared_clone", "test_other_programs", "test_handout", "starts.py", "test_cockpit",
    "lost_nodes", "[A classroom", "[5. Launch", "ends.py", "keys.py", "joystick_driver",
)  # fmt: skip


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: [words in item.nodeid for words in LONGEST], reverse=True)
