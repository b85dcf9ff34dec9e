"""Sets up what a subcommand of ./tutorial needs, then runs its command."""

from __future__ import annotations

import os
import platform
import shutil
import signal
import subprocess
import sys
from pathlib import Path

from tutorial_tools.command import plans
from tutorial_tools.command.downloads import Download
from tutorial_tools.command.subcommands import fail
from tutorial_tools.errors import SetUpError
from tutorial_tools.io.command.build import build, is_done
from tutorial_tools.io.command.charts import fetch_charts
from tutorial_tools.io.command.environment import environment_of, environment_of_help
from tutorial_tools.io.system.apt import not_installed, say
from tutorial_tools.io.system.packages import DONE, install, packages

NO_VERDICT = "check: nothing was checked; this says nothing about your exercises"


def set_up(plan: plans.Plan, workspace: Path, again: bool) -> None:
    """Install and build what a plan needs. Raises SetUpError."""
    if plan["sections"] == ["doctor"]:  # which must answer at once
        missing = not_installed(packages("demo"))
        if missing:
            why = f"{len(missing)} Debian packages are missing, such as {missing[0]}"
            todo = "./tutorial setup installs them"
            raise SetUpError(f"doctor: nothing can drive: {why}; {todo}")
    else:
        install(packages(*plan["sections"]), workspace, again)
    for part in plan["builds"]:
        if not is_done(workspace, part):
            build(workspace, part)
    if "workspace" in plan["builds"]:
        fetch_charts(workspace, again)


def confirm(workspace: Path, download: Download, yes: bool) -> None:
    """Ask whether to install a download, if it is missing. Raises ValueError with one line."""
    if is_done(workspace, download.build):
        return
    refused = download.why_no_wheels(platform.machine(), sys.version_info[:2])
    if refused:
        raise ValueError(refused)
    if yes:
        return
    name, size = download.name, download.size
    if not sys.stdin.isatty():
        raise ValueError(f"{size} from PyPI have to be installed: ./tutorial {name} --yes ...")
    into = f"{size} from PyPI, into {workspace / name}"
    question = f"tutorial: {download.what} is {into}. Install it? [y/N] "
    print(question, end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in ("y", "yes"):
        raise ValueError("nothing was installed")


def main(workspace: Path, typed: list[str]) -> None:
    """Do what the user typed. Raises SetUpError."""
    plan = plans.read(workspace, typed, lambda *what: confirm(workspace, *what))
    if plan is None:
        return
    word, student = typed[0], "".join(plan.get("student", []))
    try:
        set_up(plan, workspace, again=word == "setup")
    except (SetUpError, OSError, subprocess.SubprocessError) as error:
        if word != "check":
            raise
        say(str(error))
        print(NO_VERDICT, file=sys.stderr)
        sys.exit(2)  # 1 means that an exercise is wrong
    if word == "setup":
        say(DONE)
        return
    is_help = not plan["builds"]
    environment = environment_of_help() if is_help else environment_of(workspace, word, student)
    if word == "shell" and student:
        src = f"{student}/src, where the handout has ~/ros/hydro/catkin_ws/src"
        say(f'packages go into {src}; "tutorial check" checks what is there, from any folder')
    if word == "shell" and not environment.get("DISPLAY"):
        say("no screen for RViz here: tutorial cockpit shows the robots in a browser")
    become(word, plan["command"], environment)


def become(word: str, command: list[str], environment: dict[str, str]) -> None:
    """Replace this program with a command; bash also runs files without a #! line."""
    if not shutil.which(command[0], path=environment["PATH"]):
        fail(f'{word}: there is no command "{command[0]}"')
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    os.execve("/bin/bash", ["bash", "-c", 'exec -- "$@"', "bash", *command], environment)
