"""common/doc/FROM_STICK_TO_WHEEL.md names the modules that a Joy passes, in their order."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "common/doc/FROM_STICK_TO_WHEEL.md"
# The legs of the way, in their order; each ends with its node.
LEGS = ("gamepad.", "joy_to_twist.", "fake_turtlebot_sim.mux.", "fake_turtlebot_sim.simulator.")
ROWS = re.findall(
    r"^\| (\d+) \| `([\w.]+)` \| (.+) \| \[(.+)\]\((.+)\) \|$", PAGE.read_text(), re.M
)
MODULES = [module for _, module, *_ in ROWS]


def test_the_rows_are_numbered_and_none_is_malformed():
    assert [int(number) for number, *_ in ROWS] == list(range(1, len(ROWS) + 1))
    assert len(re.findall(r"^\| \d", PAGE.read_text(), re.M)) == len(ROWS)


@pytest.mark.parametrize("row", ROWS, ids=MODULES)
def test_a_module_exists_and_has_its_file_and_idea(row):
    _, module, idea, name, link = row
    path = (PAGE.parent / link).resolve(strict=True)
    assert path.as_posix().endswith(f"/src/{module.replace('.', '/')}.py")
    assert (name, bool(idea.strip())) == (path.name, True)


def test_the_legs_follow_each_other_and_end_with_their_nodes():
    legs = [[m for m in MODULES if m.startswith(leg)] for leg in LEGS]
    assert [m for m in MODULES if m.startswith(LEGS)] == [m for leg in legs for m in leg]
    assert all(leg[-1].endswith(".node") for leg in legs)
