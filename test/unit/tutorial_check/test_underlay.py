"""C1: a devel folder, whole or not, over this suite or not."""

from types import SimpleNamespace

import pytest

from tutorial_check.handout.s2.underlay import workspace
from tutorial_check.model import Wrong
from tutorial_check.source.workspace import Layout

THIS, OTHER, MINE = "{0}/this/lower/devel", "{0}/other/lower/devel", "{0}/ws/devel"


@pytest.fixture
def session(tmp_path):
    """A workspace whose devel folder is still empty, and the underlay of this copy of the suite."""
    for folder in ("ws/src", "ws/devel", "this/lower/devel/share/joy", "other/lower/devel"):
        (tmp_path / folder).mkdir(parents=True)
    layout = Layout(tmp_path / "ws", tmp_path / "ws/src", True)
    underlay = str(tmp_path / "this/lower/devel/setup.bash")
    order = SimpleNamespace(underlay=underlay)
    return SimpleNamespace(layout=layout, order=order, packages=[])


def build(tmp_path, below):
    """What catkin_make writes, as far as C1 reads it."""
    devel = tmp_path / "ws/devel"
    (devel / "_setup_util.py").write_text(f"    CMAKE_PREFIX_PATH = r'{below}'.split(';')\n")
    (devel / "setup.sh").write_text(f": ${{_CATKIN_SETUP_DIR:={devel}}}\n")
    (devel / "setup.bash").write_text("# as catkin has it\n")


@pytest.mark.parametrize(
    ("below", "gone", "seen", "hint"),
    [
        (f"{MINE};{OTHER}", "", f"another copy of the suite, {OTHER};", ""),
        (f"{MINE};/opt/ros/one", "", "built over /opt/ros/one", "without ./tutorial shell"),
        (THIS, "setup.bash", "not whole", "rm -r build devel, then catkin_make"),
        (THIS, "_setup_util.py", "not whole", "rm -r build devel"),
    ],
)
def test_a_devel_folder_that_is_not_of_this_suite_or_not_whole_is_wrong(
    session, tmp_path, below, gone, seen, hint
):
    build(tmp_path, below.format(tmp_path))
    if gone:
        (tmp_path / "ws/devel" / gone).unlink()
        (tmp_path / "ws/devel/setup.bash").touch()
    with pytest.raises(Wrong) as wrong:
        workspace(session)
    assert seen.format(tmp_path) in wrong.value.seen and gone in wrong.value.seen
    assert hint in wrong.value.hint


def test_a_committed_devel_of_another_home_is_ignored_whole_or_not(session, tmp_path):
    build(tmp_path, THIS)
    (tmp_path / "ws/devel/setup.sh").write_text(": ${_CATKIN_SETUP_DIR:=/home/ada/ws/devel}\n")
    (tmp_path / "ws/devel/_setup_util.py").unlink()
    assert "made elsewhere (/home/ada/ws/devel)" in workspace(session).seen
