"""The files that --package writes for a service."""

import shlex
import subprocess
import zipfile
from pathlib import Path

import pytest
import yaml

from tutorial_check.commands.package import package
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim(
    "--package writes a zip for Gradescope without solutions, its exit codes, and a workflow for "
    "GitHub at this commit"
)
SQUARE = REPOSITORY / "common/courses/square"


def test_the_zip_has_scripts_suite_and_course_and_no_solutions(tmp_path):
    path = package("gradescope", read_course(SQUARE), ["1"], str(tmp_path / "a.zip"), "cpp")
    with zipfile.ZipFile(path) as file:
        names = file.namelist()
        scripts = {name: file.read(name).decode() for name in ("setup.sh", "run_autograder")}
        modes = [file.getinfo(name).external_attr >> 16 & 0o777 for name in scripts]
        assert file.getinfo("suite/tutorial").external_attr >> 16 & 0o100
    assert modes == [0o755, 0o755]
    assert {"course/course.yaml", "course/square.py", "suite/tutorial"} <= set(names)
    assert not [name for name in names if name.startswith(("course/solutions", "suite/.git/"))]
    assert "--course source/course --language cpp 1\n" in scripts["run_autograder"]
    for text in scripts.values():
        assert subprocess.run(["bash", "-n"], input=text, text=True, check=False).returncode == 0


@pytest.mark.parametrize(("code", "results", "exits", "output"), [
    (0, "{}", 0, "{}"), (1, "{}", 0, "{}"), (2, "", 2, "could not work"), (2, "{}", 2, "{}"),
    ("sleep", "", 124, "it took too long"),
])  # fmt: skip
def test_the_exit_codes_that_the_service_wants(tmp_path, code, results, exits, output):
    path = package("gradescope", read_course(), ["4.3"], str(tmp_path / "a.zip"))
    for folder in ("source/suite", "submission", "results"):
        (tmp_path / folder).mkdir(parents=True)
    with zipfile.ZipFile(path) as file:
        file.extract("run_autograder", tmp_path / "source")
    ends = "exec sleep 60" if code == "sleep" else f"exit {code}"
    tutorial = tmp_path / "source/suite/tutorial"
    tutorial.write_text(
        f"#!/bin/sh\necho $* >words\nprintf '{results}' >results/results.json\n{ends}\n"
    )
    tutorial.chmod(0o755)
    done = subprocess.run(
        ["bash", tmp_path / "source/run_autograder"], check=False,
        env={"PATH": "/usr/bin:/bin", "AUTOGRADER": str(tmp_path), "LIMIT_S": "2"},
    )  # fmt: skip
    assert done.returncode == exits
    assert output in (tmp_path / "results/results.json").read_text()
    words = "check --in submission --gradescope results/results.json 4.3\n"
    assert (tmp_path / "words").read_text() == words


@pytest.fixture
def git(tmp_path, monkeypatch):
    """git(script): make the only program on PATH."""

    def make(script):
        (tmp_path / "bin").mkdir()
        (tmp_path / "bin/git").write_text(f"#!/bin/sh\n{script}\n")
        (tmp_path / "bin/git").chmod(0o755)

    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    return make


NO_CLONE = "echo fatal: not a git repository >&2; exit 128"


@pytest.mark.parametrize(("what", "out", "script", "why"), [
    ("moodle", "a", "", "there are gradescope and github:OWNER/NAME"),
    ("github:no name", "a", "", "the repository in which this suite is"),
    ("gradescope", "nowhere/a.zip", "", "No such file"),
    ("github:lab/x", "a", "", "git: No such file"),
    ("github:lab/x", "a", NO_CLONE, "is no clone"),
    ("github:lab/x", "a", "elsewhere", "put the course into the suite's repository"),
])  # fmt: skip
def test_what_cannot_be_packed_is_one_line(tmp_path, git, what, out, script, why):
    (tmp_path / "course.yaml").write_text('exercises: {"2": one}')
    course = read_course(tmp_path) if script == "elsewhere" else read_course()
    if script == NO_CLONE:
        git(script)
    with pytest.raises(CannotCheck) as error:
        package(what, course, ["2"], str(tmp_path / out))
    assert why in str(error.value) and "\n" not in str(error.value)
    assert not (tmp_path / out).exists()


@pytest.mark.parametrize("name", ["doc/a # b", 'it\'s: "a"', "two\nlines", "${{ x }}"])
def test_the_workflow_checks_out_the_suite_at_this_commit(tmp_path, git, monkeypatch, name):
    git("echo 0a1b")
    monkeypatch.setattr("tutorial_check.commands.package.SUITE", tmp_path)
    (tmp_path / name).mkdir(parents=True)
    (tmp_path / name / "course.yaml").write_text("exercises: {'1': one}")
    about = ("github:lab/x", read_course(tmp_path / name), ["1"], str(tmp_path / "check.yml"))
    if "${{" in name:
        with pytest.raises(CannotCheck, match="GitHub would replace"):
            package(*about)
        return
    steps = yaml.safe_load(Path(package(*about)).read_text())["jobs"]["check"]["steps"]
    suite = steps[1]["with"]
    assert (suite["repository"], suite["ref"]) == ("lab/x", "0a1b")
    assert shlex.split(steps[2]["run"])[-3:] == ["--course", f"suite/{name}", "1"]
