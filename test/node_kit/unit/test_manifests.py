"""Exactly those package.xml are named that rospkg cannot read."""

import pytest
import rospkg

from node_kit.manifests import broken_manifests

GOOD = "<package><name>good</name></package>"


def package(folder, text):
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(text)
    return folder


@pytest.mark.parametrize(("text", "word"), [
    ("<package>\n<name>x</nam>\n</package>", "mismatched tag: line 2"),
    ("<package></package>", "no <name>"),
])  # fmt: skip
def test_a_file_that_rospkg_cannot_read_is_named(tmp_path, text, word):
    package(tmp_path / "src" / "good", GOOD)
    bad = package(tmp_path / "src" / "deep" / "bad", text)
    with pytest.raises(Exception):  # noqa: B017  rospkg raises several types
        rospkg.RosPack([str(tmp_path)]).list()
    ((path, complaint),) = broken_manifests(tmp_path)
    assert path == f"{bad}/package.xml"
    assert word in complaint


def test_a_file_that_rospkg_does_not_read_may_be_broken(tmp_path):
    package(tmp_path / "ignored", "")
    (tmp_path / "ignored" / "CATKIN_IGNORE").touch()
    package(tmp_path / "good", GOOD)
    package(tmp_path / "good" / "inside", "")
    (tmp_path / "loop").symlink_to(tmp_path)
    assert rospkg.RosPack([str(tmp_path / "ignored"), str(tmp_path / "good")]).list() == ["good"]
    assert broken_manifests(tmp_path) == []
