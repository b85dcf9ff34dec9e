"""--watch: what is watched, and what cannot be."""

from types import SimpleNamespace

import pytest

from tutorial_check.command_line import stamps, watch
from tutorial_check.model import CannotCheck


@pytest.mark.parametrize("folder", ["ws", "build/ws", "me~/devel"])
def test_build_devel_and_files_of_editors_are_not_watched(tmp_path, folder):
    names = "src/package.xml build/CMakeCache.txt devel/setup.bash src/.joy2twist.py.swp src/a.py~"
    for name in names.split():
        (tmp_path / folder / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / name).touch()
    assert list(stamps(tmp_path / folder)) == [str(tmp_path / folder / "src/package.xml")]


def test_a_zip_cannot_be_watched(tmp_path):
    (tmp_path / "ws.zip").touch()
    with pytest.raises(CannotCheck, match="--watch is for one"):
        watch(SimpleNamespace(workspace=tmp_path / "ws.zip"))
