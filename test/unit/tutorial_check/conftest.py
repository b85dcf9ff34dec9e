"""What the tests of check share: a session of a package."""

import os
import shutil
from types import SimpleNamespace

import pytest
import stored

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
        folder=str(tmp_path), root=str(tmp_path), source=str(tmp_path / "src"), place="",
        is_workspace=True, own=True, exercises=("2",), only_first=False, course="", variant={},
        underlay="", environment={}, kept=(), shown=(), apart=False,
    )  # fmt: skip


@pytest.fixture
def literal(tmp_path):
    """A workspace with a literal solution of the handout; its src."""
    src = shutil.copytree(stored.FOLDER.parent / "literal", tmp_path / "ws" / "src")
    shutil.copytree(stored.REPOSITORY / "joy2twist" / "bag", src / "joy2twist" / "bag")
    return src


@pytest.fixture
def examined(request, tmp_path):
    """examined(workspace, exercises, ...): the Outcomes, judged from what is stored."""
    folder = tmp_path / "judged"
    folder.mkdir()
    underlay = os.environ["TUTORIAL_UNDERLAY"]

    def judged(workspace, exercises, **about):
        return stored.judged(request.node.name, workspace, underlay, exercises, folder, **about)

    return judged
