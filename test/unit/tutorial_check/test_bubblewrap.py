"""What an isolated program sees and may do; test/exercises/test_isolation.py has the attacks."""

import subprocess
import tempfile
from pathlib import Path

import pytest

from tutorial_check import bubblewrap, landlock
from tutorial_check.bubblewrap import Isolation

LOOK = """
import os, sys
for path in sys.argv[1:]:
    try:
        open(path, "x" if path.endswith("new") else "r+").close()
        print("written")
    except IsADirectoryError:
        print(*sorted(os.listdir(path)))
    except OSError as error:
        print(error.strerror)
"""
MISSING, READ_ONLY = "No such file or directory", "Read-only file system"
SHOWN = ("link", "joy.bag", "suite/common")


@pytest.fixture
def home():
    """A home folder with a workspace, a link to it, the suite, and a file that nothing needs."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder) / "home"
        files = "course/ws/file suite/common/file suite/joy2twist/file scratch/file secret joy.bag"
        for path in files.split():
            (home / path).parent.mkdir(parents=True, exist_ok=True)
            (home / path).touch()
        (home / "link").symlink_to(home / "course" / "ws")
        home.chmod(0o700)
        yield home


def run(home, text, *words, shown=SHOWN):
    """Return the lines that an isolated Python program prints."""
    command = bubblewrap.command(home / "scratch", [home / each for each in shown], home / "suite")
    done = subprocess.run(
        [*command, "/usr/bin/python3", "-c", text, *map(str, words)],
        pass_fds=bubblewrap.granted().descriptors,
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.skipif(not bubblewrap.granted().options, reason="no isolation here")
@pytest.mark.parametrize("workspace", ["link", "."])
def test_a_program_sees_only_what_is_shown(home, workspace):
    """Of the suite not its solutions, also where it lies in a folder that is shown."""
    expected = {
        "secret": READ_ONLY if workspace == "." else MISSING,
        "joy.bag": READ_ONLY,
        workspace: "course joy.bag link scratch secret suite" if workspace == "." else "file",
        "course/ws/file": READ_ONLY,
        "suite": "common",
        "suite/common/file": READ_ONLY,
        "suite/new": READ_ONLY,
        "scratch": "",
        "scratch/new": "written",
    }
    seen = run(home, LOOK, *(home / path for path in expected), shown=[workspace, *SHOWN])
    assert dict(zip(expected, seen)) == expected


@pytest.mark.parametrize(
    ("granted", "version", "words"),
    [
        (Isolation(why="bwrap: refused"), 0, "no isolation here (bwrap: refused): a program "),
        (Isolation(why="bwrap: refused"), 3, "isolated by Landlock alone (bwrap: refused): a "),
        (Isolation(("bwrap",)), 3, "does not limit the memory"),
        (Isolation(("bwrap",), is_limited=True), 0, ""),
    ],
)
def test_what_the_system_does_not_provide_is_reported(monkeypatch, granted, version, words):
    monkeypatch.setattr(bubblewrap, "granted", lambda: granted)
    monkeypatch.setattr(landlock, "version", lambda: version)
    assert words in "".join(bubblewrap.lacking())
    assert bool(bubblewrap.lacking()) == bool(words)


@pytest.mark.parametrize("why", ["bwrap: No permissions", "bubblewrap is not installed"])
def test_why_bubblewrap_does_not_work_is_known(monkeypatch, tmp_path, why):
    if "installed" not in why:
        (tmp_path / "bwrap").write_text(f"#!/bin/sh\necho {why} >&2; exit 1\n")
        (tmp_path / "bwrap").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert bubblewrap.granted.__wrapped__() == Isolation(why=why)
