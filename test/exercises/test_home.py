"""What is handed in may lie in the home folder, which is hidden before a program runs, and be a link."""

import shutil
import tempfile
from pathlib import Path

import pytest
from edits import LAUNCH_BAG, TALKER, B, J, put

from tutorial_check import bubblewrap
from tutorial_check.examination import examine

pytestmark = pytest.mark.skipif(
    not bubblewrap.granted().options, reason="no isolation here: nothing is hidden"
)


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A home folder, in which `literal` lies too."""
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


def away(path, home):
    """Move a file or folder into the home folder; a link stays in its place."""
    path = path.resolve()
    (home / "git").mkdir()
    shutil.move(str(path), str(home / "git" / path.name))
    path.symlink_to(home / "git" / path.name)


def verdicts(workspace, underlay, exercise="2", **options):
    """{check: result} of an exercise."""
    (outcome,) = examine(workspace, underlay, [exercise], **options)
    return {result.id: result for result in outcome.results}


def test_the_workspace_is_a_link(literal, underlay, home):
    (home / "catkin_ws").symlink_to(literal.parent)
    devel = literal.parent / "devel"
    devel.mkdir()
    (devel / "_setup_util.py").write_text(
        f"CMAKE_PREFIX_PATH = r'{Path(underlay).parent}'.split(';')\n"
    )
    (devel / "setup.sh").write_text(f": ${{_CATKIN_SETUP_DIR:={home}/catkin_ws/devel}}\n")
    (devel / "setup.bash").write_text("# as catkin has it\n")
    seen = verdicts(home / "catkin_ws", underlay)
    assert "on top of this suite" in seen["C1"].seen, seen["C1"]
    assert {result.status for result in seen.values()} <= {"ok", "note"}


@pytest.mark.parametrize(("what", "exercise"), [("", "2"), (J, "4.3"), (TALKER, "3")])
def test_links_of_ones_own(literal, underlay, home, what, exercise):
    """The whole src, a package, a file."""
    away(literal / what, home)
    seen = verdicts(literal.parent, underlay, exercise)
    assert {result.status for result in seen.values()} <= {"ok", "note"}, seen


def test_links_of_others(literal, underlay, home):
    """They lead not into the home folder of who checks, and it is said."""
    away(literal / B, home)
    seen = verdicts(literal.parent, underlay, own=False)["C2"]
    assert f"a link to {home}/git/{B}, and leads nowhere here" in seen.seen


def test_a_recording_in_the_home_folder(literal, underlay, home):
    """The student has it, and by a whole path it is played."""
    away(literal / "joy2twist/bag", home)
    (literal / "joy2twist/bag").unlink()
    put(LAUNCH_BAG, "$(find joy2twist)/bag", f"{home}/git/bag")(literal)
    seen = verdicts(literal.parent, underlay, "5")
    assert seen["C22"].status == "note"
    assert f"not in your package: {home}/git/bag/joy.bag" in seen["C22"].seen
    assert {result.status for result in seen.values()} <= {"ok", "note"}, seen


def test_no_program_meets_anothers_files_in_tmp(literal, underlay):
    with tempfile.NamedTemporaryFile(dir="/tmp") as left:
        left.write(b"of another student")
        left.flush()
        use = f"open('{left.name}', 'a').write('mine')\n    rospy.init_node"
        put(TALKER, "rospy.init_node", use)(literal)
        seen = verdicts(literal.parent, underlay, "3")
        assert {result.status for result in seen.values()} <= {"ok", "note"}, seen
        assert Path(left.name).read_bytes() == b"of another student"
