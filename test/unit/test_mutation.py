"""What ./tutorial test mutation left: its score, and a reason for each change that nothing noticed.

Held without running it: results.json against explained.yaml and against the sources as they are.
"""

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
SURVIVOR = {"change": ["core/AddNot", 0], "was": "if a:", "becomes": "if not a:"}


def share(results):
    """How many of the changes to all modules were noticed [%]."""
    survivors = sum(len(found["survivors"]) for found in results.values())
    return 100.0 * (1 - survivors / sum(found["changes"] for found in results.values()))


def outdated(results):
    """The survivors whose line is not in the source any more."""
    return [
        one["was"]
        for name, found in results.items()
        for one in found["survivors"]
        if one["was"] not in map(str.strip, modules.path_of(name).read_text().splitlines())
    ]


def test_every_module_and_each_of_its_tests_is_there():
    for name in modules.names():
        assert modules.path_of(name).is_file()
        assert modules.tests_of(name)


def test_the_last_results_are_well():
    assert set(RESULTS) <= set(modules.names())
    assert explained.unexplained(RESULTS) == []
    assert explained.stale(RESULTS) == []
    assert share(RESULTS) >= LEAST_SHARE
    assert outdated(RESULTS) == []


@pytest.fixture
def reasons(tmp_path, monkeypatch):
    """explained.yaml with the text of the test's choice."""
    path = tmp_path / "explained.yaml"
    monkeypatch.setattr(explained, "EXPLAINED", path)
    return path.write_text


def test_a_survivor_without_a_reason_and_a_reason_without_a_survivor_are_found(reasons):
    results = {"node_kit.throttle": {"changes": 10, "survivors": [SURVIVOR]}}
    change = "node_kit.throttle: if a: -> if not a:"
    reasons("[]")
    assert explained.unexplained(results) == [change]
    reasons(f"- reason: it does not matter\n  changes: ['{change}']")
    assert explained.unexplained(results) == explained.stale(results) == []
    assert explained.stale({}) == [change]
    assert share(results) == 90.0
    assert outdated(results) == ["if a:"]


def test_one_change_has_one_reason(reasons):
    reasons("- {reason: one, changes: [a]}\n- {reason: another, changes: [a]}")
    with pytest.raises(ValueError, match="explained twice: a"):
        explained.reasons()
