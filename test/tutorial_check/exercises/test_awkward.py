"""The command line, for a workspace and a class: the right exit code and one clear line."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from edits import chmod, put
from solution import JOY2TWIST, TALKER

from tutorial_check.report.memory import LATER
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program, command_line, descendants, lives
from tutorial_testing.waiting import LONGEST_S, wait_for

SOURCE = REPOSITORY / "common" / "tutorial_check" / "src"
PYTHONPATH = f"{SOURCE}:{SOURCE.parents[1] / 'node_kit' / 'src'}"


def command(underlay, *words):
    words = ["--underlay", *map(str, (underlay, *words))]
    return ["/usr/bin/python3", "-m", "tutorial_check", *words]


def check(underlay, *words):
    """Run ./tutorial check, which has its own deadlines; return (exit code, stdout, stderr)."""
    done = subprocess.run(
        command(underlay, *words), capture_output=True, text=True, check=False, timeout=3600,
        env={**os.environ, "PYTHONPATH": PYTHONPATH},
    )  # fmt: skip
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout, done.stderr


@claim(
    "The first failure says what is wrong, the second how to fix it, with whole paths; --hints and "
    "--no-hints choose"
)
def test_wrong_is_exit_code_1_and_the_second_time_there_is_a_hint(literal, underlay):
    """Paths are whole, and quoted for a shell."""
    workspace = literal.parent.rename(literal.parent.with_name("my ws"))
    chmod(TALKER, 0o644)(workspace / "src")
    code, out, _ = check(underlay, "--in", workspace, "3")
    assert code == 1
    assert f"hint:     {LATER}\n" in out
    again = check(underlay, "--in", workspace, "3")[1]
    assert f"hint:     chmod +x '{workspace}'/src/{TALKER}\n" in again
    assert f"yourself: ls -l '{workspace}'/src/{TALKER}\n" in again
    code, out, error = check(underlay, "--in", workspace, "--solution", "3")
    assert (code, out) == (2, "") and "3 is not done yet" in error
    assert "hint" not in check(underlay, "--in", workspace, "3", "--no-hints")[1]


@claim("Exit code 0 is right, 1 wrong, 2 no verdict, with one line that says why")
@pytest.mark.parametrize("folder", [None, "nowhere", SOURCE.parents[2]])
def test_what_cannot_be_checked_is_exit_code_2(tmp_path, underlay, folder):
    """Without an underlay, without a workspace, with this suite's own solutions."""
    words = {SOURCE.parents[2]: "this suite's solution, not yours"}.get(folder, "no such")
    underlay = underlay if folder else tmp_path / "none"
    code, _, error = check(underlay, "--in", tmp_path / (folder or "nowhere"), "2")
    assert code == 2
    assert words in error and "no verdict" in error


@claim("In a class, checked side by side, each student has the verdict of their own programs")
@claim("Each folder or zip of a class has a report, a row of the table and a page")
def test_a_class_has_a_table_and_reports(literal, underlay, tmp_path):
    """Checked side by side: one right, one wrong, one that hangs, a zip, and an invalid zip."""
    group = tmp_path / "group"
    for name in ("ada", "bob", "eve"):
        shutil.copytree(literal.parent, group / name)
    put(JOY2TWIST, "data.axes[0]", "-data.axes[0]")(group / "bob/src")
    put(JOY2TWIST, "def callback", "while True:\n    pass\n\n\ndef callback")(group / "eve/src")
    (group / "zoe.zip").write_text("no zip")
    zipped = tmp_path / "kim" / "ros/hydro/catkin_ws"  # as zipped from home
    shutil.copytree(literal.parent, zipped)
    shutil.make_archive(str(group / "kim"), "zip", tmp_path / "kim")
    code, out, error = check(underlay, "--all", group, "4.3")
    assert code == 2, out + error  # zoe's could not be checked
    table = (group / "check" / "table.csv").read_text().splitlines()
    cells = dict(line.split(",")[:2] for line in table[1:])
    assert cells == {"ada": "ok", "bob": "C16", "eve": "C14", "kim": "ok", "zoe": "?"}
    assert "sign is wrong" in (group / "check" / "bob.txt").read_text()
    kim = (group / "check" / "kim.txt").read_text()
    assert kim.endswith("1 of 1 exercises done (workspace: ros/hydro/catkin_ws)\n")


def examines(program):
    return any(
        "tutorial_check.recording.worker" in command_line(pid) for pid in descendants(program.pid)
    )


@claim("Ctrl-C ends the check of all, and leaves nothing running")
def test_ctrl_c_ends_the_check_of_all(literal, underlay, tmp_path):
    for number in range(4):
        shutil.copytree(literal.parent, tmp_path / "group" / str(number))
    words = command(underlay, "--all", tmp_path / "group")
    with Program(*words, PYTHONPATH=PYTHONPATH) as professor:
        wait_for(lambda: examines(professor), "worker")
        started = descendants(professor.pid)
        professor.interrupt()
        assert professor.wait() == 130
        assert "interrupted: no verdict" in professor.output
        wait_for(lambda: not any(map(lives, started)), "end of the workers")
        assert "Traceback" not in professor.output
        assert not (tmp_path / "group" / "check" / "table.csv").exists()


@claim("--watch checks again when a file is saved; build and devel are not watched")
def test_watch_checks_again_once_a_file_is_saved(literal, underlay, tmp_path):
    """Even in a workspace called build."""
    workspace = Path(shutil.move(str(literal.parent), str(tmp_path / "build")))
    chmod(TALKER, 0o644)(workspace / "src")
    words = command(underlay, "--in", workspace, "--watch", "3")
    with Program(*words, PYTHONPATH=PYTHONPATH) as watch:
        wait_for(lambda: "\nwaiting" in watch.output, "first verdict", LONGEST_S)
        assert f"hint:     {LATER}" in watch.output
        chmod(TALKER, 0o755)(workspace / "src")
        wait_for(lambda: "\n1 of 1 exercises done" in watch.output, "second verdict", LONGEST_S)
