"""Launch files that a command line names."""

import pytest

from launch_kit.ros import packages


@pytest.mark.parametrize(
    ("words", "files"),
    [
        ("mine a.launch world:=room", ["launch/a.launch"]),
        ("-p 11400 --wait mine a.launch", ["launch/a.launch"]),
        ("launch/a.launch launch/b.launch", ["launch/a.launch", "launch/b.launch"]),
        ("mine twice.launch", []),
        ("mine no.launch", []),
        ("yours a.launch", []),
        ("README.md launch/a.launch", ["launch/a.launch"]),
        ("-", []),
    ],
)
def test_they_are_found_as_roslaunch_finds_them(monkeypatch, tmp_path, words, files):
    for name in ("launch/a", "launch/b", "launch/twice", "old/twice"):
        path = tmp_path / f"{name}.launch"
        path.parent.mkdir(exist_ok=True)
        path.write_text("<launch/>")
    (tmp_path / "README.md").touch()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(packages, "folder", {"mine": tmp_path}.get)
    found = packages.named_files(words.split())
    assert [str(tmp_path / file) for file in found] == [str(tmp_path / file) for file in files]
