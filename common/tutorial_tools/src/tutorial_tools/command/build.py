"""Build the catkin workspaces of ./tutorial, and a student's."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from node_kit.manifests import broken_manifests

REPOSITORY = Path(__file__).resolve().parents[5]
# The prefix of a ROS that is not the system's own, as ./tutorial has found it.
PREFIX = os.environ.get("TUTORIAL_ROS", "")
# The underlay: what a student uses and never writes; stand-ins only for what is not installed.
LOWER = (
    "common/cockpit", "common/gamepad", "common/node_kit", "common/tutorial_check",
    "common/tutorial_tools", "fake_turtlebot_sim",
)  # fmt: skip
STAND_INS = ("joy", "rbx1_bringup", "rbx1_nav", "turtlebot_bringup", "turtlebot_rviz_launchers")
UPPER = ("beginner_tutorials", "joy2twist", "test")  # the overlay: the solutions
# Commands of the shell, under these names.
SCRIPTS = "common/tutorial_tools/scripts"
COMMANDS = (f"{SCRIPTS}/rqt_graph", f"{SCRIPTS}/rqt_bag", "tutorial")
WRONG = re.compile("rror|invalid|mismatched|not found")


class BuildError(Exception):
    """Why nothing can be built, in one line for the user."""


def say(line: str) -> None:
    """Report to the user."""
    print(f"tutorial: {line}", file=sys.stderr, flush=True)


def stamp() -> str:
    """Return a checksum of what catkin reads; the Python files themselves are used in place."""
    found = hashlib.sha1(f"{sys.version} {PREFIX} {COMMANDS}".encode())
    for depth in ("*", "common/*", "common/stand_ins/*"):
        for name in ("CMakeLists.txt", "package.xml", "setup.py"):
            for path in sorted(REPOSITORY.glob(f"{depth}/{name}")):
                found.update(path.read_bytes())
    for path in sorted(REPOSITORY.glob("test/ros/*/*.test")):
        found.update(str(path.relative_to(REPOSITORY)).encode())
    return found.hexdigest()


def clean_catkin_make(below: Path | None, folder: Path, log: Path) -> bool:
    """Whether catkin_make succeeds over another workspace; with no other Python or workspace."""
    hidden = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH")
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    environment["PATH"] = "/usr/bin:/bin"
    make = 'catkin_make -C "$1" -DPYTHON_EXECUTABLE=/usr/bin/python3'
    script = f'. "$0"; {make}' if below else make
    with open(log, "a", encoding="utf-8") as file:
        command = ["bash", "-c", script, str(below or "bash"), str(folder)]
        done = subprocess.run(command, check=False, env=environment, stdout=file, stderr=file)
    return done.returncode == 0


@contextlib.contextmanager
def one_at_a_time(workspace: Path) -> Iterator[None]:
    """Of two calls at once let one do the work, and the other wait and find it done."""
    workspace.mkdir(parents=True, exist_ok=True)
    with open(workspace / "lock", "w", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def is_built(workspace: Path) -> bool:
    """Whether the workspaces are built of what is there now."""
    built = workspace / "built"
    return built.exists() and built.read_text().strip() == stamp()


def is_installed(package: str) -> bool:
    """Whether a package is there without this suite."""
    folders = f"{PREFIX or '/usr'}/share"
    environment = {**os.environ, "ROS_PACKAGE_PATH": folders}
    environment.pop("CMAKE_PREFIX_PATH", None)
    command = ["rospack", "find", package]
    return not subprocess.run(command, check=False, env=environment, capture_output=True).returncode


def link_packages(workspace: Path, packages: list[str]) -> None:
    """Have exactly these packages in the src of a workspace, as links."""
    links = {Path(package).name: REPOSITORY / package for package in packages}
    src = workspace / "src"
    if {path.name for path in src.glob("*")} - {"CMakeLists.txt"} != set(links):
        remove_built(workspace)  # what a removed package left would still be found
    src.mkdir(parents=True, exist_ok=True)
    for name, target in links.items():
        link(src / name, target)


def link(path: Path, target: Path | str) -> None:
    """Make a symbolic link, in place of another one."""
    with contextlib.suppress(FileNotFoundError):
        path.unlink()
    path.symlink_to(target)


def remove_built(workspace: Path) -> None:
    """Remove what catkin has made, and the links."""
    for name in ("src", "build", "devel"):
        shutil.rmtree(workspace / name, ignore_errors=True)


def build_workspace(workspace: Path) -> None:
    """Build the underlay and the overlay if a file that catkin reads has changed."""
    if re.search(r"\s", str(workspace)):
        todo = "set TUTORIAL_WORKSPACE to a path without spaces"
        raise BuildError(f"catkin cannot build in {workspace}: {todo}")
    if is_built(workspace):
        return
    with one_at_a_time(workspace):
        if not is_built(workspace):
            build_both(workspace)


def build_both(workspace: Path) -> None:
    """Build the underlay and the overlay."""
    built, log, lower = stamp(), workspace / "build.log", workspace / "lower"
    say(f"building the catkin workspaces in {workspace}")
    warn_of_caches(workspace)
    stand_ins = [f"common/stand_ins/{name}" for name in STAND_INS if not is_installed(name)]
    with contextlib.suppress(FileNotFoundError):
        (workspace / "built").unlink()  # what it stands for changes from here on
    link_packages(lower, [*LOWER, *stand_ins])
    if not (lower / "devel").exists():
        remove_built(workspace)  # a package may have moved between the two
    link_packages(workspace, list(UPPER))
    (workspace / "bin").mkdir(exist_ok=True)
    link(workspace / "bin" / "python", "/usr/bin/python3")  # for programs with "env python"
    for command in COMMANDS:
        link(workspace / "bin" / Path(command).name, REPOSITORY / command)
    log.write_text("")
    below = Path(PREFIX, "setup.bash") if PREFIX else None
    if not (
        clean_catkin_make(below, lower, log)
        and clean_catkin_make(lower / "devel" / "setup.bash", workspace, log)
    ):
        print(*log.read_text().splitlines()[-15:], sep="\n", file=sys.stderr)
        raise BuildError(f"catkin_make failed; {log} has all of it")
    keep_environment(workspace)
    (workspace / "built").write_text(f"{built}\n")


def warn_of_caches(workspace: Path) -> None:
    """Report a cache that sudo makes, and those of clones that were moved or removed."""
    if os.environ.get("TUTORIAL_WORKSPACE"):
        return
    if os.environ.get("SUDO_USER"):
        own = f"{os.environ['SUDO_USER']}'s own calls do not use"
        say(f"   which {own}: call ./tutorial without sudo, it asks for it itself")
    for old in workspace.parent.glob("*"):
        package = old / "src" / "test"
        if package.is_symlink() and not package.exists():
            say(f"   those of a clone that was moved or removed are still there: rm -r {old}")


def keep_environment(workspace: Path) -> None:
    """Write down what setup.bash sets: its programs need a tenth of a second at every start."""
    command = ["bash", "-c", '. "$0" && env -0', str(workspace / "devel" / "setup.bash")]
    clean = {"PATH": "/usr/bin:/bin"}
    done = subprocess.run(command, check=True, env=clean, capture_output=True, text=True)
    lines = []
    for name, _, value in (entry.partition("=") for entry in done.stdout.split("\0")):
        if name in ("PATH", "PYTHONPATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH"):
            lines.append(f'export {name}={shlex.quote(value)}"${{{name}:+:${name}}}"')
        elif name == "ROS_MASTER_URI":
            lines.append(f'export {name}="${{{name}:-{value}}}"')
        elif name == "CMAKE_PREFIX_PATH" or name.startswith("ROS_"):
            lines.append(f"export {name}={shlex.quote(value)}")
    (workspace / "environment").write_text("\n".join(lines) + "\n")


def check_student(workspace: Path, student: Path) -> None:
    """Raise BuildError if a folder cannot be a student's workspace."""
    why = ""
    if re.search(r"\s", str(student)):
        raise BuildError(f"catkin cannot build in {student}: choose a path without spaces")
    if student.name == "src" and (student.parent / "devel").exists():
        why = f"this is the src folder; give the workspace, {student.parent}"
    elif (student / "package.xml").exists():
        why = "this is a package; give the workspace that has it in src"
    elif {REPOSITORY, workspace} & {student, *student.parents}:
        why = "this is the suite's own; choose a folder of yours"
    else:
        try:
            (student / "src").mkdir(parents=True, exist_ok=True)
        except OSError:
            why = "cannot be made: choose a folder of yours"
    if why:
        raise BuildError(f"--in {student}: {why}")


def build_student(workspace: Path, student: Path) -> None:
    """Make and build a student's workspace over the underlay. A mistake in it is only reported."""
    check_student(workspace, student)
    if not (student / "devel" / "setup.bash").exists():
        with one_at_a_time(workspace):
            if not (student / "devel" / "setup.bash").exists():
                build_new(workspace, student)
        return
    broken = broken_manifests(str(student / "src"))
    for path, why in broken[:1]:
        say(f"{path}: {why}; until that is mended no ROS program starts in {student}")
    util = student / "devel" / "_setup_util.py"
    made = util.read_text(errors="replace") if util.exists() else ""
    if f"{workspace}/lower/devel" not in made:
        other = re.search("([^';]*)/lower/devel", made)
        over = f", over another copy of it in {other[1]}" if other else ""
        todo = f"in the shell, cd {student}; rm -r build devel; catkin_make"
        say(f"{student} was built without this suite{over}: {todo}")


def build_new(workspace: Path, student: Path) -> None:
    """Build a student's workspace for the first time."""
    say(f"building {student}")
    log = workspace / "student.log"
    log.write_text("")
    if not clean_catkin_make(workspace / "lower" / "devel" / "setup.bash", student, log):
        lines = log.read_text(errors="replace").splitlines()
        for line in [line for line in lines if WRONG.search(line)][:5] or lines[-1:]:
            print(f"   {line}", file=sys.stderr)
        todo = f"mend what is said above, then catkin_make in it ({log} has all)"
        say(f"{student} does not build: {todo}")
