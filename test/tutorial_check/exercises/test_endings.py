"""However the checker ends, it leaves nothing; without namespaces, no verdict is wrong."""

import os
import signal
import time
from dataclasses import replace
from pathlib import Path

import pytest
from edits import at_night, write
from solution import TALKER, B
from stored import REPOSITORY
from test_awkward import PYTHONPATH, check, command
from test_hostile import processes_like

from tutorial_check.recording.launcher import prepared
from tutorial_check.recording.worker_process import Worker
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import Program, command_line, descendants, lives
from tutorial_testing.waiting import wait_for

# The checker itself ends such a build after two minutes, such a node after seconds.
SOON_S = 60.0
NODE = """#!/usr/bin/env python3
import os, signal
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_IGN)
if os.fork() == 0:
    os.setsid()
while True:
    signal.pause()
"""
BUILD = "execute_process(COMMAND sleep 3600)\n"
WORKS = {
    # exercise, file, its text, a word of the resulting command line
    "node": ("3", TALKER, NODE, TALKER),
    "build": ("2", f"{B}/CMakeLists.txt", BUILD, "cmake"),
}


@pytest.fixture
def scratch(folder):
    """The folder for the checker's copy, which the programs' users may enter."""
    (folder / "scratch").mkdir()
    yield folder / "scratch"
    for pid in processes_like(f"{folder}/scratch/"):  # if the test has failed
        os.kill(int(pid), signal.SIGKILL)


def path_without_namespaces(folder):
    """A PATH on which bubblewrap is refused."""
    (folder / "bin").mkdir()
    (folder / "bin" / "bwrap").symlink_to("/bin/false")
    return f"{folder}/bin:{os.environ['PATH']}"


@pytest.fixture
def bare(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", path_without_namespaces(tmp_path))


@claim("Without namespaces the verdicts are the same, or none and why")
@pytest.mark.night
@pytest.mark.usefixtures("bare")
def test_right_is_right_or_not_judged_without_namespaces(literal, underlay):
    """If the suite is below root's home, another user's launch files cannot name it."""
    others_may_enter = all(folder.stat().st_mode & 0o001 for folder in Path(underlay).parents)
    code, out, error = check(underlay, "--in", literal.parent, "2", "3", "4", "5")
    assert code == (0 if os.geteuid() or others_may_enter else 2), out + error
    assert "WRONG" not in out


@claim("Without namespaces the verdicts ...", because="where programs may not enter")
@pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")
@pytest.mark.night
@pytest.mark.usefixtures("bare")
def test_nobody_is_blamed_where_programs_may_not_enter(literal, underlay, tmp_path):
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o700)
    tmp_path.chmod(0o755)
    (closed / "setup.bash").write_text(f". {underlay}\n")
    code, out, error = check(closed / "setup.bash", "--in", literal.parent, "5")
    assert code == 2, out + error
    assert "WRONG" not in out
    assert "closed to others" in error and "TUTORIAL_WORKSPACE" in error


@pytest.fixture(params=["apart", "bare"])
def environment(request, tmp_path, scratch, underlay):
    """(underlay, variables) of a checker with or without namespaces."""
    path = os.environ["PATH"]
    if request.param == "bare":
        path = path_without_namespaces(tmp_path)
        underlay = request.getfixturevalue("bare_underlay")
    elif not bubblewrap.granted().options:
        pytest.skip("no namespaces here")
    return underlay, {"PYTHONPATH": PYTHONPATH, "PATH": path, "TMPDIR": str(scratch)}


@claim("However the checker ends, no process and no folder is left")
@pytest.mark.parametrize("work", WORKS)
@pytest.mark.parametrize("how", [signal.SIGKILL, *at_night(signal.SIGTERM, signal.SIGHUP)])
def test_nothing_is_left(literal, environment, scratch, how, work):
    exercise, file, text, seen = WORKS[work]
    underlay, variables = environment
    write(file, text)(literal)
    words = command(underlay, "--in", literal.parent, exercise)
    with Program(*words, **variables) as checker:
        wait_for(
            lambda: [pid for pid in processes_like(f"{scratch}/") if seen in command_line(pid)],
            work,
        )
        started = descendants(checker.pid)
        os.kill(checker.pid, how)
        assert checker.wait() == (-9 if how == signal.SIGKILL else 130)
        wait_for(lambda: not any(map(lives, started)), "end of what was started", SOON_S)
        wait_for(lambda: not processes_like(f"{scratch}/"), "end of what that started", SOON_S)
        wait_for(lambda: not os.listdir(scratch), "end of its folder", SOON_S)
        assert "Traceback" not in checker.output


@claim("However the checker ...", because="a worker that starts")
@pytest.mark.skipif(not bubblewrap.granted().options, reason="no namespaces here")
def test_a_worker_that_is_ended_while_it_starts_leaves_nothing(literal, underlay, tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    order = prepared(Order(literal.parent, underlay, ["2"]), folder)
    order = replace(order, sandbox=replace(order.sandbox, in_namespaces=True))
    wrapper = bubblewrap.command(order.folder, order.sandbox.readable, REPOSITORY)
    for milliseconds in range(0, 20):
        with Worker(order, wrapper):
            time.sleep(milliseconds / 1000)  # ends it at each point of bubblewrap's start
    wait_for(lambda: not processes_like(str(folder)), "end of the workers", SOON_S)
