"""The last run of ./tutorial test mutation: its score, and a reason for each survivor."""

import importlib.util
import json
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "mutation"


def loaded(name):
    """A file of the folder, which is no package."""
    spec = importlib.util.spec_from_file_location(f"mutation_{name}", FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


explained, modules = loaded("explained"), loaded("modules")
RESULTS = json.loads((FOLDER / "results.json").read_text())
LEAST_SHARE = 95.0  # [%]


def test_every_module_and_each_of_its_tests_is_there():
    for name in modules.names():
        assert modules.path_of(name).is_file()
        assert modules.tests_of(name)


def test_no_result_is_of_a_module_that_is_gone():
    assert set(RESULTS) <= set(modules.names())


def test_every_survivor_has_a_reason():
    assert explained.unexplained(RESULTS) == []


def test_every_reason_is_of_a_survivor():
    assert explained.stale(RESULTS) == []


@pytest.mark.parametrize("module", RESULTS)
def test_the_score(module):
    found = RESULTS[module]
    assert 100.0 * (1 - len(found["survivors"]) / found["changes"]) >= LEAST_SHARE


@pytest.mark.parametrize("module", RESULTS)
def test_a_survivor_is_of_a_line_that_is_still_there(module):
    lines = {line.strip() for line in modules.path_of(module).read_text().splitlines()}
    assert [one["was"] for one in RESULTS[module]["survivors"] if one["was"] not in lines] == []
