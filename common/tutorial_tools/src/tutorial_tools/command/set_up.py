"""Set up what ./tutorial needs beside Debian packages: catkin workspaces, and what PyPI has.

set_up.py WORKSPACE [workspace] [student=PATH] [pypi=NAME:FILE] [maybe=NAME:FILE]
"""

from __future__ import annotations

import filecmp
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

from tutorial_tools.command.build import (
    REPOSITORY,
    BuildError,
    build_student,
    build_workspace,
    is_built,
    one_at_a_time,
    say,
)


def is_done(workspace: Path, part: str) -> bool:
    """Whether a part of the command line has nothing to do, so that this need not be started."""
    kind, _, value = part.partition("=")
    if kind == "workspace":
        return is_built(workspace)
    if kind not in ("pypi", "maybe"):
        return False
    name, requirements = value.split(":")
    return is_same(workspace / name / "installed", REPOSITORY / requirements)


def is_same(kept: Path, requirements: Path) -> bool:
    """Whether a file is a copy of the requirements."""
    return kept.exists() and filecmp.cmp(requirements, kept, shallow=False)


def install_from_pypi(workspace: Path, name: str, requirements: str) -> None:
    """Make a virtual environment with what a file of requirements names."""
    folder, wanted, log = workspace / name, REPOSITORY / requirements, workspace / "pip.log"
    with one_at_a_time(workspace):
        if is_same(folder / "installed", wanted):
            return
        say(f"installing from PyPI what {requirements} names")
        venv = ["/usr/bin/python3", "-m", "venv", "--clear", "--system-site-packages", str(folder)]
        subprocess.run(venv, check=True)
        pip = [f"{folder}/bin/python", "-m", "pip", "install", "-q", "--disable-pip-version-check"]
        with open(log, "w", encoding="utf-8") as file:
            command = [*pip, "-r", str(wanted)]
            done = subprocess.run(command, check=False, stdout=file, stderr=file)
        if done.returncode:
            errors = [line for line in log.read_text().splitlines() if line.startswith("ERROR")]
            print(*errors[:3], sep="\n", file=sys.stderr)
            names = " ".join(dict.fromkeys(re.findall(r"^([a-z-]+)==", wanted.read_text(), re.M)))
            todo = "then run ./tutorial setup again: it goes on where it stopped"
            raise BuildError(f"not installed from PyPI: {names}. Check the network ({log}), {todo}")
        shutil.copy(wanted, folder / "installed")


def install_if_possible(workspace: Path, name: str, requirements: str) -> None:
    """Install from PyPI for a shell, which does without: a failure is reported once."""
    failed, wanted = workspace / "not_from_pypi", REPOSITORY / requirements
    if is_same(failed, wanted):
        return
    try:
        install_from_pypi(workspace, name, requirements)
    except BuildError as error:
        say(str(error))
        say("all but replay_bag works without")
        shutil.copy(wanted, failed)


def main() -> None:
    """Build the parts that the command line names, in its order."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    workspace, *parts = Path(sys.argv[1]), *sys.argv[2:]
    for part in parts:
        kind, _, value = part.partition("=")
        try:
            if kind == "workspace":
                build_workspace(workspace)
            elif kind == "student":
                build_student(workspace, Path(value))
            elif kind == "pypi":
                install_from_pypi(workspace, *value.split(":"))
            else:
                install_if_possible(workspace, *value.split(":"))
        except BuildError as error:
            sys.exit(f"tutorial: {error}")


if __name__ == "__main__":
    main()
