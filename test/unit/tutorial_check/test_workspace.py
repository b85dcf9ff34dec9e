"""Finding, unpacking and copying what a student hands in."""

import os
import re
import subprocess
import sys
import zipfile

import pytest

from tutorial_check import workspace
from tutorial_check.exercises.driving import displayed
from tutorial_check.model import CannotCheck
from tutorial_check.probing import numbered_joys
from tutorial_check.workspace import hand_in

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


def test_only_what_lies_right_beside_src_is_beside_it(tmp_path):
    for folder in ("ws/src/a", "ws/b", "ws/course/anna/c"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "package.xml").write_text(
            f"<package><name>{folder[-1]}</name></package>"
        )
    root = tmp_path / "ws"
    layout = workspace.Layout(root, root / "src", True)
    assert [each.inside for each in workspace.packages_beside(layout)] == ["b"]
    assert workspace.packages_beside(workspace.Layout(root, root, False)) == []


LINKS = {
    # a link in src/joy2twist, and what it leads to; "sub": the folder above is a link
    "file": "../../../secret",
    "absolute": "{0}/secret",
    "system": "/etc/passwd",
    "another student": "{0}/bob/src/joy2twist",
    "beside": "{0}/ada_too/secret",
    "to itself": "link",
}


@pytest.mark.parametrize("target", LINKS.values(), ids=LINKS)
def test_of_others_no_link_leads_out_of_what_they_handed_in(tmp_path, target):
    """Whatever the rights of the one who checks them."""
    package(tmp_path / "bob/src/joy2twist")
    for name in ("secret", "ada_too/secret"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("secret")
    own = package(tmp_path / "ada/src/joy2twist")
    (own / "link").symlink_to(target.format(tmp_path))
    (own / "inside").symlink_to("../../src/joy2twist/package.xml")
    layout, inside = hand_in(tmp_path / "ada", tmp_path / "scratch")
    copied = workspace.copy(layout, tmp_path / "copy", inside)
    assert sorted(path.name for path in (copied / "joy2twist").iterdir()) == [
        "inside",
        "package.xml",
    ]
    assert not (copied / "joy2twist/inside").is_symlink()


@pytest.mark.parametrize("link", ["src", "src/joy2twist", "src/joy2twist/scripts"])
def test_nor_does_a_folder_that_is_a_link(tmp_path, link):
    (package(tmp_path / "bob/src/joy2twist") / "scripts").mkdir()
    (tmp_path / "bob/src/joy2twist/scripts/joy2twist.py").touch()
    (tmp_path / "ada" / link).parent.mkdir(parents=True)
    (tmp_path / "ada" / link).symlink_to(tmp_path / "bob" / link)
    layout, inside = hand_in(tmp_path / "ada", tmp_path / "scratch")
    copied = workspace.copy(layout, tmp_path / "copy", inside)
    assert not [path for path in copied.rglob("*") if path.is_file()]
    of_ones_own = workspace.copy(layout, tmp_path / "another")
    assert list(of_ones_own.rglob("joy2twist.py"))


@pytest.mark.parametrize("file", ["package.xml", "scripts/joy2twist.py"])
def test_what_is_no_file_and_never_ends_is_left_out(tmp_path, file):
    own = package(tmp_path / "ada/src/joy2twist")
    (own / "scripts").mkdir()
    (own / file).unlink(missing_ok=True)
    os.mkfifo(own / file)
    layout, inside = hand_in(tmp_path / "ada", tmp_path / "scratch")
    copied = workspace.copy(layout, tmp_path / "copy", inside)
    assert not (copied / "joy2twist" / file).exists()
    assert len(workspace.packages_below(layout.root)) == (file != "package.xml")


@pytest.mark.parametrize("file", ["_setup_util.py", "setup.sh"])
def test_a_devel_folder_with_a_pipe_is_none(tmp_path, file):
    for name in ("_setup_util.py", "setup.sh"):
        os.mkfifo(tmp_path / name) if name == file else (tmp_path / name).touch()
    assert workspace.underlays(tmp_path) is None


def test_rights_of_more_than_its_owner_are_not_copied(tmp_path):
    """A program of root's that everybody may run as root would be one after the copy, too."""
    file = package(tmp_path / "src" / "joy2twist") / "tool"
    file.touch()
    file.chmod(0o4755)
    copied = workspace.copy(workspace.find_layout(tmp_path), tmp_path / "copy")
    assert (copied / "joy2twist/tool").stat().st_mode & 0o7777 == 0o755


@pytest.mark.parametrize(
    "pack", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_LZMA, zipfile.ZIP_BZIP2]
)
def test_a_zip_with_broken_bytes(tmp_path, pack):
    archive = tmp_path / "a.zip"
    with zipfile.ZipFile(archive, "w", pack) as opened:
        opened.writestr("package.xml", XML * 20)
    data = bytearray(archive.read_bytes())
    data[60:100] = b"\xff" * 40
    archive.write_bytes(data)
    with pytest.raises(CannotCheck, match=r"a\.zip: cannot be unpacked: "):
        workspace.unpack(archive, tmp_path / "out")


READ = """
import sys
from pathlib import Path
from tutorial_check import session, workspace
print(workspace.named_outside(Path(sys.argv[1])), session.NEEDS_BUILD.search(sys.stdin.read()))
"""


@pytest.mark.parametrize("text", ["=/", "/a", ".bag/", "\n"])
def test_a_launch_file_or_cmakelists_of_any_text_is_read_at_once(tmp_path, text):
    """Not in the square of its length, which takes minutes."""
    text *= 99_999
    (tmp_path / "a.launch").write_text(text)
    read = [sys.executable, "-c", READ, str(tmp_path)]
    assert subprocess.check_output(read, input=text, text=True, timeout=30) == "[] None\n"
