"""Fixtures of the checker's unit tests."""

import os

import pytest
import stored
from edits import literal, literal_cpp  # noqa: F401
from right_check import check  # noqa: F401

from tutorial_testing.submissions import make_submission, order  # noqa: F401


@pytest.fixture
def examined(request, tmp_path):
    """examined(workspace, exercises, ...): the Outcomes, judged from stored recordings."""
    folder = tmp_path / "judged"
    folder.mkdir()
    underlay = os.environ["TUTORIAL_UNDERLAY"]

    def judged(workspace, exercises, **about):
        return stored.judged(request.node.name, workspace, underlay, exercises, folder, **about)

    return judged
