"""Builds what ./tutorial needs beside Debian packages: catkin workspaces, packages of PyPI.

Parts: workspace, student=PATH, pypi=NAME:FILE, maybe=NAME:FILE, alone=NAME:FILE.
"""

from __future__ import annotations

import contextlib
import filecmp
import hashlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from node_kit.io.machine import in_container
from node_kit.manifests import broken_manifests, manifests
from tutorial_tools.command.build_errors import first_errors
from tutorial_tools.command.requirements import names_of
from tutorial_tools.errors import SetUpError
from tutorial_tools.hidden_stand_ins import hidden_stand_ins
from tutorial_tools.io.command.lock import one_at_a_time
from tutorial_tools.io.system.apt import say
from tutorial_tools.paths import PREFIX, REPOSITORY, SHARE
from tutorial_tools.rqt_windows import MODEL, TABS, make_rqt

OVERLAY = ("beginner_tutorials", "joy2twist", "test")  # the solutions
# Commands of `./tutorial shell`, by these names.
COMMANDS = ("common/tutorial_tools/scripts/2to3", "tutorial")


def stamp() -> str:
    """Return a checksum of what catkin reads; it uses the Python modules in place."""
    checksum = hashlib.sha1(f"{sys.version} {PREFIX} {COMMANDS} {TABS} {real_packages()}".encode())
    for depth in ("*", "common/*", "common/stand_ins/*"):
        for name in ("CMakeLists.txt", "package.xml", "setup.py"):
            for path in sorted(REPOSITORY.glob(f"{depth}/{name}")):
                checksum.update(path.read_bytes())
    for path in sorted((REPOSITORY / MODEL / "scripts").iterdir()):  # make_rqt() copies them.
        checksum.update(path.read_bytes())
    for suffix in (".py", ".test"):  # as test/CMakeLists.txt looks for them
        for path in sorted(REPOSITORY.glob(f"test/*/ros/*{suffix}")):
            checksum.update(str(path.relative_to(REPOSITORY)).encode())
    return checksum.hexdigest()


def real_packages() -> list[str]:
    """Return the installed packages that replace a stand-in."""
    stand_ins = (path.parent.name for path in manifests(REPOSITORY / "common/stand_ins"))
    names = {*TABS, *stand_ins}
    return sorted(name for name in names if (SHARE / name / "package.xml").exists())


def clean_catkin_make(below: Path | None, folder: Path, log: Path) -> bool:
    """Run catkin_make over another workspace, in a clean environment; return its success."""
    hidden = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "PYTHONPATH")
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    environment.update(PATH="/usr/bin:/bin", LC_ALL="C.UTF-8")  # Its output is parsed.
    make = 'catkin_make -C "$1" -DPYTHON_EXECUTABLE=/usr/bin/python3'
    script = f'. "$0"; {make}' if below else make
    with open(log, "a", encoding="utf-8") as file:
        command = ["bash", "-c", script, str(below or "bash"), str(folder)]
        done = subprocess.run(command, check=False, env=environment, stdout=file, stderr=file)
    return done.returncode == 0


def is_built(workspace: Path) -> bool:
    """Return whether the workspaces were built from the present files."""
    built = workspace / "built"
    return built.exists() and built.read_text().strip() == stamp()


def link_packages(workspace: Path, packages: Sequence[str | Path]) -> None:
    """Link exactly these packages into the src of a workspace."""
    src, names = workspace / "src", {Path(package).name for package in packages}
    if {path.name for path in src.glob("*")} - {"CMakeLists.txt"} != names:
        remove_built(workspace)  # nothing of a removed package may remain
    link(src, packages)


def link(folder: Path, targets: Iterable[str | Path]) -> None:
    """Link these files of the repository into a folder, in place of older links."""
    folder.mkdir(parents=True, exist_ok=True)
    for target in targets:
        path = folder / Path(target).name
        with contextlib.suppress(FileNotFoundError):
            path.unlink()
        path.symlink_to(REPOSITORY / target)


def remove_built(workspace: Path) -> None:
    """Remove what catkin has built, and the links."""
    for name in ("src", "build", "devel"):
        shutil.rmtree(workspace / name, ignore_errors=True)


def build_workspace(workspace: Path) -> None:
    """Build the underlay and the overlay if a file that catkin reads has changed."""
    if re.search(r"\s", str(workspace)):
        todo = "set TUTORIAL_WORKSPACE to a path without spaces"
        raise SetUpError(f"catkin cannot build in {workspace}: {todo}")
    with one_at_a_time(workspace):
        if not is_built(workspace):
            build_both(workspace)


def build_both(workspace: Path) -> None:
    """Build the underlay and the overlay."""
    built, log, lower = stamp(), workspace / "build.log", workspace / "lower"
    say(f"building the catkin workspaces in {workspace}, for a minute or two")
    if os.environ.get("SUDO_USER") and not os.environ.get("TUTORIAL_WORKSPACE"):
        own = f"{os.environ['SUDO_USER']}'s own calls do not use"
        say(f"   which {own}: call ./tutorial without sudo, it asks for it itself")
    # The underlay, which students use and never write; stand-ins only for what is not installed.
    real = real_packages()
    common = [path.parent for path in manifests(REPOSITORY / "common")]
    common = [package for package in common if package.name not in real]
    with contextlib.suppress(FileNotFoundError):
        (workspace / "built").unlink()  # not valid from here on
    rqt = list(make_rqt(REPOSITORY, real, workspace / "rqt"))
    made = [program.parents[1] for program in rqt]
    link_packages(lower, [REPOSITORY / "fake_turtlebot_sim", *common, *made])
    if not (lower / "devel").exists():
        remove_built(workspace)  # a package may have moved between the two
    link_packages(workspace, OVERLAY)
    link(workspace / "bin", [*COMMANDS, *rqt])
    with contextlib.suppress(FileExistsError):  # for programs with #!/usr/bin/env python
        (workspace / "bin" / "python").symlink_to("/usr/bin/python3")
    log.write_text("")
    below = Path(PREFIX, "setup.bash") if PREFIX else None
    is_lower_built = clean_catkin_make(below, lower, log)
    if not is_lower_built or not clean_catkin_make(lower / "devel/setup.bash", workspace, log):
        print(*log.read_text().splitlines()[-15:], sep="\n", file=sys.stderr)
        raise SetUpError(f"catkin_make failed; {log} has all of it")
    (workspace / "built").write_text(f"{built}\n")


def _of_another(student: Path) -> str:
    """Return what to do about a folder that is another user's; "" if it is not."""
    owner = student.stat() if student.is_dir() else None
    if owner is None or owner.st_uid == os.geteuid():
        return ""
    why = f"belongs to user {owner.st_uid}, and you are {os.geteuid()}: choose a folder of yours"
    if in_container():
        why += f", or, before docker compose: export STUDENT={owner.st_uid}:{owner.st_gid}"
    return why


def why_no_workspace(workspace: Path, student: Path) -> str:
    """Make the src of a student's workspace; return why it cannot be one, or ""."""
    if re.search(r"\s", str(student)):
        return "catkin cannot build in it: choose a path without spaces"
    if student.name == "src" and (student.parent / "devel").exists():
        return f"this is the src folder; give the workspace, {student.parent}"
    if (student / "package.xml").exists():
        return "this is a package; give the workspace that has it in src"
    if {REPOSITORY, workspace} & {student, *student.parents}:
        return "this is the suite's own; choose a folder of yours"
    with contextlib.suppress(OSError):
        (student / "src").mkdir(parents=True, exist_ok=True)
        if os.access(student, os.W_OK):
            return ""
    return _of_another(student) or "cannot be made: choose a folder of yours"


def build_student(workspace: Path, student: Path) -> None:
    """Make and build a student's workspace over the underlay; report mistakes in it."""
    refused = why_no_workspace(workspace, student)
    if refused:
        raise SetUpError(f"--in {student}: {refused}")
    for seen, todo in hidden_stand_ins(student, REPOSITORY, SHARE):
        say(f"{seen}: {todo}")
    with one_at_a_time(workspace):
        if not (student / "devel" / "setup.bash").exists():
            build_new(workspace, student)
            return
    for path, why in broken_manifests(str(student / "src"))[:1]:
        say(f"{path}: {why}; until that is fixed no ROS program starts in {student}")
    made = made_over(student)
    if f"{workspace}/lower/devel" not in made and not is_over_prefix(made):
        other = re.search("([^';]*)/lower/devel", made)
        over = f", over another copy of it in {other[1]}" if other else ""
        todo = f"in the shell, cd {student}; rm -r build devel; catkin_make"
        say(f"{student} was built without this suite{over}: {todo}")


def made_over(student: Path) -> str:
    """Return catkin's file that lists the workspaces below this one; "" if there is none."""
    util = student / "devel" / "_setup_util.py"
    return util.read_text(errors="replace") if util.exists() else ""


def is_over_prefix(made: str) -> bool:
    """Return whether a workspace was built over a ROS in /opt/ros without this suite."""
    return bool(PREFIX) and PREFIX in made and "/lower/devel" not in made


def build_new(workspace: Path, student: Path) -> None:
    """Build a student's workspace for the first time."""
    say(f"building {student}")
    log = workspace / "student.log"
    log.write_text("")
    # catkin's setup.bash leaves this folder out if it is missing; messages may come later.
    (student / "devel/lib/python3/dist-packages").mkdir(parents=True, exist_ok=True)
    if not clean_catkin_make(workspace / "lower" / "devel" / "setup.bash", student, log):
        lines = log.read_text(errors="replace").splitlines()
        for line in first_errors(lines):
            print(f"   {line}", file=sys.stderr)
        todo = f"fix what is said above, then catkin_make in it ({log} has all)"
        say(f"{student} does not build: {todo}")


def is_done(workspace: Path, part: str) -> bool:
    """Return whether a part needs no build."""
    kind, _, value = part.partition("=")
    if kind in ("workspace", "student"):
        return kind == "workspace" and is_built(workspace)
    name, _ = value.split(":")
    return is_same(workspace / name / "installed", lock_of(name))


def lock_of(name: str) -> Path:
    """Return the file of releases and hashes that pip may install, which test/lock writes."""
    return REPOSITORY / "test" / "locks" / f"{name}.txt"


def is_same(kept: Path, lock: Path) -> bool:
    """Return whether a file is a copy of the lock."""
    return kept.exists() and filecmp.cmp(lock, kept, shallow=False)


def install_from_pypi(workspace: Path, name: str, requirements: str, kind: str) -> None:
    """Make a virtual environment with the requirements of a file, in the releases of its lock.

    kind: "pypi"; "alone", without Debian's packages; or "maybe", for a shell, which also works
    without them: a failure is reported once.
    """
    needed = kind != "maybe"
    folder, wanted, log = workspace / name, lock_of(name), workspace / "pip.log"
    failed = workspace / "not_from_pypi"
    with one_at_a_time(workspace):
        if is_same(folder / "installed", wanted) or (not needed and is_same(failed, wanted)):
            return
        names = " ".join(names_of((REPOSITORY / requirements).read_text(), sys.version_info[1]))
        say(f"installing from PyPI what Debian lacks: {names}")
        shared = [] if kind == "alone" else ["--system-site-packages"]
        venv = ["/usr/bin/python3", "-m", "venv", "--clear", *shared, str(folder)]
        subprocess.run(venv, check=True)
        pip = [f"{folder}/bin/python", "-m", "pip", "install", "-q", "--disable-pip-version-check"]
        with open(log, "w", encoding="utf-8") as file:
            # A lock has all that Debian lacks; Selenium comes with Debian's browsers.
            command = [*pip, "--require-hashes", "--no-deps", "-r", str(wanted)]
            done = subprocess.run(command, check=False, stdout=file, stderr=file)
        if not done.returncode:
            shutil.copyfile(wanted, folder / "installed")
            return
        todo = "then run ./tutorial setup again: it goes on where it stopped"
        line = f"not installed from PyPI: {names}. Check the network ({log}), {todo}"
        if needed:
            errors = [line for line in log.read_text().splitlines() if line.startswith("ERROR")]
            print(*errors[:3], sep="\n", file=sys.stderr)
            raise SetUpError(line)
        without = "replay_bag does not work, and ./tutorial check names no line of C++"
        say(f"{line}\ntutorial: without it {without}; everything else works")
        shutil.copyfile(wanted, failed)


def build(workspace: Path, part: str) -> None:
    """Build one part. Raises SetUpError."""
    kind, _, value = part.partition("=")
    if kind == "workspace":
        build_workspace(workspace)
    elif kind == "student":
        build_student(workspace, Path(value))
    else:
        name, requirements = value.split(":")
        install_from_pypi(workspace, name, requirements, kind)
