"""C1: a devel folder, whole or not, over this suite or not; names that hide the underlay."""

from types import SimpleNamespace

import pytest

from tutorial_check.exercises.underlay import workspace
from tutorial_check.model import Wrong
from tutorial_check.workspace import Layout, Package


@pytest.fixture
def session(tmp_path):
    """A workspace whose devel folder is still empty, and the underlay of this copy of the suite."""
    for folder in ("ws/src", "ws/devel", "this/lower/devel", "other/lower/devel"):
        (tmp_path / folder).mkdir(parents=True)
    underlay = tmp_path / "this/lower/devel/setup.bash"
    root = tmp_path / "ws"
    return SimpleNamespace(
        layout=Layout(root, root / "src", True), underlay=str(underlay), packages=[]
    )


def build(session, *below):
    """What catkin_make writes, as far as C1 reads it."""
    devel = session.layout.root / "devel"
    paths = ";".join(map(str, below))
    (devel / "_setup_util.py").write_text(f"    CMAKE_PREFIX_PATH = r'{paths}'.split(';')\n")
    (devel / "setup.sh").write_text(f": ${{_CATKIN_SETUP_DIR:={devel}}}\n")
    (devel / "setup.bash").write_text("# as catkin has it\n")
    return devel


def test_over_this_suite(session, tmp_path):
    build(session, tmp_path / "this/lower/devel")
    assert "on top of this suite" in workspace(session)


def test_over_another_copy_of_the_suite(session, tmp_path):
    other = tmp_path / "other/lower/devel"
    devel = session.layout.root / "devel"
    build(session, devel, other)
    with pytest.raises(Wrong) as wrong:
        workspace(session)
    assert f"another copy of the suite, {other};" in wrong.value.seen
    assert str(devel) not in wrong.value.seen


def test_over_nothing_of_a_suite(session):
    build(session, session.layout.root / "devel", "/opt/ros/noetic")
    with pytest.raises(Wrong) as wrong:
        workspace(session)
    assert wrong.value.seen == "devel was built over /opt/ros/noetic"
    assert "without ./tutorial shell" in wrong.value.hint


@pytest.mark.parametrize("gone", ["setup.bash", "_setup_util.py", "setup.sh"])
def test_not_whole(session, tmp_path, gone):
    devel = build(session, tmp_path / "this/lower/devel")
    (devel / gone).unlink()
    (devel / "setup.bash").touch()
    with pytest.raises(Wrong) as wrong:
        workspace(session)
    assert "not whole" in wrong.value.seen
    assert gone in wrong.value.seen
    assert wrong.value.hint == "in the workspace: rm -r build devel, then catkin_make"


@pytest.mark.parametrize(
    ("name", "whose"),
    [("gamepad", "suite"), ("std_msgs", "ROS"), ("joy", ""), ("rbx1_nav", ""), ("my_robot", "")],
)
def test_names_that_hide_what_the_exercises_stand_on(session, tmp_path, name, whose):
    for each in ("gamepad", "joy", "rbx1_nav"):
        (tmp_path / "this/lower/devel/share" / each).mkdir(parents=True)
    session.packages = [Package(tmp_path / "ws/src/old" / name, f"old/{name}", name)]
    if not whose:
        assert "never built" in workspace(session).seen
        return
    with pytest.raises(Wrong) as wrong:
        workspace(session)
    assert wrong.value.where == f"src/old/{name}"
    assert f"{whose}'s own" in wrong.value.seen
    assert "remove it from src" in wrong.value.hint
