"""roslaunch can read every launch file, and finds each node and package that it names."""

from pathlib import Path

import pytest
import roslaunch.rlutil

REPOSITORY = Path(__file__).resolve().parents[2]
FOLDERS = ("*", "common/*", "common/stand_ins/*")
FILES = sorted(file for folder in FOLDERS for file in REPOSITORY.glob(f"{folder}/launch/*.launch"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(REPOSITORY)))
def test_launch_file(file, monkeypatch):
    # roslaunch reads the arguments of its own command line; student.launch needs this one.
    monkeypatch.setattr("sys.argv", ["roslaunch", "name:=robot_1"])
    assert roslaunch.rlutil.check_roslaunch(str(file), use_test_depends=True) is None
