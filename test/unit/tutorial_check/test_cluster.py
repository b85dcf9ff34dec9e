"""What a worker gets is what was handed in."""

import os

import pytest

from tutorial_check import bubblewrap, cluster
from tutorial_check.bubblewrap import Isolation
from tutorial_check.model import CannotCheck


def test_files_arrive_as_they_are(tmp_path):
    """Also one of two names, one with a name as a folder of catkin's, and links."""
    folder = tmp_path / "ada"
    (folder / "build").mkdir(parents=True)
    (folder / "build" / "talker.py").write_text("x")
    os.link(folder / "build" / "talker.py", folder / "talker.py")
    os.link(folder / "talker.py", folder / "listener.py")
    (folder / "talker.py").chmod(0o775)
    (folder / "devel").write_text("y")
    (folder / "out").symlink_to("/etc/hostname")
    (folder / "gone").symlink_to("../../gone")
    os.mkfifo(folder / "pipe")
    cluster._unpack(cluster._packed({"submission": folder}), tmp_path)
    found = tmp_path / "submission"
    assert sorted(os.listdir(found)) == ["devel", "gone", "listener.py", "out", "talker.py"]
    assert (found / "talker.py").read_text() == (found / "listener.py").read_text() == "x"
    assert (found / "talker.py").stat().st_mode & 0o777 == 0o775
    assert os.readlink(found / "out") == "/etc/hostname"


def test_a_worker_without_isolation_checks_nothing(monkeypatch):
    """Also one that was started without ./tutorial worker."""
    monkeypatch.setattr(bubblewrap, "granted", lambda: Isolation(why="bwrap: refused"))
    monkeypatch.delenv(cluster.INSISTS, raising=False)
    with pytest.raises(CannotCheck, match=r"cannot isolate programs: bwrap: refused: .* reach the"):
        cluster._examine(b"", ["2"], {}, "")
