"""All that the checks of one workspace share: the copy, its environment, stages to play on."""

from __future__ import annotations

import os
import re
import shlex
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, Iterator, Tuple, TypeVar

from tutorial_check.isolation.environment import environment_of
from tutorial_check.isolation.program import Program
from tutorial_check.isolation.runner import Runner
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.source import student_files
from tutorial_check.source.manifests import (
    first_broken,
    is_stand_in,
    must_be_launchable,
    unreadable,
)
from tutorial_check.source.python_facts import PythonFacts
from tutorial_check.source.workspace import SOLUTIONS, Layout, Package, packages_below
from tutorial_check.variants import Task

SLOW_S = 120  # [s] for what needs a second, when the machine is very busy
# What of CMakeLists.txt makes a build necessary before anything can run.
NEEDS_BUILD = re.compile(
    r"^[ \t]*(catkin_python_setup|add_message_files|add_service_files|generate_messages"
    r"|add_executable|catkin_install_python)\s*\(",
    re.MULTILINE | re.IGNORECASE,
)
Recorded = TypeVar("Recorded")
Recorder = Callable[..., Recorded]  # of a ground.Ground and arguments
Memory = Dict[object, Tuple[Any, Any]]  # {key: (value, what was raised in place of one)}


def _once(memory: Memory, key: object, make: Callable[[], Any]) -> Any:
    if key not in memory:
        try:
            memory[key] = make(), None
        except Wrong as wrong:
            memory[key] = None, wrong
    value, error = memory[key]
    if error:
        raise error
    return value


class Session:
    """One workspace, copied to folder/ws, and the runner in which its programs run."""

    def __init__(
        self,
        folder: str | Path,
        layout: Layout,
        exercises: Iterable[str],
        runner: Runner,
        *,
        underlay: str,
        can_have_devices: bool,
        needed: Iterable[str | Path] = (),
        task: Any = None,
    ) -> None:
        """underlay: its setup.bash; needed: what of the suite the student's launch files lead to.

        task: of this student; see variants.Task.
        """
        self.task: Any = task or Task({})  # of the course
        self.folder, self.layout, self.runner = Path(folder), layout, runner
        self.source = self.folder / "ws" / "src"
        self.exercises = frozenset(exercises)  # that are asked for
        self.underlay, self.underlay_environment = underlay, runner.environment
        self.can_have_devices = can_have_devices
        self._needed = [Path(each) for each in needed]
        self._memory: Memory = {}
        self._runs: Memory = {}
        self._siblings = 0
        self.unbuilt = ""  # what catkin_make said of packages that the exercises do not need

    def memo(self, key: object, make: Callable[[], Any]) -> Any:
        """Return make(), called once; what it raised is raised again. For facts, which do not change."""
        return _once(self._memory, key, make)

    def run(self, key: object, make: Callable[[], Any]) -> Any:
        """Do the same for what programs were seen to do, which may be looked at again."""
        return _once(self._runs, key, make)

    def recording(self, recorder: Recorder[Recorded], *arguments: object) -> Recorded:
        """Return what a recorder writes down; recorded once, unless it is looked at again."""
        raise NotImplementedError

    def second_look(self, explained: bool) -> bool:
        """Return whether to look again at what programs do; then forget what they did.

        It is worth it if the machine was busy, or if no line explains it: nodes of a launch file meet
        in any order; and a Ctrl-C that meets rospy in the middle of a publish of the main thread may
        wait without end for a lock of that thread.
        """
        if explained and not self.runner.clock.strained():
            return False
        self._runs.clear()
        return True

    # ---------------------------------------------------------------- the student's packages

    def must_be_startable(self) -> None:
        """Raise Wrong for a package.xml that keeps every node from starting."""
        broken = self.memo("broken", lambda: first_broken(self.source, self.packages))
        if broken:
            raise unreadable(broken)

    def must_be_launchable(self) -> None:
        """Raise Wrong for a package.xml that keeps roslaunch from starting anything."""
        self.must_be_startable()
        must_be_launchable(self.packages)

    @cached_property
    def packages(self) -> list[Package]:
        """In the order of their paths, by the names that the checks know."""
        every = packages_below(self.source)
        return [replace(each, name=self.task.known_as(each.name)) for each in every]

    def package(self, name: str) -> Any:
        return next((each for each in self.packages if each.name == name), None)

    def scripts(self, name: str) -> Any:
        """Return {path within the package: PythonFacts} of the Python programs of a package."""
        return self.memo(("scripts", name), lambda: dict(self._scripts(self.package(name))))

    def _scripts(self, package: Package | None) -> Iterator[tuple[str, PythonFacts]]:
        if package is None:
            return
        for path in sorted(package.folder.rglob("*")):
            inside = path.relative_to(package.folder)
            # What editors and file managers keep for themselves is hidden.
            if not path.is_file() or any(part.startswith(".") for part in inside.parts):
                continue
            is_python = path.suffix == ".py"
            if not path.suffix:
                with path.open("rb") as file:
                    is_python = file.read(2) == b"#!" and b"python" in file.readline()
            if is_python and path.name not in ("setup.py", "__init__.py"):
                yield str(inside), PythonFacts(self.read(path))

    def read(self, path: Path) -> str:
        """Return the text of a file of the student's, or of a program of theirs. Raises CannotCheck."""
        return student_files.read(self.folder, path).decode(errors="replace")

    def text(self, package: str, script: str) -> str:
        """Return the text of a script, its line ends as they are."""
        return self.read(self.package(package).folder / script)

    def whole(self, path: str, package: str = "") -> str:
        """Return a path of the workspace, or within a package, for a command of a shell in any folder.

        It is that of the copy, in whose place examine puts the student's own, where it knows that.
        """
        own = self.package(package).folder if package else self.source.parent
        return shlex.quote(str(own / path))

    def sibling(self, package: str, script: str, text: str) -> str:
        """Write a changed copy of a script beside it, so that its imports work; return its path there."""
        original = self.package(package).folder / script
        self._siblings += 1
        changed = original.with_name(f"checked_{self._siblings}_{original.name}")
        student_files.put(self.folder, changed, text, 0o755)
        return str(Path(script).with_name(changed.name))

    # ------------------------------------------------------------------------- environment

    def _ended(self, *command: str) -> tuple[Program, bool]:
        """Return a program that was run, and whether it ended by itself."""
        program = self.runner.start(command)
        ended = self.runner.wait(lambda: program.ended, SLOW_S)
        self.runner.end(program)
        return program, ended

    def built(self) -> Any:
        """Return (catkin_make's exit code, its output); made once."""
        return self.memo("built", self._build)

    def _build(self) -> tuple[int | None, str]:
        """Build all, or if that fails what the exercises need: others may need what Debian lacks."""
        code, output = self._made()
        names = [self.task.named(each.name) for each in self.needed]
        if code == 0 or len(names) == len(self.packages):
            return code, output
        found = self._made(f"-DCATKIN_WHITELIST_PACKAGES={';'.join(names)}")
        if found[0] != 0:
            return code, output
        self.unbuilt = output or " "
        for each in self.packages:  # the suite's own takes the place of such a one
            if is_stand_in(each.name):
                student_files.put(self.folder, each.folder / "CATKIN_IGNORE", "")
        return found

    def _made(self, *words: str) -> tuple[int | None, str]:
        python = "-DPYTHON_EXECUTABLE=/usr/bin/python3"
        program, ended = self._ended("catkin_make", "-C", str(self.folder / "ws"), python, *words)
        if program.process.returncode != 0:
            self.must_reach_underlay()
        return (program.process.returncode if ended else None), program.output

    @property
    def needed(self) -> list[Package]:
        """The packages of the exercises, and those of the workspace that they depend on."""
        found, names = [], set(SOLUTIONS)
        for _ in self.packages:
            found = [each for each in self.packages if each.name in names]
            names |= {name for each in found for name in each.depends}
        return found or self.packages

    # As root, this process opens files with the rights of the user that runs the student's programs.

    def must_start_programs(self) -> None:
        """Raise CannotCheck if no program can be started in this folder."""
        try:
            os.stat(f"{self.folder}/.")
            why = "noexec" if os.statvfs(self.folder).f_flag & os.ST_NOEXEC else ""
        except OSError as error:
            why = str(error.strerror)
        if why:
            how = "set TMPDIR to a folder that others may enter, and that is not mounted noexec"
            raise CannotCheck(f"no program can be started in {self.folder.parent} ({why}): {how}")

    def must_reach_underlay(self) -> None:
        """Raise CannotCheck if the student's programs cannot read what is the suite's."""
        for folder in (f for one in self._needed for f in (*reversed(one.parents), one)):
            try:
                os.stat(f"{folder}/.")
            except (NotADirectoryError, FileNotFoundError):
                continue
            except PermissionError:
                # What lies below a needed one is as closed; but a home folder is opened no further.
                is_needed = set(self._needed) & {folder, *folder.parents}
                how = f"{'chmod -R o+rX' if is_needed else 'chmod o+x'} {folder}"
                raise CannotCheck(
                    f"{folder} is closed to others, as one of whom the programs run: {how},"
                    " or keep this suite, and TUTORIAL_WORKSPACE, where others may enter"
                ) from None

    def _needs_build(self) -> bool:
        return any(NEEDS_BUILD.search(each.cmake or "") for each in self.packages)

    @property
    def lacks_build(self) -> bool:
        """Whether the programs run without what catkin_make should have made for them."""
        return self._needs_build() and self.built()[0] != 0

    @cached_property
    def environment(self) -> dict[str, str]:
        """In which the student's programs find their packages before all others."""
        if self._needs_build() and self.built()[0] == 0:
            found = self._sourced(self.folder / "ws" / "devel" / "setup.bash")
        else:
            found = dict(self.underlay_environment)
            own = {"CMAKE_PREFIX_PATH": self.folder / "devel", "ROS_PACKAGE_PATH": self.source}
            for name, path in own.items():
                found[name] = f"{path}:{found.get(name, '')}".rstrip(":")
        found["CMAKE_PREFIX_PATH"] = f"{self.folder / 'view'}:{found['CMAKE_PREFIX_PATH']}"
        return found

    def _sourced(self, setup: Path) -> dict[str, str]:
        """Return the environment after a setup.bash, which runs like a program of the student's."""
        # What is printed before the first \0 is no variable.
        source = '. "$1" >/dev/null && printf "\\0" && env -0'
        program, _ = self._ended("bash", "-c", source, "bash", str(setup))
        printed, *variables = program.output.split("\0")
        if program.process.returncode != 0 or not variables:
            raise CannotCheck(f"{setup} cannot be sourced: {' '.join(printed[-200:].split())}")
        return environment_of(variables)

    def command(self, package: str, script: str) -> list[str]:
        """Return the command that starts a script as rosrun does: catkin's own copy, if there is one."""
        own_name = self.task.named(package)
        installed = self.folder / "ws" / "devel" / "lib" / own_name / Path(script).name
        self.environment  # noqa: B018  builds, if need be
        if installed.exists() and not Path(script).name.startswith("checked_"):
            return [str(installed)]
        return [str(self.package(package).folder / script)]
