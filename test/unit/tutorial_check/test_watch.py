"""--watch: what is watched, and what cannot be."""

import errno

import pytest
from watchdog.observers import Observer

from tutorial_check.model import CannotCheck
from tutorial_check.watch import Changes, matters


@pytest.mark.parametrize("folder", ["/home/me/ws", "/home/me/build/ws", "/home/me~/devel", "ws"])
@pytest.mark.parametrize(
    ("file", "is_the_students"),
    [
        ("src/joy2twist/package.xml", True),
        ("build/CMakeCache.txt", False),
        ("devel/setup.bash", False),
        ("src/joy2twist/.joy2twist.py.swp", False),
    ],
)
def test_build_and_devel_of_the_workspace_do_not_matter(folder, file, is_the_students):
    assert matters(f"{folder}/{file}", folder) == is_the_students


@pytest.mark.parametrize("name", ["ws.zip", "none"])
def test_no_folder(tmp_path, name):
    (tmp_path / "ws.zip").touch()
    with pytest.raises(CannotCheck, match="--watch is for one"):
        Changes(tmp_path / name)


def test_no_watches_left(tmp_path, monkeypatch):
    def start(_):
        raise OSError(errno.ENOSPC, "inotify watch limit reached")

    monkeypatch.setattr(Observer, "start", start)
    with pytest.raises(CannotCheck, match="watch limit reached; without --watch"):
        Changes(tmp_path)
