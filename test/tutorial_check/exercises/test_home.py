"""A submission may be in the home folder, which programs do not see, and may be a link."""

import shutil
from pathlib import Path

import pytest
from edits import built, put
from solution import LAUNCH_BAG, TALKER, J

from tutorial_check.examining.examination import examine
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim

pytestmark = pytest.mark.skipif(
    not bubblewrap.granted().options, reason="no isolation here: nothing is hidden"
)


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A home folder that contains `literal`."""
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def verdicts(literal, underlay):
    """verdicts(exercise): {check: result}, none of which is wrong."""

    def judge(exercise, workspace=None):
        (outcome,) = examine(Order(workspace or literal.parent, underlay, [exercise]))
        assert {result.status for result in outcome.results} <= {"ok", "note"}, outcome.results
        return {result.id: result for result in outcome.results}

    return judge


def test_a_workspace_that_is_a_link_was_built_over_the_suite(literal, underlay, home, verdicts):
    (home / "catkin_ws").symlink_to(literal.parent)
    built(Path(underlay).parent)(home / "catkin_ws" / "src")
    assert "on top of this suite" in verdicts("2", home / "catkin_ws")["C1"].seen


@claim("A link out of what ...", because="end to end")
@pytest.mark.night
@pytest.mark.parametrize(("what", "exercise"), [("", "2"), (J, "4.3"), (TALKER, "3")])
def test_ones_own_links_are_followed(literal, home, verdicts, what, exercise):
    path = literal / what  # replaced by a link
    shutil.move(str(path.resolve()), str(home / path.name))
    path.symlink_to(home / path.name)
    verdicts(exercise)


@claim("A recording elsewhere is played by its whole path")
def test_a_recording_in_the_home_folder_is_played_by_its_whole_path(literal, home, verdicts):
    (home / "git").mkdir()
    shutil.move(str(literal / J / "bag"), str(home / "git" / "bag"))
    put(LAUNCH_BAG, "$(find joy2twist)/bag", f"{home}/git/bag")(literal)
    assert f"not in your package: {home}/git/bag/joy.bag" in verdicts("5")["C22"].seen
