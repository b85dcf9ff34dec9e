"""What a program sees and may do apart, which the system has to grant."""

import ctypes
import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from tutorial_check import place
from tutorial_check.box import Box
from tutorial_check.forked import Helper

isolated = pytest.mark.skipif(not place.granted().options, reason="no isolation is granted here")
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


@pytest.fixture(params=["/tmp", "/var/tmp"])  # both are empty there
def home(request):
    """A home folder with a workspace, a link to it, the suite, and a file that nobody needs."""
    with tempfile.TemporaryDirectory(dir=request.param) as folder:
        home = Path(folder) / "home"
        for path in ("course/ws/file", "suite/common/file", "suite/joy2twist/file", "scratch/file"):
            (home / path).parent.mkdir(parents=True)
            (home / path).touch()
        for path in ("secret", "joy.bag"):
            (home / path).touch()
        (home / "link").symlink_to(home / "course" / "ws")
        home.chmod(0o700)
        yield home


SHOWN = ("link", "joy.bag", "suite/common")


def run(home, text, *words, shown=SHOWN):
    """The lines that a Python program prints apart."""
    command = place.command(home / "scratch", [home / each for each in shown], home / "suite")
    done = subprocess.run(
        [*command, "/usr/bin/python3", "-c", text, *map(str, words)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        pass_fds=place.granted().descriptors,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@isolated
@pytest.mark.parametrize("workspace", ["link", "."])
def test_nothing_is_seen_but_what_is_shown(home, workspace):
    """Of the suite not its solutions, also where it lies in a folder that is shown."""
    expected = {
        "secret": READ_ONLY if workspace == "." else MISSING,
        "joy.bag": READ_ONLY,
        f"{workspace}": "course joy.bag link scratch secret suite" if workspace == "." else "file",
        "course/ws/file": READ_ONLY,
        "suite": "common",
        "suite/common/file": READ_ONLY,
        "suite/new": READ_ONLY,
        "scratch": "",
        "scratch/new": "written",
    }
    seen = run(home, LOOK, *(home / path for path in expected), shown=[workspace, *SHOWN])
    assert dict(zip(expected, seen)) == expected


@isolated
def test_nothing_of_the_system_is_left_to_write_to_or_to_speak_to(home):
    expected = {
        "/new": READ_ONLY,
        "/usr/new": READ_ONLY,
        "/etc/new": READ_ONLY,
        "/dev/new": READ_ONLY,
        "/etc/shadow": MISSING,
        "/run/user": MISSING,
        "/run/lock": MISSING,
        "/sys": MISSING,
        "/tmp/new": "written",
        "/var/tmp/new": "written",
        "/dev/shm": "",
    }
    assert dict(zip(expected, run(home, LOOK, *expected))) == expected
    assert not Path("/tmp/new").exists() and not Path("/var/tmp/new").exists()


@isolated
@pytest.mark.parametrize("folder", ["/tmp", "/var/tmp", "/dev/shm", "scratch"])
def test_what_is_written_is_limited(home, folder, monkeypatch):
    if not place.granted().is_limited:
        pytest.skip("this bubblewrap is too old to limit it")
    monkeypatch.setattr(place, "SCRATCH_MB", 64)
    text = "import os, sys; os.posix_fallocate(os.open(sys.argv[1], os.O_CREAT | 1), 0, 65 << 20)"
    with pytest.raises(AssertionError, match="No space left on device"):
        run(home, text, home / folder / "new")


@isolated
def test_no_program_makes_user_namespaces_in_which_nothing_is_limited(home):
    if not place.granted().is_limited:
        pytest.skip("this bubblewrap is too old, or the kernel forbids, to limit it")
    text = (
        "import ctypes, os, sys\n"
        "os.geteuid() or os.setuid(2_000_000)\n"
        "print(ctypes.CDLL(None).unshare(0x10000000))\n"
    )
    assert run(home, text) == ["-1"]


@isolated
def test_it_has_a_network_and_shared_memory_of_its_own(home):
    text = (
        "import ctypes, socket, sys\n"
        "libc = ctypes.CDLL(None)\n"
        "print(libc.shmget(int(sys.argv[1]), 1, 0))\n"
        "with socket.create_server(('127.0.0.1', 0)) as own:\n"
        "    socket.create_connection(own.getsockname()).close()\n"
        "print(socket.socket().connect_ex(('127.0.0.1', int(sys.argv[2]))))\n"
    )
    libc, key, create, remove = ctypes.CDLL(None), 0x5EED0000 + os.getpid() % 65536, 0o1600, 0
    shared = libc.shmget(key, 4096, create)
    try:
        with socket.create_server(("127.0.0.1", 0)) as server:
            assert shared >= 0
            assert run(home, text, key, server.getsockname()[1]) == ["-1", "111"]
    finally:
        libc.shmctl(shared, remove, None)


@isolated
def test_what_is_needed_from_another_ones_home_can_be_reached(home):
    """By the user as whom the programs run, too."""
    text = (
        "import os, sys; os.geteuid() or os.setuid(2_000_000); print(os.path.exists(sys.argv[1]))"
    )
    assert run(home, text, home / "suite/common/file") == ["True"]


class Starter:
    """A box, and what a program in it prints."""

    def __init__(self, uid):
        place.keep_to_itself()
        self._box = Box({"HOME": "/"}, uid)

    def run(self, *words):
        """What it prints."""
        program = self._box.start(words)
        self._box.wait(lambda: program.ended, 60.0)
        self._box.end(program)
        return program.output


def test_a_program_neither_reaches_the_result_nor_gains_rights(stranger):
    """Of any mode: it has no more than its user."""
    text = (
        "import os, sys\n"
        "status = dict(line.split(':') for line in open('/proc/self/status'))\n"
        "print(status['NoNewPrivs'], status['CapEff'])\n"
        "try:\n"
        "    os.listdir(f'/proc/{os.getppid()}/fd')\n"
        "except PermissionError:\n"
        "    print('closed')\n"
    )
    helper = Helper(lambda: Starter(stranger), {})
    try:
        assert helper.call("run", sys.executable, "-c", text).split() == ["1", "0" * 16, "closed"]
    finally:
        helper.end()


@pytest.mark.parametrize(
    ("granted", "told"),
    [
        (place.Isolation(why="bwrap: refused"), "no isolation here (bwrap: refused): a program "),
        (place.Isolation(("bwrap",), is_limited=False), "is not limited"),
        (place.Isolation(("bwrap",)), ""),
    ],
)
def test_what_the_system_does_not_provide_is_told(monkeypatch, granted, told):
    monkeypatch.setattr(place, "granted", lambda: granted)
    assert told in "".join(place.lacking())
    assert bool(place.lacking()) == bool(told)


@pytest.mark.parametrize("script", ["echo bwrap: No permissions >&2; exit 1", None])
def test_where_it_does_not_work_it_says_why(monkeypatch, tmp_path, script):
    if script:
        (tmp_path / "bwrap").write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / "bwrap").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path) if not script else f"{tmp_path}:/bin")
    why = "bwrap: No permissions" if script else "bubblewrap is not installed"
    assert place.granted.__wrapped__() == place.Isolation(why=why)
