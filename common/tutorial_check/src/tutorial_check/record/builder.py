"""A workspace that can be built, and whose programs have an environment to run in."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import Any, Iterable

from tutorial_check.isolation.environment import environment_of
from tutorial_check.isolation.program import Program
from tutorial_check.isolation.runner import Runner
from tutorial_check.model import CannotCheck
from tutorial_check.record.build import Built
from tutorial_check.record.session import Session
from tutorial_check.source import student_files
from tutorial_check.source.manifests import is_stand_in
from tutorial_check.source.workspace import Layout

SLOW_S = 120  # [s] for what needs a second, when the machine is very busy


class Builder(Session):
    """A Session whose programs can be built."""

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
        """needed: what of the suite the student's launch files lead to."""
        about = {"underlay": underlay, "underlay_environment": runner.environment, "task": task}
        super().__init__(folder, layout, exercises, **about)
        self.runner, self.can_have_devices = runner, can_have_devices
        self._needed = [Path(each) for each in needed]
        self._siblings = 0

    def sibling(self, package: str, script: str, text: str) -> str:
        """Write a changed copy of a script beside it, so that its imports work; return its path there."""
        original = self.package(package).folder / script
        self._siblings += 1
        changed = original.with_name(f"checked_{self._siblings}_{original.name}")
        student_files.put(self.folder, changed, text, 0o755)
        return str(Path(script).with_name(changed.name))

    def _ended(self, *command: str) -> tuple[Program, bool]:
        """Return a program that was run, and whether it ended by itself."""
        program = self.runner.start(command)
        ended = self.runner.wait(lambda: program.ended, SLOW_S)
        self.runner.end(program)
        return program, ended

    def built(self) -> Built:
        """Build all, or if that fails what the exercises need: others may need what Debian lacks."""
        found: Built = self.memo("built", self._build)
        return found

    def _build(self) -> Built:
        code, output = self._made()
        names = [each.name for each in self.needed]
        if code == 0 or len(names) == len(self.packages):
            return Built(code, output)
        found, printed = self._made(f"-DCATKIN_WHITELIST_PACKAGES={';'.join(names)}")
        if found != 0:
            return Built(code, output)
        for each in self.packages:  # the suite's own takes the place of such a one
            if is_stand_in(each.name):
                student_files.put(self.folder, each.folder / "CATKIN_IGNORE", "")
        return Built(found, printed, output or " ")

    def _made(self, *words: str) -> tuple[int | None, str]:
        python = "-DPYTHON_EXECUTABLE=/usr/bin/python3"
        program, ended = self._ended("catkin_make", "-C", str(self.folder / "ws"), python, *words)
        if program.process.returncode != 0:
            self.must_reach_underlay()
        return (program.process.returncode if ended else None), program.output

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
                # What is below a needed one is as closed; but a home folder is opened no further.
                is_needed = set(self._needed) & {folder, *folder.parents}
                how = f"{'chmod -R o+rX' if is_needed else 'chmod o+x'} {folder}"
                raise CannotCheck(
                    f"{folder} is closed to others, as one of whom the programs run: {how},"
                    " or keep this suite, and TUTORIAL_WORKSPACE, where others may enter"
                ) from None

    @cached_property
    def environment(self) -> dict[str, str]:
        """In which the student's programs find their packages before all others."""
        if self.needs_build() and self.built().code == 0:
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
