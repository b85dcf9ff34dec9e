"""The bags that pages may open."""

import os

import pytest

from cockpit_server.ros.tabs import bag_files
from cockpit_server.ros.tabs.bag_files import read
from gamepad.errors import BagError
from tutorial_testing.claims import claim

pytestmark = claim("Recordings are read once, ...", because="names, and a viewer's list")


def test_refused_file_is_named_without_its_folder(tmp_path):
    os.mkfifo(tmp_path / "pipe.bag")
    (tmp_path / "text.bag").write_text("no bag")
    for name in ("pipe.bag", "text.bag", "none.bag"):
        with pytest.raises(BagError) as error:
            read(tmp_path / name)
        assert str(error.value).startswith(f"{name}: ") and str(tmp_path) not in str(error.value)


def test_viewers_are_offered_nothing_of_the_folder(tmp_path, monkeypatch):
    (tmp_path / "own.bag").write_text("no bag")
    monkeypatch.chdir(tmp_path)
    assert set(bag_files.bag_files(may_drive=True)) == {"joy.bag", "own.bag"}
    assert set(bag_files.bag_files(may_drive=False)) == {"joy.bag"}
