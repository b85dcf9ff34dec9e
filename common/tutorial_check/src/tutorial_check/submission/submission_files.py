"""The files of a workspace, which its checks and recorders share."""

from __future__ import annotations

import os
import re
import shlex
from functools import cached_property
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, TypeVar, cast

from tutorial_check.course.definition import CPP, PYTHON, SUITE, Course, read_course
from tutorial_check.course.tasks import Task
from tutorial_check.data.recordings import Executable
from tutorial_check.submission import student_files
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_check.submission.cpp_sources import CPP_ENDINGS, main_of, texts_of
from tutorial_check.submission.manifests import first_broken
from tutorial_check.submission.order import Order
from tutorial_check.submission.packages import SOLUTIONS, Package, packages_below
from tutorial_check.submission.places import Places
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.source_facts import SourceFacts

# Lines of CMakeLists.txt that require a build before anything can run.
NEEDS_BUILD = re.compile(
    r"^[ \t]*(catkin_python_setup|add_message_files|add_service_files|generate_messages"
    r"|add_executable|catkin_install_python)\s*\(",
    re.MULTILINE | re.IGNORECASE,
)
Value = TypeVar("Value")


class SubmissionFiles:
    """The files of one workspace."""

    def __init__(self, order: Order, task: Task) -> None:
        self.order, self.folder, self.layout = order, order.folder, order.layout
        self.task: Any = task  # the course's own
        self.source = self.folder / "ws" / "src"
        self.underlay_environment: Mapping[str, str] = order.sandbox.environment
        self._memory: dict[object, Any] = {}
        self._visible = [Path("/")]  # folders that the student's programs may read

    def is_own(self, path: str | Path) -> bool:
        """Return whether a path is within src. One in a recording may be forged, with .. in it."""
        return Path(os.path.realpath(self.source)) in Path(os.path.realpath(path)).parents

    def may_see(self, path: str | Path) -> bool:
        """Return whether the student's programs may read a path, so that the checker may, too."""
        real = Path(os.path.realpath(path))
        return any(folder in (real, *real.parents) for folder in self._visible)

    @cached_property
    def places(self) -> Places:
        """The folders that recordings name."""
        below = Path(self.order.underlay).parent.parent
        copied = {"submission": self.source.parent, "scratch": self.folder}
        return Places({**copied, "workspace": self.layout.root, "underlay": below, "suite": SUITE})

    def memo(self, key: object, make: Callable[[], Value]) -> Value:
        """Return make(), called only once, for facts that do not change."""
        if key not in self._memory:
            self._memory[key] = make()
        return cast(Value, self._memory[key])

    @cached_property
    def course(self) -> Course:
        return read_course(self.order.course)

    @cached_property
    def broken(self) -> Package | None:
        """A package whose package.xml prevents every node from starting."""
        return first_broken(self.source, self.packages)

    @cached_property
    def packages(self) -> list[Package]:
        return packages_below(self.source)

    def has(self, name: str) -> bool:
        """Return whether the package exists that the checks know by a name."""
        return self.task.name_of(name) in {package.name for package in self.packages}

    def package(self, name: str) -> Package:
        """Return that package. Raises LookupError."""
        return {package.name: package for package in self.packages[::-1]}[self.task.name_of(name)]

    @property
    def language(self) -> str:
        """The language of the programs: one of LANGUAGES."""
        return self.order.language or self.course.language

    @property
    def executables(self) -> tuple[Executable, ...]:
        """The programs in C++ of the workspace, which this builds."""
        raise NotImplementedError

    def programs(self, name: str) -> dict[str, SourceFacts]:
        """Return {path within the package: facts} of the programs of a package.

        The path of a program in C++ is that of its main source. If any language will do, those in
        C++ count only in a package without a node in Python.
        """
        scripts = self.scripts(name) if self.language != CPP else {}
        compiled = self.cpp_programs(name) if self.is_in_cpp(name) else {}
        return {**scripts, **compiled}

    def facts_of(self, name: str, path: str) -> SourceFacts | None:
        """Return the facts of a program of a package, or None. path: as in programs()."""
        if path.endswith(CPP_ENDINGS):
            return self.cpp_programs(name).get(path)
        return self.scripts(name).get(path)

    def is_in_cpp(self, name: str) -> bool:
        """Return whether the programs of a package that count are in C++."""
        if self.language == PYTHON or not self.cpp_sources(name):
            return False
        scripts = self.scripts(name).values() if self.language != CPP else ()
        return not any("init_node" in facts.calls or facts.error for facts in scripts)

    def cpp_sources(self, name: str) -> list[Path]:
        """Return the C++ files of a package, without headers."""
        files = sorted(self.package(name).folder.rglob("*"))
        return [path for path in files if path.suffix in CPP_ENDINGS and path.is_file()]

    def cpp_programs(self, name: str) -> dict[str, CppFacts]:
        """Return {main source within the package: CppFacts} of its programs in C++."""
        return self.memo(("c++", name), lambda: dict(self._cpp_programs(name)))

    def _cpp_programs(self, name: str) -> Iterator[tuple[str, CppFacts]]:
        folder = self.package(name).folder
        for path, executable in self.compiled(name).items():
            sources = self._own_sources(executable, folder)
            yield path, CppFacts(texts_of(folder / path, sources, folder, self.read))

    def compiled(self, name: str) -> dict[str, Executable]:
        """Return {main source within the package: Executable}."""
        return self.memo(("compiled", name), lambda: self._compiled(name))

    def _compiled(self, name: str) -> dict[str, Executable]:
        folder = self.package(name).folder
        made: dict[str, Executable] = {}
        for executable in self.executables if self.cpp_sources(name) else ():
            sources = self._own_sources(executable, folder)
            if sources:
                main = main_of(executable, sources, self.read)
                before = made.get(str(main.relative_to(folder)))
                if not before or before.name != main.stem:
                    made[str(main.relative_to(folder))] = executable
        return made

    def _own_sources(self, executable: Executable, folder: Path) -> list[Path]:
        """Return those sources of an executable that are in a package's folder."""
        paths = (self.source / source for source in executable.sources)
        return [path for path in paths if folder in path.parents and path.is_file()]

    def executable_of(self, name: str, path: str) -> Executable | None:
        """Return the executable whose main source has a path; None for a script."""
        if not path.endswith(CPP_ENDINGS):
            return None
        return self.compiled(name).get(path)

    def scripts(self, name: str) -> dict[str, PythonFacts]:
        """Return {path within the package: PythonFacts} of the Python programs of a package."""
        return self.memo(("scripts", name), lambda: dict(self._programs(self.package(name))))

    def _programs(self, package: Package) -> Iterator[tuple[str, PythonFacts]]:
        for path in sorted(package.folder.rglob("*")):
            inside = path.relative_to(package.folder)
            # Files of editors and file managers are hidden.
            if not path.is_file() or any(part.startswith(".") for part in inside.parts):
                continue
            is_python = path.suffix == ".py"
            if not path.suffix:
                with path.open("rb") as file:
                    is_python = file.read(2) == b"#!" and b"python" in file.readline()
            if is_python and path.name not in ("setup.py", "__init__.py"):
                yield str(inside), PythonFacts(self.read(path))

    def read(self, path: Path) -> str:
        """Return the text of a student's file. Raises CannotCheck."""
        return student_files.read(self.folder, path).decode(errors="replace")

    def text(self, package: str, script: str) -> str:
        """Return the text of a script, with its line ends unchanged."""
        return self.read(self.package(package).folder / script)

    def whole(self, path: str | Path, package: str = "") -> str:
        """Return an absolute path for a shell; Submission.as_sent makes it the student's own."""
        own = self.package(package).folder if package else self.source.parent
        return shlex.quote(str(own / path))

    @property
    def needed(self) -> list[Package]:
        """The exercises' packages, and those of the workspace that they depend on."""
        needed, names = [], set(map(self.task.name_of, SOLUTIONS))
        for _ in self.packages:
            needed = [package for package in self.packages if package.name in names]
            names |= {name for package in needed for name in package.depends}
        return needed or self.packages

    def needs_build(self) -> bool:
        """Return whether a build is needed before a program can run."""
        return any(NEEDS_BUILD.search(package.cmake or "") for package in self.packages)
