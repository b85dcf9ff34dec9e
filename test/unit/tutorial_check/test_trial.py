"""Where no program of a student's could work, the folder is to blame, and no student."""

import functools
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from tutorial_check.box import Box
from tutorial_check.model import CannotCheck
from tutorial_check.trial import must_be_possible

as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")


@pytest.fixture
def home():
    """A folder open to all, with one that is not and, in that, open ones."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        home.chmod(0o755)
        (home / "open").mkdir()
        (home / "open" / "setup.bash").touch()
        (home / "closed").mkdir(0o700)
        (home / "closed" / "suite").mkdir()
        yield home


@pytest.fixture
def attempt(home, stranger):
    """must_be_possible, with programs that run as somebody else."""
    return functools.partial(must_be_possible, Box({"HOME": str(home)}, stranger))


@as_root
def test_what_others_may_enter_is_well(home, attempt):
    attempt(home / "open", [home / "open", home / "open" / "setup.bash"])


@as_root
@pytest.mark.parametrize(("needed", "how"), [("closed/suite", r"o\+x"), ("closed", r"-R o\+rX")])
def test_what_is_closed_is_named(home, attempt, needed, how):
    with pytest.raises(CannotCheck, match=rf"^{home}/closed is .*: chmod {how} {home}/closed,"):
        attempt(home / "open", [home / "open" / "setup.bash", home / needed])


@as_root
def test_a_closed_folder_for_what_is_written_is_named(home, attempt):
    with pytest.raises(CannotCheck, match=rf"can be started in {home}/closed .*TMPDIR"):
        attempt(home / "closed" / "suite", [])


NOEXEC = """
import subprocess, sys
from pathlib import Path
from tutorial_check.box import Box
from tutorial_check.trial import must_be_possible

subprocess.run(["mount", "-t", "tmpfs", "-o", "noexec,mode=755", "none", sys.argv[1]], check=True)
(Path(sys.argv[1]) / "scratch").mkdir()
must_be_possible(Box({"HOME": "/"}), Path(sys.argv[1]) / "scratch", [])
"""


APART = ["unshare", "--mount", *([] if os.geteuid() == 0 else ["--user", "--map-root-user"])]
may_mount = not subprocess.run(
    [*APART, "mount", "-t", "tmpfs", "none", "/mnt"], check=False
).returncode


@pytest.mark.skipif(not may_mount, reason="no namespaces here, in which to mount")
def test_one_that_is_mounted_noexec_is_named(tmp_path):
    done = subprocess.run(
        [*APART, sys.executable, "-c", NOEXEC, str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    why = f"no program can be started in {tmp_path} (Permission denied): set TMPDIR"
    assert why in done.stderr.splitlines()[-1]
