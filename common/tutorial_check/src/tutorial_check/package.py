"""--package: what Gradescope and GitHub take to run the checks on their own machines."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import zipfile
from pathlib import Path
from typing import Iterator, Sequence

from tutorial_check.course import OURS, Course
from tutorial_check.launcher import SUITE
from tutorial_check.model import CannotCheck

GRADESCOPE, GITHUB = "gradescope", "github"
FILES = {GRADESCOPE: "autograder.zip", GITHUB: "check.yml"}
LEFT_OUT = {".git", "__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache", "build", "devel"}
EXECUTABLE = 0o100755 << 16  # as a zip has it
# Gradescope's default limit is 10 minutes; what is not done by then has no result there.
LIMIT_S = 540

# https://gradescope-autograders.readthedocs.io/en/latest/specs/: setup.sh makes the image, and
# run_autograder is run for each submission. AUTOGRADER: another place of the same folders.
SETUP = """#!/usr/bin/env bash
# Makes the image: installs ROS and builds the suite.
set -e
export TUTORIAL_WITHOUT="test view" TUTORIAL_WORKSPACE="${AUTOGRADER:-/autograder}/workspace"
cd "${AUTOGRADER:-/autograder}/source/suite"
./tutorial setup
"""
RUN = """#!/usr/bin/env bash
# Checks one submission. Right or wrong is in results.json; an exit code other than 0 is a fault.
cd "${AUTOGRADER:-/autograder}" || exit 2
export TUTORIAL_WITHOUT="test view" TUTORIAL_WORKSPACE="$PWD/workspace"
timeout --kill-after 10 "${LIMIT_S:-@LIMIT@}" source/suite/tutorial check --in submission \\
  --gradescope results/results.json @WORDS@
code=$?
if [ $code -le 1 ]; then exit 0; fi
if [ $code -ge 124 ]; then why="it took too long"; else why="the checker could not work"; fi
if [ ! -s results/results.json ]; then
  echo '{"score": 0, "output": "No verdict, through no fault of yours: '"$why"'."}' \\
    >results/results.json
fi
exit $code
"""
RUN_ON_GITHUB = "suite/tutorial check --in submission --classroom result.json --junit report.xml"
WORKFLOW = """# Checks a student's repository; to be put into .github/workflows of each, or of their template.
name: check
on: [push, workflow_dispatch]
permissions: {contents: read}
jobs:
  check:
    runs-on: ubuntu-latest
    timeout-minutes: 30
    container: debian:bookworm-slim
    env: {TUTORIAL_WITHOUT: test view}
    steps:
      - uses: actions/checkout@11bd71901bbe5b1630ceea73d27597364c9af683 # v4.2.2
        with: {path: submission}
      - uses: actions/checkout@11bd71901bbe5b1630ceea73d27597364c9af683 # v4.2.2
        with: {repository: @REPOSITORY@, ref: @COMMIT@, path: suite}
      - name: check
        run: @RUN@
      - uses: actions/upload-artifact@ea165f8d65b6e75b540449e92b4886f43607fa02 # v4.6.2
        if: always()
        with: {name: report, path: report.xml}
"""


def package(what: str, course: Course, exercises: Sequence[str], out: str | None) -> str:
    """Write the zip or the workflow; return its path. Raises CannotCheck.

    what: gradescope, or github:OWNER/NAME of the suite's repository.
    """
    service, _, repository = what.partition(":")
    if service not in FILES:
        raise CannotCheck(f"--package {what}: there are {GRADESCOPE} and {GITHUB}:OWNER/NAME")
    path = Path(out or FILES[service])
    try:
        if service == GRADESCOPE:
            _gradescope(path, course, exercises)
        else:
            path.write_text(_workflow(repository, course, exercises), encoding="utf-8")
    except OSError as error:
        raise CannotCheck(f"{path}: {error.strerror}") from None
    return str(path)


def _gradescope(path: Path, course: Course, exercises: Sequence[str]) -> None:
    is_ours = course.folder == OURS
    words = shlex.join([*(() if is_ours else ("--course", "source/course")), *exercises])
    run = RUN.replace("@WORDS@", words).replace("@LIMIT@", str(LIMIT_S))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in (("setup.sh", SETUP), ("run_autograder", run)):
            about = zipfile.ZipInfo(name)
            about.external_attr = EXECUTABLE
            file.writestr(about, text)
        for each, name in _files(SUITE):
            if each.resolve() != path.resolve():
                file.write(each, f"suite/{name}")
        for each, name in () if is_ours else _files(course.folder):
            if not name.startswith("solutions/"):
                file.write(each, f"course/{name}")


def _files(folder: Path) -> Iterator[tuple[Path, str]]:
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if path.is_file() and not LEFT_OUT.intersection(name.parts):
            yield path, str(name)


def _commit() -> str:
    """Return the commit of this clone. Raises CannotCheck."""
    command = ["git", "-C", str(SUITE), "rev-parse", "HEAD"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CannotCheck(f"git: {error.strerror}; it says which commit is meant") from None
    if done.returncode:
        raise CannotCheck(f"{SUITE} is no clone of a repository: {done.stderr.strip()}")
    return done.stdout.strip()


def _workflow(repository: str, course: Course, exercises: Sequence[str]) -> str:
    if not re.fullmatch(r"[\w.-]+/[\w.-]+", repository):
        raise CannotCheck(f"--package {GITHUB}:OWNER/NAME: the repository in which this suite is")
    words = list(exercises)
    if course.folder != OURS:
        if SUITE not in course.folder.parents:
            raise CannotCheck(f"{course.folder}: put the course into the suite's repository")
        words = ["--course", f"suite/{course.folder.relative_to(SUITE)}", *words]
    if any("${{" in word for word in words):
        raise CannotCheck(f"{shlex.join(words)}: GitHub would replace ${{{{ in it: rename that")
    run = f"{RUN_ON_GITHUB} {shlex.join(words)}"
    text = WORKFLOW.replace("@REPOSITORY@", repository).replace("@COMMIT@", _commit())
    return text.replace("@RUN@", json.dumps(run))  # a text for YAML, whatever is in it
