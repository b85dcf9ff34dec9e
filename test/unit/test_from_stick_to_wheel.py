"""common/doc/FROM_STICK_TO_WHEEL.md lists the modules that a Joy passes."""

import re
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "common/doc/FROM_STICK_TO_WHEEL.md"
TEXT = PAGE.read_text(encoding="utf-8")
FILES = [(PAGE.parent / link).resolve() for link in re.findall(r"\]\(([^)]+\.py)\)", TEXT)]
BESIDE = TEXT.split("Beside the way")[1]


@pytest.mark.parametrize(
    "folder",
    [
        "common/gamepad/src/gamepad/driver",
        "joy2twist/src/joy_to_twist",
        "fake_turtlebot_sim/src/fake_turtlebot_sim/mux",
        "fake_turtlebot_sim/src/fake_turtlebot_sim/simulator",
    ],
)
def test_no_module_of_the_way_is_left_out(folder):
    modules = {path for path in (REPOSITORY / folder).glob("*.py") if path.stem != "__init__"}
    assert not {path.stem for path in modules - set(FILES) if f"`{path.stem}`" not in BESIDE}
    assert f"{folder}/node.py" in {str(path.relative_to(REPOSITORY)) for path in FILES}
