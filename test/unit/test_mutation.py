"""What ./tutorial test mutation changes is there, and each explanation stands once.

Its results are not kept here: a harmless edit must not fail a unit test.
"""

import importlib.util
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


def test_every_module_and_each_of_its_tests_is_there():
    for name in modules.names():
        assert modules.path_of(name).is_file()
        assert modules.tests_of(name)


def test_one_change_has_one_reason(tmp_path, monkeypatch):
    assert explained.reasons()
    monkeypatch.setattr(explained, "EXPLAINED", tmp_path / "explained.yaml")
    explained.EXPLAINED.write_text("- {reason: one, changes: [a]}\n- {reason: two, changes: [a]}")
    with pytest.raises(ValueError, match="explained twice: a"):
        explained.reasons()
