"""All that the checks of one workspace share: the copy, its environment, stages to play on."""

import contextlib
import os
import re
import shlex
from pathlib import Path

from tutorial_check import python_facts, student_files, trial
from tutorial_check.exercises.manifests import must_be_startable
from tutorial_check.model import CannotCheck, Wrong, master_gone
from tutorial_check.stage import Stage
from tutorial_check.workspace import packages_below

SLOW_S = 120  # [s] for what needs a second, when the machine is very busy
# What of CMakeLists.txt makes a build necessary before anything can run.
NEEDS_BUILD = re.compile(
    r"^[ \t]*(catkin_python_setup|add_message_files|add_service_files|generate_messages"
    r"|add_executable|catkin_install_python)\s*\(",
    re.MULTILINE,
)

# RViz is for human eyes: a program of its name only waits.
NO_VIEW = """#!/bin/sh
exec sleep 600
"""
# With launch-prefix="xterm -e" a node has a window; there is no screen here, so it runs without one.
NO_WINDOW = """#!/bin/sh
while [ $# -gt 1 ] && [ "$1" != -e ] && [ "$1" != -x ] && [ "$1" != -- ]; do shift; done
shift
exec "$@"
"""
STAND_INS = {
    "rviz": NO_VIEW,
    "xterm": NO_WINDOW,
    "gnome-terminal": NO_WINDOW,
    "konsole": NO_WINDOW,
}


def _once(memory, key, make):
    if key not in memory:
        try:
            memory[key] = (True, make())
        except Wrong as wrong:
            memory[key] = (False, wrong)
    worked, value = memory[key]
    if not worked:
        raise value
    return value


class Session:
    """One workspace, copied to folder/ws, and the box in which its programs run."""

    def __init__(
        self,
        folder,
        layout,
        exercises,
        environment,
        *,
        floor,
        make_box,
        can_have_devices,
        needed=(),
    ):
        """floor: its setup.bash; environment: of a shell that sourced it; make_box(environment): a Box.

        needed: files and folders of the suite's that the student's launch files lead to.
        floor_environment: the latter in folders of this session's own, without the student's packages.
        """
        self.folder = Path(folder)
        self.layout = layout
        self.exercises = frozenset(exercises)  # that are asked for
        self.source = self.folder / "ws" / "src"
        self.floor = floor
        self.can_have_devices = can_have_devices
        self._needed = needed
        self._memory, self._runs, self._siblings = {}, {}, 0
        self.floor_environment = self._own(environment)
        self.box = make_box(self.floor_environment)

    def memo(self, key, make):
        """make(), once; what it raised is raised again. For facts, which stay what they are."""
        return _once(self._memory, key, make)

    def run(self, key, make):
        """The same for what programs were seen to do, which may be looked at again."""
        return _once(self._runs, key, make)

    def second_look(self, explained):
        """Whether what programs were seen to do is forgotten, as it is worth to look again.

        It is if the machine was busy, or if no line explains it: nodes of a launch file meet in any
        order; and a Ctrl-C that meets rospy in the middle of a publish of the main thread may wait
        for ever, for a lock of that thread's own.
        """
        if explained and not self.box.patience.strained():
            return False
        self._runs.clear()
        return True

    def _sourced(self, setup):
        """The environment after sourcing a setup.bash, too: a program of the student's, as its hooks are."""
        # What is printed before the first \0 is no variable.
        program = self.box.start(
            ["bash", "-c", '. "$1" >/dev/null && printf "\\0" && env -0', "bash", str(setup)]
        )
        self.box.wait(lambda: program.ended, SLOW_S)
        self.box.end(program)
        said, *variables = program.output.split("\0")
        if program.process.returncode != 0 or not variables:
            raise CannotCheck(f"{setup} cannot be sourced: {' '.join(said[-200:].split())}")
        found = dict(word.split("=", 1) for word in variables if "=" in word)
        for name in ("_", "SHLVL", "PWD", "OLDPWD"):
            found.pop(name, None)
        return found

    def _own(self, environment):
        """The same with folders of this session's own."""
        home = self.folder / "home"
        return {
            **environment,
            "PATH": f"{self.folder / 'bin'}:{environment['PATH']}",
            "HOME": str(home),
            "TMPDIR": str(self.folder / "tmp"),
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(home / ".ros"),
            "ROS_LOG_DIR": str(home / ".ros" / "log"),
            "DISPLAY": ":99",  # whatever is there: for RViz stands a program that only waits
            "PYTHONUNBUFFERED": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    # ---------------------------------------------------------------- the student's packages

    @property
    def packages(self):
        """All packages of the workspace."""
        return self.memo("packages", lambda: packages_below(self.source))

    def package(self, name):
        """The one of that name, or None."""
        return next((each for each in self.packages if each.name == name), None)

    def scripts(self, name):
        """{path within the package: PythonFacts} of the Python programs of a package."""
        return self.memo(("scripts", name), lambda: self._scripts(name))

    def _scripts(self, name):
        found = {}
        package = self.package(name)
        for path in sorted(package.folder.rglob("*")) if package else []:
            inside = path.relative_to(package.folder)
            # What editors and file managers keep for themselves is hidden.
            if not path.is_file() or any(part.startswith(".") for part in inside.parts):
                continue
            is_python = path.suffix == ".py"
            if not is_python and not path.suffix:
                with path.open("rb") as file:
                    is_python = file.read(2) == b"#!" and b"python" in file.readline()
            if is_python and path.name not in ("setup.py", "__init__.py"):
                text = student_files.read(self.folder, path).decode(errors="replace")
                found[str(inside)] = python_facts.read_python(text)
        return found

    def text(self, package, script):
        """The text of a script, its line ends as they are."""
        path = self.package(package).folder / script
        return student_files.read(self.folder, path).decode(errors="replace")

    def whole(self, path, package=""):
        """A path of the workspace, or within a package, for a command of a shell in any folder.

        That of the copy, in whose place examine puts the student's own, where it knows that.
        """
        own = self.package(package).folder if package else self.source.parent
        return shlex.quote(str(own / path))

    def sibling(self, package, script, text):
        """A changed copy of a script, beside it so that its imports work; its path there."""
        original = self.package(package).folder / script
        self._siblings += 1
        name = f"checked_{self._siblings}_{original.name}"
        changed = original.with_name(name)
        student_files.put(self.folder, changed, text, 0o755)
        return str(Path(script).with_name(name))

    # ------------------------------------------------------------------------- environment

    def built(self):
        """(catkin_make's exit code, its output); made once."""
        return self.memo("built", self._build)

    def _build(self):
        environment = dict(self.floor_environment)
        program = self.box.start(
            ["catkin_make", "-C", str(self.folder / "ws"), "-DPYTHON_EXECUTABLE=/usr/bin/python3"],
            environment,
        )
        ended = self.box.wait(lambda: program.ended, 120.0)
        self.box.end(program)
        if program.process.returncode != 0:
            self.must_reach_floor()
        return (program.process.returncode if ended else None), program.output

    def must_reach_floor(self):
        """The student's programs can read what is the suite's. Raises CannotCheck."""
        self.memo("floor", lambda: trial.must_be_possible(self.box, self.folder, self._needed))

    def _needs_build(self):
        cmake = [each.folder / "CMakeLists.txt" for each in self.packages]
        return any(
            each.is_file() and NEEDS_BUILD.search(each.read_text(errors="replace"))
            for each in cmake
        )

    @property
    def lacks_build(self):
        """Whether the programs run without what catkin_make should have made for them."""
        return self._needs_build() and self.built()[0] != 0

    @property
    def environment(self):
        """In which the student's programs find their packages before all others, and nobody else's."""
        return self.memo("environment", self._environment)

    def _environment(self):
        if self._needs_build() and self.built()[0] == 0:
            found = self._sourced(self.folder / "ws" / "devel" / "setup.bash")
        else:
            devel = self.folder / "devel"
            found = dict(self.floor_environment)
            found["CMAKE_PREFIX_PATH"] = f"{devel}:{found.get('CMAKE_PREFIX_PATH', '')}".rstrip(":")
            found["ROS_PACKAGE_PATH"] = f"{self.source}:{found.get('ROS_PACKAGE_PATH', '')}".rstrip(
                ":"
            )
        found["CMAKE_PREFIX_PATH"] = f"{self.folder / 'view'}:{found['CMAKE_PREFIX_PATH']}"
        return found

    def command(self, package, script):
        """The command that starts a script as rosrun does: catkin's own copy of it, if there is one."""
        installed = self.folder / "ws" / "devel" / "lib" / package / Path(script).name
        self.environment  # noqa: B018  builds, if need be
        if installed.exists() and not Path(script).name.startswith("checked_"):
            return [str(installed)]
        return [str(self.package(package).folder / script)]

    @contextlib.contextmanager
    def stage(self):
        """A ROS master of its own, and a driver; all that was started on it ends with it."""
        must_be_startable(self)
        self.box.patience.begin()
        stage = Stage(self)
        try:
            yield stage
        except (CannotCheck, Wrong, LookupError) as error:
            if stage.master_lives:
                raise
            raise master_gone() from error
        finally:
            stage.end()


def prepare(folder, uid):
    """The folders of a session, of which home belongs to the student's programs."""
    folder = Path(folder)
    for name in ("home", "tmp", "bin", "ours", "ws"):
        (folder / name).mkdir(exist_ok=True)
    # The handout's listings begin with `env python`, as did all in its time.
    (folder / "bin" / "python").symlink_to("/usr/bin/python3")
    for name, text in STAND_INS.items():
        path = folder / "bin" / name
        path.write_text(text)
        path.chmod(0o755)
    _prepare_packages(folder)
    if uid is not None:
        for place, _, files in os.walk(folder / "ws"):
            os.chown(place, uid, uid)
            for name in files:
                os.chown(os.path.join(place, name), uid, uid, follow_symlinks=False)
        for name in ("home", "tmp"):
            os.chown(folder / name, uid, uid)


def _prepare_packages(folder):
    """RViz for who asks ROS where it is, and what a build makes where there is nothing to be built."""
    view, devel = folder / "view", folder / "devel"
    for each in (view / "lib" / "rviz", view / "src" / "rviz", devel):
        each.mkdir(parents=True, exist_ok=True)
    (view / ".catkin").write_text(str(view / "src"))
    (view / "src" / "rviz" / "package.xml").write_text(
        '<package format="2"><name>rviz</name><version>1.0.0</version><description>x</description>'
        '<maintainer email="a@b.example">x</maintainer><license>x</license></package>'
    )
    (view / "lib" / "rviz" / "rviz").symlink_to(folder / "bin" / "rviz")
    (devel / ".catkin").write_text(str(folder / "ws" / "src"))
