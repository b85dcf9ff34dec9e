"""A build is restored in another folder, and continued only if make notices all that changed."""

import json
import os
import shutil
import time

import pytest

from tutorial_check.data.recordings import Built
from tutorial_check.recording import build_tree
from tutorial_testing.claims import claim

pytestmark = claim("A build is reused only if nothing else could come out of a new one")
BUILT = Built(0, "[100%] Built target talker")


@pytest.fixture
def worker(tmp_path):
    """The folder of a worker that has built a package."""
    return make_worker(tmp_path / "tutorial_check_aaaaaaaa")


def make_worker(folder):
    files = {
        "src/p/CMakeLists.txt": "project(p)", "src/p/talker.cpp": "int main() {}",
        "src/p/p.h": "#pragma once", "src/p/setup.py": "", "src/p/msg/Num.msg": "int64 num",
        "src/p/talker.py": "#!/usr/bin/python3", "build/talker.o": f"\0{folder}/ws/src\0",
        "build/Makefile": f"all: {folder}/ws/build", "devel/setup.sh": "", "devel/lib/p/talker": "",
    }  # fmt: skip
    for name, text in files.items():
        path = folder / "ws" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def kept(worker, file, built=BUILT, part=None):
    sources = build_tree.digests_of(worker / "ws/src")
    about = build_tree.Kept(str(worker), sources, built, part, ())
    build_tree.write(os.open(file, os.O_WRONLY | os.O_CREAT), about, worker / "ws")
    return file


def next_worker(worker, change=lambda source: None):
    """Return the folder of a later worker, whose copy of the sources was changed."""
    folder = worker.with_name("tutorial_check_bbbbbbbb")
    shutil.copytree(worker / "ws/src", folder / "ws/src")
    change(folder / "ws/src/p")
    return folder


def restored(file, folder):
    sources = build_tree.digests_of(folder / "ws/src")
    return build_tree.restored(os.open(file, os.O_RDONLY), folder, sources)


def test_an_unchanged_workspace_gets_all_files_with_its_own_paths(worker, tmp_path):
    file = kept(worker, tmp_path / "kept", Built(2, f"{worker}/ws/src/p/talker.cpp:1: error"))
    folder = next_worker(worker)
    last = restored(file, folder)
    assert last.whole == Built(2, f"{folder}/ws/src/p/talker.cpp:1: error")
    assert (folder / "ws/build/talker.o").read_text() == f"\0{folder}/ws/src\0"
    assert (folder / "ws/devel/lib/p/talker").exists()
    old, new = ((top / "ws/build/Makefile").stat() for top in (worker, folder))
    assert (old.st_mtime_ns, old.st_mode) == (new.st_mtime_ns, new.st_mode)


def write(path, text="changed"):
    """Write a file as from an archive: with an old time."""
    path.write_text(text)
    os.utime(path, (0, 0))


@pytest.mark.parametrize("name", ["talker.cpp", "p.h", "talker.py"])
def test_a_changed_file_alone_is_newer_than_the_build(worker, tmp_path, name):
    file = kept(worker, tmp_path / "kept")
    folder = next_worker(worker, lambda source: write(source / name))
    assert restored(file, folder)
    built_s = (folder / "ws/build/talker.o").stat().st_mtime
    sources = [path for path in (folder / "ws/src/p").iterdir() if path.is_file()]
    assert [path.name for path in sources if path.stat().st_mtime >= built_s] == [name]


def test_a_continued_build_has_no_program_of_the_last_one(worker, tmp_path):
    for name in ("build/tool", "devel/lib/libp.so", "build/talker.o"):
        (worker / "ws" / name).write_bytes(b"\x7fELF")
    file = kept(worker, tmp_path / "kept")
    folder = next_worker(worker, lambda source: write(source / "talker.cpp"))
    assert restored(file, folder)
    assert {*os.listdir(folder / "ws/build")} == {"Makefile", "talker.o"}
    assert {*os.listdir(folder / "ws/devel/lib")} == {"p"}


@pytest.mark.parametrize(("name", "code", "begins"), [
    ("talker.cpp", 0, False), ("p.h", 0, False), ("talker.cpp", 1, True), ("talker.py", 0, True),
])  # fmt: skip
def test_cmake_runs_again_if_make_would_not_start_it(worker, tmp_path, name, code, begins):
    file = kept(worker, tmp_path / "kept", Built(code, ""))
    folder = next_worker(worker, lambda source: write(source / name))
    last, now = restored(file, folder), build_tree.digests_of(folder / "ws/src")
    assert build_tree.needs_cmake(last, now) == begins


CHANGES = {
    "CMakeLists.txt": lambda source: write(source / "CMakeLists.txt"),
    "a message": lambda source: write(source / "msg/Num.msg"),
    "setup.py": lambda source: write(source / "setup.py"),
    "a source less": lambda source: (source / "talker.cpp").unlink(),
    "a header less": lambda source: (source / "p.h").unlink(),
    "another header, which may hide one": lambda source: write(source / "ros.h"),
    "another name": lambda source: (source / "p.h").rename(source / "q.h"),
    "a folder less": lambda source: (source / "include").rmdir(),
    "other rights": lambda source: (source / "CMakeLists.txt").chmod(0o755),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_after_other_changes_the_build_begins_anew(worker, tmp_path, change):
    (worker / "ws/src/p/include").mkdir()
    file, folder = kept(worker, tmp_path / "kept"), next_worker(worker, change)
    assert restored(file, folder) is None and not (folder / "ws/build").exists()


def test_a_build_of_a_part_is_not_continued(worker, tmp_path):
    file = kept(worker, tmp_path / "kept", part=BUILT)
    folder = next_worker(worker, lambda source: write(source / "talker.cpp"))
    assert restored(file, folder) is None
    shutil.rmtree(folder)
    assert restored(file, next_worker(worker)).part == BUILT


def test_a_clock_that_was_set_back_hides_no_change(worker, tmp_path):
    later_s = time.time() + 3600
    os.utime(worker / "ws/build/talker.o", (later_s, later_s))
    assert restored(kept(worker, tmp_path / "kept"), next_worker(worker)) is None


@pytest.mark.parametrize("change", [
    lambda data: b"", lambda data: data[:-9], lambda data: b"[]\n" + data,
    lambda data: data.partition(b"\n")[2], lambda data: b"[" * 9999,
    lambda data: data.replace(b"tutorial_check_aaaaaaaa", b"shorter"),
])  # fmt: skip
def test_a_file_that_is_no_build_is_ignored(worker, tmp_path, change):
    file = kept(worker, tmp_path / "kept")
    file.write_bytes(change(file.read_bytes()))
    assert restored(file, next_worker(worker)) is None


def plant_link(ws):
    (ws / "build/secret").symlink_to("/etc/passwd")


def plant_folder(ws):
    (ws / "build/etc").symlink_to("/etc")


def plant_tree(ws):
    (ws / "devel").rename(ws / "elsewhere")
    (ws / "devel").symlink_to(ws / "elsewhere")


def plant_pipe(ws):
    os.mkfifo(ws / "build/pipe")


def fill(ws):
    os.truncate(ws / "build/talker.o", build_tree.MOST_BYTES)


@pytest.mark.parametrize("plant", [plant_link, plant_folder, plant_tree, plant_pipe, fill])
def test_a_build_with_links_or_too_large_is_not_kept(worker, tmp_path, plant):
    plant(worker / "ws")
    assert kept(worker, tmp_path / "kept").read_bytes() == b""


@pytest.mark.parametrize(("name", "is_as_before"), [
    ("build/config.h", True), ("src/CMakeLists.txt", True), (".catkin_workspace", True),
    ("src/p/config.h", False), ("src/p/p.h", False), ("bin", False),
])  # fmt: skip
def test_a_build_that_writes_elsewhere_is_not_kept(worker, name, is_as_before):
    sources = build_tree.digests_of(worker / "ws/src")
    (worker / "ws" / name).write_text("made")
    assert build_tree.is_elsewhere_as_before(worker / "ws", sources) == is_as_before


def test_a_name_with_any_characters_is_kept(worker, tmp_path):
    for name in ("ä 1", "new\nline", os.fsdecode(b"\xff")):
        (worker / "ws/build" / name).write_text(name, errors="surrogateescape")
    folder = next_worker(worker)
    assert json.dumps(os.listdir(worker / "ws/build"))
    assert restored(kept(worker, tmp_path / "kept"), folder)
    assert {*os.listdir(folder / "ws/build")} == {*os.listdir(worker / "ws/build")}
