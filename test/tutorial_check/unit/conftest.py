"""What the tests of check share: a session of a package."""

import os
from dataclasses import replace
from types import SimpleNamespace

import pytest
import stored
from edits import literal  # noqa: F401

from courses.handout.task import JoystickTask
from tutorial_check.recording.workspace import Workspace
from tutorial_check.submission.order import Order
from tutorial_check.submission.packages import Layout

MANIFEST = (
    "<package><name>{}</name><version>0.0.0</version><description>x</description>"
    "<maintainer email='s@u.example'>s</maintainer><license>x</license></package>"
)


@pytest.fixture
def make_submission(tmp_path, order):
    """make_submission(package, exercise): a Workspace with that package, still empty."""

    def make(package, exercise):
        folder = tmp_path / "ws/src" / package
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(MANIFEST.format(package))
        runner = SimpleNamespace(environment={"PATH": ""})
        return Workspace(replace(order, exercises=(exercise,)), JoystickTask({}), runner)

    return make


@pytest.fixture
def order(tmp_path):
    layout = Layout(tmp_path, tmp_path / "src", True)
    return Order(tmp_path, "", ("2",), course=tmp_path, folder=tmp_path, layout=layout)


@pytest.fixture
def examined(request, tmp_path):
    """examined(workspace, exercises, ...): the Outcomes, judged from what is stored."""
    folder = tmp_path / "judged"
    folder.mkdir()
    underlay = os.environ["TUTORIAL_UNDERLAY"]

    def judged(workspace, exercises, **about):
        return stored.judged(request.node.name, workspace, underlay, exercises, folder, **about)

    return judged
