"""What Landlock lets a program do; test/exercises/test_isolation.py has the attacks."""

import os
import platform
import subprocess

import pytest

from tutorial_check import landlock, place

TRY = """
import ctypes, os, socket, sys
own, shown, hidden, parent = sys.argv[1:]
for what in (
    lambda: open(f"{own}/new", "w"), lambda: os.listdir(own), lambda: open(shown),
    lambda: open("/dev/null", "w"),
    lambda: os.rename(f"{own}/new", f"{own}/sub/new"), socket.socket, socket.socketpair,
    lambda: open(shown, "w"), lambda: open(hidden), lambda: os.truncate(hidden, 0),
    lambda: os.listdir("/root"),
    lambda: os.link(hidden, f"{own}/link"), lambda: os.unlink(hidden), lambda: os.listdir("/dev"),
    lambda: socket.socket(socket.AF_UNIX), lambda: os.kill(int(parent), 0),
    lambda: 0 <= ctypes.CDLL(None).shmget(0x5eed, 4096, 0o1600) or os.listdir("/root"),
):
    try:
        what()
        print("yes", end=" ")
    except OSError:
        print("no", end=" ")
"""  # fmt: skip
MAY, MAY_NOT = 7, 10


def reached(tmp_path):
    """Return what a confined program may of TRY, "yes" or "no" each."""
    for name in ("own", "own/sub", "other"):
        (tmp_path / name).mkdir()
    for name in ("shown", "other/hidden"):
        (tmp_path / name).write_text("x")
    descriptor = landlock.ruleset(
        [tmp_path / "shown", "/usr", "/lib", "/lib64", "/nowhere"], [tmp_path / "own"]
    )

    def confine():
        place.give_up_rights()
        landlock.confine(descriptor)

    words = [tmp_path / "own", tmp_path / "shown", tmp_path / "other/hidden", os.getpid()]
    command = ["/usr/bin/python3", "-c", TRY, *map(str, words)]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, text=True, check=True, preexec_fn=confine
    )
    assert (tmp_path / "other/hidden").read_text() == "x"
    return done.stdout.split()


@pytest.mark.skipif(not landlock.version(), reason="no Landlock here, of Linux 6.2 or later")
def test_a_program_keeps_to_its_own_files(tmp_path):
    signals = ["no" if landlock.version() >= landlock.WITH_SCOPES else "yes"]
    expected = ["yes"] * MAY + ["no"] * (MAY_NOT - 2) + signals + ["no"]
    assert reached(tmp_path) == expected


def test_where_it_is_not_known_it_is_not_used(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert landlock.version.__wrapped__() == 0
    monkeypatch.undo()
    monkeypatch.setattr(landlock, "OLDEST", 1000)
    assert landlock.version.__wrapped__() == 0
