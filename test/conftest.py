"""Settings of all tests: paths of the libraries, and markers from the tests' folders."""

import os
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

TESTS = Path(__file__).resolve().parent
FOLDERS = (
    *("*/src", "common", "common/*/src", "common/stand_ins/*/src", "test/support"),
    *("test/tutorial_check/exercises", "test/ros2_bridge/ros2"),
    "test/fake_turtlebot_sim/benchmark",
)
sys.path[:0] = [str(folder) for pattern in FOLDERS for folder in TESTS.parent.glob(pattern)]
os.environ["TURTLEBOT_SIMULATION"] = "true"  # no test drives a robot that is plugged in
if hasattr(pytest, "version_tuple"):  # pytest 7; Debian 11's older one runs only the unit tests
    names = ("benchmark_figures", "rostest_items", "system_fixtures")
    pytest_plugins = [f"tutorial_testing.{name}" for name in names]
# A slow machine is not a failure: hypothesis must ignore the clock.
settings.register_profile(
    "any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("any machine")


@pytest.hookimpl(tryfirst=True)  # before -m selects
def pytest_collection_modifyitems(items):
    """Mark each test with its kind, the folder below its package's; start long tests first."""
    for item in items:
        item.add_marker(Path(item.fspath).relative_to(TESTS).parts[1])
    items.sort(key=lambda item: item.get_closest_marker("long") is None)
