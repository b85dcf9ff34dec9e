"""All that the checks of one workspace share: the copy, its environment, stages to play on."""

import contextlib
import os
import re
import shutil
import socket
import subprocess
import uuid
from pathlib import Path

from tutorial_check import driver, forked, python_facts
from tutorial_check.model import CannotCheck, Wrong, master_gone
from tutorial_check.workspace import packages_below

START_S = 8.0  # a node of the student's has this long to appear; a busy machine is slow
# What of CMakeLists.txt makes a build necessary before anything can run.
NEEDS_BUILD = re.compile(
    r"^\s*(catkin_python_setup|add_message_files|add_service_files|generate_messages"
    r"|add_executable|catkin_install_python)\s*\(",
    re.MULTILINE,
)


class Session:
    """One workspace, copied to folder/ws, and the box in which its programs run."""

    def __init__(self, folder, layout, floor, make_box, can_have_devices):
        """floor: setup.bash of the lower floor; make_box(environment): a box.Box."""
        self.folder = Path(folder)
        self.layout = layout
        self.source = self.folder / "ws" / "src"
        self.floor = floor
        self.can_have_devices = can_have_devices
        self._memory = {}
        self._base = self._sourced(floor, None)
        self.box = make_box(self._base)

    def memo(self, key, make):
        """make(), once; what it raised is raised again."""
        if key not in self._memory:
            try:
                self._memory[key] = (True, make())
            except Wrong as wrong:
                self._memory[key] = (False, wrong)
        worked, value = self._memory[key]
        if not worked:
            raise value
        return value

    def _sourced(self, setup, start):
        """The environment after sourcing a setup.bash."""
        home = self.folder / "home"
        clean = {
            "PATH": f"{self.folder / 'bin'}:/usr/bin:/bin",
            "HOME": str(home),
            "LANG": "C.UTF-8",
            "TMPDIR": str(self.folder / "tmp"),
        }
        done = subprocess.run(
            ["bash", "-c", '. "$1" >/dev/null && env -0', "bash", str(setup)],
            env=start or clean,
            capture_output=True,
            check=False,
            timeout=60,
        )
        if done.returncode != 0:
            raise CannotCheck(
                f"{setup} cannot be sourced: {done.stderr.decode(errors='replace')[-200:]}"
            )
        found = dict(
            word.split("=", 1)
            for word in done.stdout.decode(errors="replace").split("\0")
            if "=" in word
        )
        for name in ("_", "SHLVL", "PWD", "OLDPWD"):
            found.pop(name, None)
        found["PATH"] = f"{self.folder / 'bin'}:{found['PATH']}"
        return {
            **found,
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": str(home / ".ros"),
            "ROS_LOG_DIR": str(home / ".ros" / "log"),
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
            if not path.is_file() or (path.is_symlink() and not path.exists()):
                continue
            is_python = path.suffix == ".py"
            if not is_python and not path.suffix:
                with path.open("rb") as file:
                    is_python = file.read(2) == b"#!" and b"python" in file.readline()
            if is_python and path.name not in ("setup.py", "__init__.py"):
                text = path.read_bytes().decode(errors="replace")
                found[str(path.relative_to(package.folder))] = python_facts.read_python(text)
        return found

    def text(self, package, script):
        """The text of a script, its line ends as they are."""
        return (self.package(package).folder / script).read_bytes().decode(errors="replace")

    def sibling(self, package, script, text):
        """A changed copy of a script, beside it so that its imports work; its path there."""
        original = self.package(package).folder / script
        name = f"checked_{len(self._memory)}_{original.name}"
        changed = original.with_name(name)
        changed.write_text(text)
        changed.chmod(0o755)
        return str(Path(script).with_name(name))

    # ------------------------------------------------------------------------- environment

    def built(self):
        """(catkin_make's exit code, its output); made once."""
        return self.memo("built", self._build)

    def _build(self):
        environment = dict(self._base)
        program = self.box.start(
            ["catkin_make", "-C", str(self.folder / "ws"), "-DPYTHON_EXECUTABLE=/usr/bin/python3"],
            environment,
        )
        ended = self.box.wait(lambda: program.ended, 120.0)
        self.box.end(program)
        return (program.process.returncode if ended else None), program.output

    @property
    def environment(self):
        """In which the student's programs find their packages before all others, and nobody else's."""
        return self.memo("environment", self._environment)

    def _environment(self):
        view = self.folder / "view"  # RViz is for human eyes: a program of its name that only waits
        for folder in (view / "lib" / "rviz", view / "src" / "rviz"):
            folder.mkdir(parents=True)
        (view / ".catkin").write_text(str(view / "src"))
        (view / "src" / "rviz" / "package.xml").write_text(
            '<package format="2"><name>rviz</name><version>1.0.0</version><description>x</description>'
            '<maintainer email="a@b.example">x</maintainer><license>x</license></package>'
        )
        stub = view / "lib" / "rviz" / "rviz"
        stub.write_text("#!/bin/sh\nexec sleep 600\n")
        stub.chmod(0o755)
        cmake = [each.folder / "CMakeLists.txt" for each in self.packages]
        needs_build = any(
            each.exists() and NEEDS_BUILD.search(each.read_text(errors="replace")) for each in cmake
        )
        if needs_build and self.built()[0] == 0:
            found = self._sourced(self.folder / "ws" / "devel" / "setup.bash", self._base)
        else:
            # What a build makes of packages that have nothing to be built.
            devel = self.folder / "devel"
            devel.mkdir()
            (devel / ".catkin").write_text(str(self.source))
            found = dict(self._base)
            found["CMAKE_PREFIX_PATH"] = f"{devel}:{found.get('CMAKE_PREFIX_PATH', '')}".rstrip(":")
            found["ROS_PACKAGE_PATH"] = f"{self.source}:{found.get('ROS_PACKAGE_PATH', '')}".rstrip(
                ":"
            )
        found["CMAKE_PREFIX_PATH"] = f"{view}:{found['CMAKE_PREFIX_PATH']}"
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
        stage = Stage(self)
        try:
            yield stage
        except (CannotCheck, Wrong, LookupError) as error:
            if stage.call("alive"):
                raise
            raise master_gone() from error
        finally:
            stage.end()


class Stage:
    """A master, a driver, and the student's programs."""

    def __init__(self, session):
        self.session = session
        self.box = session.box
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.environment = {
            **session.environment,
            "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        }
        # Logs of our own programs lie elsewhere: the student's may not write in folders of ours.
        place = str(session.folder / "ours")
        self._ours = ours = {
            **self.environment,
            "HOME": place,
            "ROS_HOME": place,
            "ROS_LOG_DIR": place,
        }
        self._master = forked.Helper(lambda: forked.MasterProcess(port), ours)
        self.box.trust(self._master.pid)
        self._driver = None
        self._helpers = []
        if not self._master.call("uri"):
            raise CannotCheck("no ROS master can be started here")
        self._driver = forked.Helper(driver.Driver, ours)
        self.box.trust(self._driver.pid)
        # As roscore does; else two roslaunch at once would each make up one, and one of them fail.
        self.call("set_parameter", "/run_id", str(uuid.uuid4()))
        # As common/node_kit/etc/ros/roscore.xml, which says why.
        self.call("set_parameter", "/rosout_disable_topics_generation", False)

    def start(self, package, script, *arguments):
        """Start a script of the student's."""
        return self.launch([*self.session.command(package, script), *arguments])

    def help(self, make):
        """A forked.Helper of one's own, for as long as the stage stands."""
        helper = forked.Helper(make, self._ours)
        self.box.trust(helper.pid)
        self._helpers.append(helper)
        return helper

    def launch(self, command, trusted=False):
        """Start a command on this master."""
        try:
            return self.box.start(
                command, self._ours if trusted else self.environment, trusted=trusted
            )
        except OSError as error:
            raise Wrong(
                "a program that can be started",
                f"{Path(command[0]).name}: {error.strerror}",
                hint="look at the first line of the file: #!/usr/bin/env python3",
            ) from None

    def call(self, method, *arguments):
        """Of the driver."""
        return self._driver.call(method, *arguments)

    def wait(self, condition, deadline_s=START_S):
        """See Box.wait."""
        return self.box.wait(condition, deadline_s)

    def end(self):
        """End everything on this stage."""
        self.box.clear()
        for helper in self._helpers:
            helper.end()
        if self._driver:
            self._driver.end()
        self._master.end()
        shutil.rmtree(self.session.folder / "home" / ".ros", ignore_errors=True)


def prepare(folder, uid):
    """The folders of a session, of which home belongs to the student's programs."""
    folder = Path(folder)
    for name in ("home", "tmp", "bin", "ours", "ws"):
        (folder / name).mkdir(exist_ok=True)
    # The handout's listings begin with `env python`, as did all in its time.
    (folder / "bin" / "python").symlink_to("/usr/bin/python3")
    if uid is not None:
        for place, _, files in os.walk(folder / "ws"):
            os.chown(place, uid, uid)
            for name in files:
                os.chown(os.path.join(place, name), uid, uid, follow_symlinks=False)
        for name in ("home", "tmp"):
            os.chown(folder / name, uid, uid)
