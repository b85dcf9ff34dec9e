"""--watch: what is watched, and what cannot be."""

import os
import threading
from types import SimpleNamespace

import pytest

from tutorial_check.model import CannotCheck
from tutorial_check.one_workspace import stamps, wait_for_change, watch


@pytest.mark.parametrize("folder", ["ws", "build/ws", "me~/devel"])
def test_build_and_devel_of_the_workspace_do_not_matter(tmp_path, folder):
    names = "src/package.xml build/CMakeCache.txt devel/setup.bash src/.joy2twist.py.swp src/a.py~"
    for name in names.split():
        (tmp_path / folder / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / name).touch()
    assert list(stamps(tmp_path / folder)) == [str(tmp_path / folder / "src/package.xml")]


@pytest.mark.parametrize("change", [os.unlink, lambda path: os.chmod(path, 0o755)])
def test_a_change_is_seen(tmp_path, change):
    (tmp_path / "a.py").touch()
    waiting = threading.Thread(target=wait_for_change, args=(tmp_path, stamps(tmp_path)))
    waiting.start()
    change(tmp_path / "a.py")
    waiting.join(60.0)
    assert not waiting.is_alive()


def test_a_zip_cannot_be_watched(tmp_path):
    (tmp_path / "ws.zip").touch()
    with pytest.raises(CannotCheck, match="--watch is for one"):
        watch(SimpleNamespace(workspace=tmp_path / "ws.zip"))
