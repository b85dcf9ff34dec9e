"""--package: the files with which Gradescope and GitHub run the checks on their machines."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import zipfile
from pathlib import Path
from typing import Sequence

from tutorial_check.course.definition import HANDOUT, SUITE, Course
from tutorial_check.errors import CannotCheck

GRADESCOPE, GITHUB = "gradescope", "github"
FILES = {GRADESCOPE: "autograder.zip", GITHUB: "check.yml"}
LEFT_OUT = {".git", "__pycache__", ".mypy_cache", ".ruff_cache", ".pytest_cache", "build", "devel"}
TEMPLATES = Path(__file__).with_name("autograder")  # @WORDS@ in capitals are replaced
RUN_ON_GITHUB = "suite/tutorial check --in submission --classroom result.json --junit report.xml"


def package(
    what: str, course: Course, exercises: Sequence[str], out: str | None, language: str = ""
) -> str:
    """Write a service's file; return its path. what: as in --package. Raises CannotCheck."""
    service, _, repository = what.partition(":")
    if service not in FILES:
        raise CannotCheck(f"--package {what}: there are {GRADESCOPE} and {GITHUB}:OWNER/NAME")
    path = Path(out or FILES[service])
    words = [*(["--language", language] if language else []), *exercises]
    try:
        if service == GRADESCOPE:
            _gradescope(path, course, words)
        else:
            path.write_text(_workflow(repository, course, words), encoding="utf-8")
    except OSError as error:
        raise CannotCheck(f"{path}: {error.strerror}") from None
    return str(path)


def _filled(template: str, **words: str) -> str:
    text = (TEMPLATES / template).read_text(encoding="utf-8")
    for name, word in words.items():
        text = text.replace(f"@{name}@", word)
    return text


def _gradescope(path: Path, course: Course, options: Sequence[str]) -> None:
    parts = {"suite": SUITE, **({} if course.folder == HANDOUT else {"course": course.folder})}
    words = [*(["--course", "source/course"] if "course" in parts else []), *options]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for script in ("setup.sh", "run_autograder"):
            about = zipfile.ZipInfo(script)
            about.external_attr = 0o100755 << 16
            file.writestr(about, _filled(script, WORDS=shlex.join(words)))
        for part, folder in parts.items():
            for source in sorted(folder.rglob("*")):
                name, is_ours = source.relative_to(folder), source.resolve() == path.resolve()
                is_left_out = is_ours or LEFT_OUT.intersection(name.parts)
                is_solution = part == "course" and name.parts[0] == "solutions"
                if source.is_file() and not is_left_out and not is_solution:
                    file.write(source, f"{part}/{name}")


def _commit() -> str:
    command = ["git", "-C", str(SUITE), "rev-parse", "HEAD"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CannotCheck(f"git: {error.strerror}; it is needed to find the commit") from None
    if done.returncode:
        raise CannotCheck(f"{SUITE} is no clone of a repository: {done.stderr.strip()}")
    return done.stdout.strip()


def _workflow(repository: str, course: Course, options: Sequence[str]) -> str:
    if not re.fullmatch(r"[\w.-]+/[\w.-]+", repository):
        raise CannotCheck(f"--package {GITHUB}:OWNER/NAME: the repository in which this suite is")
    words = list(options)
    if course.folder != HANDOUT:
        if SUITE not in course.folder.parents:
            raise CannotCheck(f"{course.folder}: put the course into the suite's repository")
        words = ["--course", f"suite/{course.folder.relative_to(SUITE)}", *words]
    if any("${{" in word for word in words):
        raise CannotCheck(f"{shlex.join(words)}: GitHub would replace ${{{{ in it: rename that")
    run = json.dumps(f"{RUN_ON_GITHUB} {shlex.join(words)}")  # quoted for YAML
    return _filled("check.yml", REPOSITORY=repository, COMMIT=_commit(), RUN=run)
