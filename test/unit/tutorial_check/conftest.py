"""What the tests of check share: a session of a package."""

from types import SimpleNamespace

import pytest

from tutorial_check.handout.task import JoystickTask
from tutorial_check.order import Order
from tutorial_check.record.ground import Ground


@pytest.fixture
def make_session(tmp_path):
    """make_session(package, exercise): a Ground of a workspace with that package, still empty."""

    def make(package, exercise):
        folder = tmp_path / "ws/src" / package
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{package}</name></package>")
        runner = SimpleNamespace(environment={"PATH": ""})
        return Ground(
            tmp_path,
            None,
            [exercise],
            runner,
            underlay="",
            can_have_devices=False,
            task=JoystickTask({}),
        )

    return make


@pytest.fixture
def order(tmp_path):
    """An Order of an empty workspace."""
    return Order(
        folder=str(tmp_path), root=str(tmp_path), source=str(tmp_path / "src"), is_workspace=True,
        own=True, exercises=("2",), only_first=False, course="", variant={}, underlay="",
        environment={}, kept=(), shown=(), number=1, apart=False,
    )  # fmt: skip
