"""Imports go one way: scripts -> node -> what it uses of ROS -> the pure core."""

import ast
from pathlib import Path

import pytest

SOURCES = Path(__file__).parents[3] / "joy2twist" / "src" / "joy_to_twist"
# Each module may import those above it. The pure ones know neither ROS nor the clock.
PURE = ["throttle", "newest_only", "parameters", "limits", "mapping", "gamepad_hints", "safety"]
PURE += ["teleoperation", "joystick.device_choice", "doctor.facts", "doctor.judgement"]
WITH_ROS = ["ending", "lean_joy", "velocity_publisher", "console", "ending", "start", "node"]
WITH_ROS += ["doctor.network", "doctor.collect", "doctor.program"]
ALLOWED_IN_PURE = {"dataclasses", "math", "select", "socket", "threading", "typing"}
ALLOWED_IN_PURE |= {"enum", "errno", "os"}  # os: the text of an errno


def imported(path):
    """The full names of all modules that a file imports."""
    for statement in ast.walk(ast.parse(path.read_text())):
        if isinstance(statement, ast.Import):
            yield from (alias.name for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom):
            yield statement.module


@pytest.mark.parametrize("module", PURE + WITH_ROS)
def test_imports(module):
    order = PURE + WITH_ROS
    own, others = [], set()
    for name in imported(SOURCES / f"{module.replace('.', '/')}.py"):
        if name.startswith("joy_to_twist."):
            own.append(name[len("joy_to_twist.") :])
        else:
            others.add(name.split(".")[0])
    assert all(order.index(name) < order.index(module) for name in own)
    if module in PURE:
        assert others <= ALLOWED_IN_PURE
        assert all(name in PURE for name in own)


@pytest.mark.parametrize(
    ("script", "module"), [("joy2twist", "node"), ("doctor", "doctor.program")]
)
def test_the_script_only_starts_its_program(script, module):
    script = SOURCES.parents[1] / "scripts" / f"{script}.py"
    assert set(imported(script)) <= {"signal", f"joy_to_twist.{module}"}
