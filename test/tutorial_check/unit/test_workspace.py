"""Finding, unpacking and copying what a student hands in."""

import os
import time
import zipfile
from pathlib import Path

import pytest

from tutorial_check.checking.manifest_errors import unreadable
from tutorial_check.errors import CannotCheck
from tutorial_check.submission import handed_in, packages, submission_files
from tutorial_check.submission.handed_in import copy, find_layout, hand_in, unpack
from tutorial_check.submission.packages import Layout, packages_below
from tutorial_testing.claims import claim

pytestmark = [
    claim(
        "A workspace is found any number of folders deep, but not below a home folder; of several, "
        "the one with the packages is named"
    ),
    claim("A zip, alone or in a folder, is unpacked with its rights, and no path leads outside"),
]
XML = """<package format="2"><name>{}</name><version>0.0.0</version><description>x</description>
<maintainer email="a@b.example">a</maintainer><license>x</license>
<depend>rospy</depend></package>"""


def package(folder, name="joy2twist"):
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(XML.format(name))
    return folder


def zipped(archive, files, pack=zipfile.ZIP_STORED):
    archive.parent.mkdir(exist_ok=True)
    with zipfile.ZipFile(archive, "w", pack) as opened:
        for name, text in files.items():
            opened.writestr(name, text)
    return archive


def copied(folder, tmp_path):
    return copy(find_layout(folder), tmp_path / "copy")


@pytest.mark.parametrize(
    "place", ["", "src/joy2twist", "joy2twist", "a/joy2twist", "ros/hydro/catkin_ws/src/joy2twist"]
)
def test_a_package_is_found_at_any_depth(tmp_path, place):
    package(tmp_path / "ws" / place)
    (tmp_path / "ws" / ".git").mkdir()
    found = packages_below(copied(tmp_path / "ws", tmp_path))
    assert [package.name for package in found] == ["joy2twist"]


def test_of_several_workspaces_the_one_with_the_package_is_named(tmp_path):
    (tmp_path / "src").mkdir()
    for place in ("lab1/src/blinky", "old/ws/src/joy", "z/ros/hydro/catkin_ws/src/joy2twist"):
        package(tmp_path / place, Path(place).name)
    found = find_layout(tmp_path)
    assert found.source == tmp_path / "z/ros/hydro/catkin_ws/src"
    assert found.place == "z/ros/hydro/catkin_ws, not lab1, not old/ws"


def test_a_home_folder_is_not_searched(tmp_path, monkeypatch):
    package(tmp_path / "course/anna/src/joy2twist")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert find_layout(tmp_path).root == tmp_path
    assert find_layout(tmp_path / "course").place == "anna"


def test_a_dangling_link_to_catkins_toplevel_file_is_left_to_catkin_make(tmp_path):
    package(tmp_path / "ws/src/joy2twist")
    (tmp_path / "ws/src/CMakeLists.txt").symlink_to("/opt/ros/none/toplevel.cmake")
    assert not os.path.lexists(copied(tmp_path / "ws", tmp_path) / "CMakeLists.txt")


@claim("The suite's own solutions are refused")
@pytest.mark.parametrize("given", ["suite", "suite/joy2twist", "ws"])
def test_the_suites_own_solutions_are_refused(tmp_path, given):
    """Also when linked into a workspace, as in those that the suite builds for itself."""
    package(tmp_path / "suite/joy2twist")
    package(tmp_path / "ws/src/mine")
    (tmp_path / "ws/src/joy2twist").symlink_to(tmp_path / "suite/joy2twist")
    layout = find_layout(tmp_path / given)
    with pytest.raises(CannotCheck, match=r"/joy2twist is this suite's solution, not yours"):
        handed_in.must_be_ones_own(layout, tmp_path / "suite")
    handed_in.must_be_ones_own(layout, tmp_path / "another_copy")


IN_ZIP = {"ws/src/joy2twist/package.xml": XML.format("joy2twist")}


@pytest.mark.parametrize("name", ["ada.zip", "Ada_1_file/MY WS.ZIP"])
def test_a_zip_alone_or_in_a_folder_is_handed_in(tmp_path, name):
    archive = zipped(tmp_path / name, IN_ZIP)
    (archive.parent / "remark.txt").touch()
    given = archive if archive.parent == tmp_path else archive.parent
    layout, inside = hand_in(given, tmp_path / "scratch")
    assert inside == tmp_path / "scratch/unpacked"
    assert layout.source == tmp_path / "scratch/unpacked/ws/src"


@pytest.mark.parametrize("beside", ["second.zip", "a/b/c/joy2twist/package.xml"])
def test_a_zip_beside_something_else_is_not_unpacked(tmp_path, beside):
    zipped(tmp_path / "ada/first.zip", IN_ZIP)
    (tmp_path / "ada" / beside).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / "ada" / beside).write_text(XML.format("joy2twist"))
    assert hand_in(tmp_path / "ada", tmp_path / "scratch")[1] == tmp_path / "ada"


@pytest.mark.parametrize("name", ["/evil.txt", "a/../../evil.txt", "..\\evil.txt"])
def test_a_zip_with_a_path_outside_is_refused(tmp_path, name):
    with pytest.raises(CannotCheck, match="outside"):
        unpack(zipped(tmp_path / "a.zip", {name: "x"}), tmp_path / "out")
    assert not (tmp_path / "evil.txt").exists()


def test_a_zip_with_backslashes_in_its_paths_is_unpacked(tmp_path):
    """An older PowerShell makes such files."""
    files = {"ws\\src\\joy2twist\\package.xml": XML.format("a"), "ws\\src\\joy2twist\\bag\\": ""}
    unpack(zipped(tmp_path / "a.zip", files), tmp_path / "out")
    packages = packages_below(tmp_path / "out/ws/src")
    assert [package.inside for package in packages] == ["joy2twist"]
    assert (tmp_path / "out/ws/src/joy2twist/bag").is_dir()


def test_rights_survive_a_zip_and_those_of_more_than_its_owner_no_copy(tmp_path):
    """Otherwise a copy of root's setuid program would be setuid, too."""
    rights = {"run.py": 0o755, "forgotten.py": 0o644}
    infos = {zipfile.ZipInfo(f"src/{name}"): "x" for name in rights}
    for info, mode in zip(infos, rights.values()):
        info.external_attr = mode << 16
    unpack(zipped(tmp_path / "a.zip", infos), tmp_path / "out")
    (tmp_path / "out/src/tool").touch()
    (tmp_path / "out/src/tool").chmod(0o4755)
    found = copied(tmp_path / "out", tmp_path)
    modes = {path.name: path.stat().st_mode & 0o7777 for path in found.iterdir()}
    assert modes == {**rights, "tool": 0o755}


PACKAGE, SCRIPT = "joy2twist/package.xml", "joy2twist/scripts/joy2twist.py"
J = "ada/src/joy2twist"
BOB = ("bob/src/joy2twist/package.xml", "bob/src/joy2twist/scripts/joy2twist.py", "ada_too/secret")


def make(folder, *entries):
    """Make files; "a -> b" is a link and "a |" a pipe."""
    for entry in entries:
        name, _, target = entry.partition(" -> ")
        path = folder / name.rstrip("| ")
        path.parent.mkdir(parents=True, exist_ok=True)
        if target:
            path.symlink_to(target.format(folder))
        else:
            os.mkfifo(path) if "|" in name else path.write_text(XML.format("joy2twist"))


@claim(
    "A link out of what others handed in is not followed; one's own is, also into the home folder"
)
@pytest.mark.parametrize(("entries", "of_others", "own"), [
    ([f"{J}/link -> ../../src"], [PACKAGE], [PACKAGE]),  # to a parent folder
    ([f"{J}/link -> link"], [PACKAGE], [PACKAGE]),
    ([f"{J}/in -> ../../src/{PACKAGE}"], ["joy2twist/in", PACKAGE], ["joy2twist/in", PACKAGE]),
    ([f"{J}/out -> {{}}/ada_too/secret"], [PACKAGE], ["joy2twist/out", PACKAGE]),
    ([f"{J}/scripts -> {{}}/bob/src/joy2twist/scripts"], [PACKAGE], [PACKAGE, SCRIPT]),
    (["ada/src/other -> {}/bob/src/joy2twist"], [PACKAGE],
     [PACKAGE, *(each.replace("joy2twist/", "other/", 1) for each in (PACKAGE, SCRIPT))]),
    ([f"{J}/pipe |"], [PACKAGE], [PACKAGE]),
])  # fmt: skip
def test_which_links_are_followed(tmp_path, entries, of_others, own):
    """Links that lead outside are followed only in one's own workspace."""
    make(tmp_path, f"{J}/package.xml", *BOB, *entries)
    layout, inside = hand_in(tmp_path / "ada", tmp_path / "scratch")
    for only, expected in ((inside, of_others), (None, own)):
        found = copy(layout, tmp_path / f"copy of {only is None}", only)
        every = [path for path in found.rglob("*") if not path.is_dir()]
        assert sorted(str(path.relative_to(found)) for path in every) == sorted(expected)
        assert not any(path.is_symlink() for path in every)


def test_a_src_that_is_a_link_or_a_manifest_that_is_a_pipe_is_not_read(tmp_path):
    make(tmp_path, *BOB, "ada/src -> {}/bob/src", "eve/src/joy2twist/package.xml |")
    layout, inside = hand_in(tmp_path / "ada", tmp_path / "scratch")
    assert not [*copy(layout, tmp_path / "copy", inside).iterdir()]
    assert packages_below(tmp_path / "eve") == []


@pytest.mark.parametrize("pack", [zipfile.ZIP_STORED, zipfile.ZIP_LZMA])
def test_a_zip_with_broken_bytes_is_one_line(tmp_path, pack):
    archive = zipped(tmp_path / "a.zip", {"package.xml": XML * 20}, pack)
    data = bytearray(archive.read_bytes())
    data[60:100] = b"\xff" * 40
    archive.write_bytes(data)
    with pytest.raises(CannotCheck, match=r"a\.zip: cannot be unpacked: "):
        unpack(archive, tmp_path / "out")


def test_a_workspace_that_is_too_large_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(handed_in, "MOST_BYTES", 10)
    package(tmp_path / "src" / "joy2twist")
    with pytest.raises(CannotCheck, match="more than"):
        copied(tmp_path, tmp_path)


@pytest.mark.parametrize("text", ["=/", "/a", ".bag/", "\n"])
def test_a_launch_file_or_cmakelists_of_any_text_is_read_at_once(tmp_path, text):
    """In linear time; quadratic time would take minutes."""
    (tmp_path / "a.launch").write_text(text * 99_999)
    began_s = time.process_time()
    assert handed_in.named_outside(tmp_path) == []
    assert not submission_files.NEEDS_BUILD.search(text * 99_999)
    assert time.process_time() - began_s < 60.0


@pytest.mark.parametrize(
    "reads", [find_layout, lambda top: copy(Layout(top, top), top.parent / "to")]
)
def test_folders_in_folders_without_end_are_one_line(tmp_path, reads):
    top = tmp_path / "handed_in"
    top.joinpath(*["d"] * (packages.MOST_DEPTH + 5)).mkdir(parents=True)
    with pytest.raises(CannotCheck, match="folders in folders") as caught:
        reads(top)
    assert str(caught.value).startswith(f"{top}:")


def test_a_manifest_that_nobody_wrote_is_called_too_large(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "package.xml").write_text("<package>" + " " * 2_000_000)
    [package] = packages_below(tmp_path)
    wrong = unreadable(package)
    assert (wrong.seen, wrong.where) == ("larger than 256 kB", "mine/package.xml")
    assert "catkin_create_pkg" in wrong.hint and "tag" not in wrong.hint
