"""Submissions without programs, for the unit tests of the checker and of courses."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

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
    return Order(tmp_path, "", ("2",), folder=tmp_path, layout=layout)
