"""A workspace that can be built, and the environment of its programs."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from tutorial_check.course.tasks import Task
from tutorial_check.data.recordings import Built, Executable
from tutorial_check.errors import CannotCheck
from tutorial_check.processes.runner import Runner
from tutorial_check.processes.started_program import Program
from tutorial_check.recording import build_tree, cmake_targets
from tutorial_check.sandbox.environment import environment_of
from tutorial_check.sandbox.privileges import OF_BUILD
from tutorial_check.submission import student_files
from tutorial_check.submission.manifests import is_stand_in
from tutorial_check.submission.order import Order
from tutorial_check.submission.submission_files import SubmissionFiles

SLOW_S = 120  # [s] on a very busy machine, for what usually takes some seconds
# A wrong index of a vector, also of a message's, ends the program.
FLAGS = {"CXXFLAGS": "-D_GLIBCXX_ASSERTIONS"}
# What another attempt may not meet again.
PASSES = re.compile(r"Killed|No space left|[Cc]annot allocate|out of memory|memory exhausted")


class Builder(SubmissionFiles):
    """A workspace whose packages can be built."""

    def __init__(
        self,
        order: Order,
        task: Task,
        runner: Runner,
        new_build: int | None = None,
        last_build: int | None = None,
    ) -> None:
        """new_build: a descriptor to write a build to. last_build: to read the last one from."""
        super().__init__(order, task)
        self.runner, self.underlay_environment = runner, runner.environment
        self._siblings = 0
        self._kept: build_tree.Kept | None = None
        self._new_build = new_build
        self._sources = {} if new_build is None else build_tree.digests_of(self.source)
        if last_build is not None:
            self._kept = build_tree.restored(last_build, self.folder, self._sources)
        self._is_same = self._kept is not None and self._kept.sources == self._sources

    def sibling(self, package: str, script: str, text: str) -> str:
        """Write a changed copy beside a script, so that its imports work; return its path."""
        original = self.package(package).folder / script
        self._siblings += 1
        changed = original.with_name(f"checked_{self._siblings}_{original.name}")
        student_files.put_file(self.folder, changed, text, 0o755)
        return str(Path(script).with_name(changed.name))

    def _ended(self, *command: str, **about: Any) -> tuple[Program, bool]:
        """Run a program; return it, and whether it ended by itself. about: see Runner.start."""
        program = self.runner.start(command, **about)
        ended = self.runner.wait(program.has_ended, SLOW_S)
        self.runner.end(program)
        return program, ended

    @cached_property
    def built(self) -> Built:
        """Build all; if that fails, what the exercises need: others may need what Debian lacks."""
        may_keep = not self.runner.has_started  # a program may have changed src
        whole = result = self.all_built
        has_part = whole.code != 0 and len(self.needed) < len(self.packages)
        if has_part and self.needed_built.code == 0:
            result = replace(self.needed_built, unbuilt=whole.output or " ")
        if may_keep and not self._is_same and self._new_build is not None:
            self._keep(self._new_build)
        if result.unbuilt:
            for package in self.packages:  # the suite's stand-in replaces it
                if is_stand_in(package.name):
                    student_files.put_file(self.folder, package.folder / "CATKIN_IGNORE", "")
        return result

    @cached_property
    def all_built(self) -> Built:
        """The build of all packages."""
        if self._kept and self._is_same:
            return self._kept.whole
        is_forced = self._kept and build_tree.needs_cmake(self._kept, self._sources)
        return self._catkin_make(*(["--force-cmake"] if is_forced else []))

    @cached_property
    def needed_built(self) -> Built:
        """The build of the packages that the exercises need."""
        if self._kept and self._is_same and self._kept.part:
            return self._kept.part
        names = ";".join(package.name for package in self.needed)
        return self._catkin_make(f"-DCATKIN_WHITELIST_PACKAGES={names}")

    def _catkin_make(self, *options: str) -> Built:
        command = ["catkin_make", "-C", str(self.source.parent)]
        command += ["-DPYTHON_EXECUTABLE=/usr/bin/python3", *options]
        workspace = self.source.parent
        cmake_targets.ask(workspace)
        program, ended = self._ended(*command, environment=FLAGS, limits=OF_BUILD)
        made = cmake_targets.executables(self.folder, workspace)
        return Built(program.process.returncode if ended else None, program.output, "", made)

    @property
    def executables(self) -> tuple[Executable, ...]:
        return self.built.executables

    def _keep(self, descriptor: int) -> None:
        """Keep what was built, unless another attempt could end otherwise."""
        part = self.__dict__.get("needed_built")
        made = [self.all_built, *filter(None, [part])]
        is_sure = all(run.code is not None and not PASSES.search(run.output) for run in made)
        if is_sure and build_tree.is_elsewhere_as_before(self.source.parent, self._sources):
            self.runner.end_strays()  # of a CMakeLists.txt
            kept = build_tree.Kept(str(self.folder), self._sources, self.all_built, part, ())
            build_tree.write(descriptor, kept, self.source.parent)

    @cached_property
    def environment(self) -> dict[str, str]:
        """The environment in which a student's programs find their own packages first."""
        if self.needs_build() and self.built.code == 0:
            variables = self._sourced(self.folder / "ws" / "devel" / "setup.bash")
        else:
            variables = dict(self.underlay_environment)
            own = {"CMAKE_PREFIX_PATH": self.folder / "devel", "ROS_PACKAGE_PATH": self.source}
            for name, path in own.items():
                variables[name] = f"{path}:{variables.get(name, '')}".rstrip(":")
        prefixes = f"{self.folder / 'view'}:{variables['CMAKE_PREFIX_PATH']}"
        return {**variables, "CMAKE_PREFIX_PATH": prefixes}

    def _sourced(self, setup: Path) -> dict[str, str]:
        """Return the environment after a setup.bash, which runs like a student's program."""
        # Output before the first \0 is no variable.
        source = '. "$1" >/dev/null && printf "\\0" && env -0'
        program, _ = self._ended("bash", "-c", source, "bash", str(setup))
        printed, *variables = program.output.split("\0")
        if program.process.returncode != 0 or not variables:
            raise CannotCheck(f"{setup} cannot be sourced: {' '.join(printed[-200:].split())}")
        return environment_of(variables)

    def command(self, package: str, script: str) -> list[str]:
        """Return the command with which rosrun starts a script: catkin's own copy, if any."""
        executable = self.executable_of(package, script)
        if executable:
            return [str(self.source.parent / executable.path)]
        own_name = self.task.name_of(package)
        installed = self.folder / "ws" / "devel" / "lib" / own_name / Path(script).name
        self.environment  # noqa: B018  builds, if need be
        if installed.exists() and not Path(script).name.startswith("checked_"):
            return [str(installed)]
        return [str(self.package(package).folder / script)]
