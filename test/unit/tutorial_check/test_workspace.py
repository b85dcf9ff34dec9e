"""Finding, unpacking and copying what a student hands in."""

import re
import zipfile

import pytest

from tutorial_check import workspace
from tutorial_check.workspace import hand_in
from tutorial_check.exercises.driving import displayed
from tutorial_check.mapping import numbered_joys
from tutorial_check.model import CannotCheck

XML = """<package format="2"><name>{}</name><version>0.0.0</version><description>x</description>
<maintainer email="a@b.example">a</maintainer><license>x</license>
<depend>rospy</depend></package>"""


def package(folder, name="joy2twist"):
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(XML.format(name))
    return folder


@pytest.mark.parametrize(
    "place", ["src/joy2twist", "joy2twist", "ada/src/joy2twist", "ada/joy2twist"]
)
def test_a_workspace_is_found(tmp_path, place):
    package(tmp_path / place)
    layout = workspace.find_layout(tmp_path)
    copied = workspace.copy(layout, tmp_path / "copy")
    assert [each.name for each in workspace.packages_below(copied)] == ["joy2twist"]


@pytest.mark.parametrize("given", ["suite", "suite/joy2twist", "ws", "ws/src"])
def test_the_suites_own_solutions_are_nobodys(tmp_path, given):
    """Linked into a workspace as well, as those are that the suite builds for itself."""
    package(tmp_path / "suite/joy2twist")
    package(tmp_path / "ws/src/mine")
    (tmp_path / "ws/src/joy2twist").symlink_to(tmp_path / "suite/joy2twist")
    layout = workspace.find_layout(tmp_path / given)
    with pytest.raises(CannotCheck, match=r"/joy2twist is this suite's solution, not yours"):
        workspace.must_be_ones_own(layout, tmp_path / "suite")
    workspace.must_be_ones_own(layout, tmp_path / "another_copy")


@pytest.mark.parametrize("hidden", [".git", ".github", ".vscode"])
def test_a_workspace_in_a_repository_is_found(tmp_path, hidden):
    package(tmp_path / "catkin_ws/src/joy2twist")
    (tmp_path / hidden).mkdir()
    assert workspace.find_layout(tmp_path).source == tmp_path / "catkin_ws/src"


def zipped(archive, path="ws/src/joy2twist"):
    archive.parent.mkdir(exist_ok=True)
    with zipfile.ZipFile(archive, "w") as opened:
        opened.writestr(f"{path}/package.xml", XML.format("joy2twist"))
    return archive


@pytest.mark.parametrize("name", ["ada.zip", "Ada_1_file/my_ws.zip", "Ada_1_file/MY WS.ZIP"])
def test_a_zip_alone_or_in_a_folder_is_handed_in(tmp_path, name):
    given = archive = zipped(tmp_path / name)
    if archive.parent != tmp_path:
        (archive.parent / "remark.txt").touch()
        given = archive.parent
    layout, inside = hand_in(given, tmp_path / "scratch")
    assert inside == tmp_path / "scratch/unpacked"
    assert layout.source == tmp_path / "scratch/unpacked/ws/src"


@pytest.mark.parametrize("beside", ["second.zip", "src/", "a/b/c/joy2twist/package.xml"])
def test_a_zip_beside_something_else_is_not_unpacked(tmp_path, beside):
    folder = zipped(tmp_path / "ada" / "first.zip").parent
    if beside.endswith("/"):
        (folder / beside).mkdir()
    else:
        (folder / beside).parent.mkdir(parents=True, exist_ok=True)
        (folder / beside).write_text(XML.format("joy2twist"))
    assert hand_in(folder, tmp_path / "scratch")[0].root == folder
    assert not (tmp_path / "scratch").exists()


def test_a_link_to_a_zip_is_not_unpacked(tmp_path):
    (tmp_path / "ada").mkdir()
    (tmp_path / "ada" / "ws.zip").symlink_to(zipped(tmp_path / "another.zip"))
    assert hand_in(tmp_path / "ada", tmp_path / "scratch")[0].root == tmp_path / "ada"


def test_the_package_itself(tmp_path):
    package(tmp_path / "joy2twist")
    copied = workspace.copy(workspace.find_layout(tmp_path / "joy2twist"), tmp_path / "copy")
    assert (copied / "joy2twist" / "package.xml").exists()


def test_an_empty_folder_has_no_package(tmp_path):
    (tmp_path / "ws").mkdir()
    layout = workspace.find_layout(tmp_path / "ws")
    assert workspace.packages_below(workspace.copy(layout, tmp_path / "copy")) == []


def test_what_launch_files_name_by_whole_paths(tmp_path):
    kept, view = tmp_path / "joy.bag", tmp_path / "my.rviz"
    for path in (kept, view, tmp_path / "secret", tmp_path / "bag.old"):
        path.touch()
    launch = tmp_path / "src/joy2twist/launch"
    launch.mkdir(parents=True)
    (launch / "a.launch").write_text(
        f'<node args="--loop {kept} $(find x){view} {tmp_path}/none.bag {tmp_path}/secret"/>'
    )
    (launch / "b.launch").write_text(f"<node args='{view} {tmp_path}/bag.old'/>")
    assert workspace.named_outside(tmp_path / "src") == [str(kept), str(view)]


def test_broken_xml_has_a_reason(tmp_path):
    (package(tmp_path / "src" / "joy2twist") / "package.xml").write_text(
        "<package><name></package>"
    )
    (found,) = workspace.packages_below(tmp_path / "src")
    assert "mismatched tag" in found.error
    assert found.malformed


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('format="2"', 'format="4"', "format version '4'"),
        ('format="2"', 'format="two"', "'two'"),
        ('format="2"', 'format="1"', "tags: depend"),
        (
            '"2"><name>joy2twist</name>',
            '"3"><name>joy2twist</name><depend condition="$ROS_VERSION = 1">roscpp</depend>',
            "condition",
        ),
        ("<license>x</license>", "", "license"),
    ],
)
def test_xml_that_is_not_catkins_has_a_reason(tmp_path, old, new, reason):
    file = package(tmp_path / "src" / "mine") / "package.xml"
    text = XML.format("joy2twist")
    assert old in text
    file.write_text(text.replace(old, new))
    (found,) = workspace.packages_below(tmp_path / "src")
    assert re.search(reason, found.error)
    assert found.name == "joy2twist"
    assert not found.malformed


def test_a_link_to_a_folder_above_ends(tmp_path):
    package(tmp_path / "src" / "joy2twist")
    (tmp_path / "src" / "joy2twist" / "again").symlink_to(tmp_path / "src")
    copied = workspace.copy(workspace.find_layout(tmp_path), tmp_path / "copy")
    assert not (copied / "joy2twist" / "again" / "joy2twist" / "again" / "joy2twist").exists()


def test_a_dangling_link_is_left_out(tmp_path):
    (package(tmp_path / "src" / "joy2twist") / "gone").symlink_to(tmp_path / "nowhere")
    copied = workspace.copy(workspace.find_layout(tmp_path), tmp_path / "copy")
    assert (copied / "joy2twist" / "package.xml").exists()


def test_a_link_to_itself_is_left_out(tmp_path):
    (package(tmp_path / "src" / "joy2twist") / "bag").symlink_to("bag")
    copied = workspace.copy(workspace.find_layout(tmp_path), tmp_path / "copy")
    assert (copied / "joy2twist" / "package.xml").exists()
    assert not (copied / "joy2twist" / "bag").is_symlink()


@pytest.mark.parametrize("name", ["../evil.txt", "/evil.txt", "a/../../evil.txt", "..\\evil.txt"])
def test_a_zip_with_a_path_outside(tmp_path, name):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as opened:
        opened.writestr(name, "x")
    with pytest.raises(CannotCheck, match="outside"):
        workspace.unpack(tmp_path / "a.zip", tmp_path / "out")
    assert not (tmp_path / "evil.txt").exists()


def test_a_zip_of_an_older_powershell(tmp_path):
    """It has backslashes in its paths."""
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as opened:
        opened.writestr("ws\\src\\joy2twist\\package.xml", XML.format("joy2twist"))
        opened.writestr("ws\\src\\joy2twist\\bag\\", "")
    workspace.unpack(tmp_path / "a.zip", tmp_path / "out")
    layout = workspace.find_layout(tmp_path / "out")
    assert layout.source == tmp_path / "out/ws/src"
    assert [each.name for each in workspace.packages_below(layout.source)] == ["joy2twist"]
    assert (layout.source / "joy2twist/bag").is_dir()


def test_no_zip(tmp_path):
    (tmp_path / "a.zip").write_text("x")
    with pytest.raises(CannotCheck, match="cannot be unpacked"):
        workspace.unpack(tmp_path / "a.zip", tmp_path / "out")


def test_rights_survive_a_zip(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as opened:
        for name, mode in (("run.py", 0o755), ("forgotten.py", 0o644)):
            info = zipfile.ZipInfo(name)
            info.external_attr = mode << 16
            opened.writestr(info, "x")
    workspace.unpack(tmp_path / "a.zip", tmp_path / "out")
    assert (tmp_path / "out" / "run.py").stat().st_mode & 0o100
    assert not (tmp_path / "out" / "forgotten.py").stat().st_mode & 0o100


def test_too_large(tmp_path, monkeypatch):
    monkeypatch.setattr(workspace, "MOST_BYTES", 10)
    package(tmp_path / "src" / "joy2twist")
    with pytest.raises(CannotCheck, match="more than"):
        workspace.copy(workspace.find_layout(tmp_path), tmp_path / "copy")


@pytest.mark.parametrize(
    "shape",
    [
        "[{:.2f}, {:.2f},{:.2f},{:.2f},{:.2f},{:.2f}]",
        "{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} buttons 0 1",
    ],
)
def test_displayed(shape):
    joys = numbered_joys(20)
    lines = "\n".join(
        f"[INFO] [1700000000.1]: /listener: {shape.format(*axes)}" for axes, _ in joys[3:9]
    )
    assert displayed(joys, lines) == joys[3:9]
    assert displayed(joys, lines.replace(",", "\n").replace(" ", "\n")) == []
