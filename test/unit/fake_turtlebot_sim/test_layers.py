"""Imports go one way: scripts -> node -> topics, messages, parameters -> the pure core."""

import ast
from pathlib import Path

import pytest

import fake_turtlebot_sim

SOURCES = Path(fake_turtlebot_sim.__file__).parent
SCRIPTS = SOURCES.parents[1] / "scripts"

# Each module may import those above it. The pure ones know neither ROS nor the clock.
PURE = ["differential_drive", "velocity_command", "odometry_errors", "clock", "simulated_robot"]
PURE += ["parameters", "arbitration", "mux_parameters", "throttle"]
WITH_ROS = [
    "ending",
    "start",
    "ros_messages",
    "ros_clock",
    "prompt_publisher",
    "robot_topics",
    "diagnostics",
]
WITH_ROS += ["node", "mux_node", "bag_replay", "replay_command"]
ALLOWED_IN_PURE = {
    "dataclasses", "difflib", "enum", "math", "numpy", "random", "re", "typing"
}  # fmt: skip


def imports_of(path):
    """Return (modules of this package, other packages) that a file imports."""
    own, other = set(), set()
    for part in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(part, ast.Import):
            other |= {alias.name.split(".")[0] for alias in part.names}
        elif isinstance(part, ast.ImportFrom):
            package, _, module = part.module.partition(".")
            if package != "fake_turtlebot_sim":
                other.add(package)
            else:
                own |= {module} if module else {alias.name for alias in part.names}
    return own, other


def test_every_module_has_its_place():
    assert {path.stem for path in SOURCES.glob("*.py")} == {"__init__", *PURE, *WITH_ROS}


@pytest.mark.parametrize("module", PURE + WITH_ROS)
def test_a_module_imports_only_what_is_above_it(module):
    order = PURE + WITH_ROS
    own, other = imports_of(SOURCES / f"{module}.py")
    assert own <= set(order[: order.index(module)])
    if module in PURE:
        assert other <= ALLOWED_IN_PURE


@pytest.mark.parametrize("script", sorted(SCRIPTS.iterdir()), ids=lambda path: path.name)
def test_scripts_are_a_few_lines(script):
    own, _ = imports_of(script)
    assert own <= {"node", "mux_node", "replay_command"}
    assert len(script.read_text(encoding="utf-8").splitlines()) < 20


@pytest.mark.parametrize("node", ["node", "mux_node"])
def test_the_nodes_have_no_arithmetic(node):
    tree = ast.parse((SOURCES / f"{node}.py").read_text(encoding="utf-8"))
    assert not [part for part in ast.walk(tree) if isinstance(part, (ast.BinOp, ast.AugAssign))]


@pytest.mark.parametrize("module", PURE + WITH_ROS)
def test_a_file_is_read_in_five_minutes(module):
    assert len((SOURCES / f"{module}.py").read_text(encoding="utf-8").splitlines()) < 200
