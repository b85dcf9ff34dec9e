"""A ROS master of its own, the checker's end of the topics, and what was started on it."""

import shutil
import socket
import uuid
from pathlib import Path

from tutorial_check import forked, preloaded
from tutorial_check.model import CannotCheck, Wrong

START_S = 8.0  # a node of the student's has this long to appear


class Stage:
    """A master, a driver, and the student's programs."""

    def __init__(self, session):
        # ROS, for all that are forked from here on. Not every check needs it, and it takes its time.
        import rosmaster.master  # noqa: F401, PLC0415

        from tutorial_check import driver  # noqa: PLC0415

        self.session = session
        self.box = session.box
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        master = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
        self.environment = {**session.environment, **master}
        # Our own programs are found on the floor alone, whatever of their name the student has. Their
        # logs lie elsewhere: the student's may not write in folders of ours.
        place = str(session.folder / "ours")
        self._ours = ours = {
            **session.floor_environment,
            **master,
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

    def start_quickly(self, package, script, *arguments):
        """The same, in a Python that has ROS loaded already; see preloaded."""
        path = str(self.session.package(package).folder / script)
        return self.box.fork(
            lambda: preloaded.run(path, *arguments), self.environment, Path(path).name
        )

    def help(self, make):
        """A forked.Helper of one's own, for as long as the stage stands."""
        helper = forked.Helper(make, self._ours)
        self.box.trust(helper.pid)
        self._helpers.append(helper)
        return helper

    def echo(self):
        """(a Helper with an Echo, the topic on which it answers)."""
        from tutorial_check import driver  # noqa: PLC0415

        return self.help(driver.Echo), driver.ECHO

    def start_ours(self, package, program, *arguments):
        """Start a program of the suite's. Without rosrun, which searches it for half a second."""
        path = Path(self.session.floor).parent / "lib" / package / program
        return self.launch([str(path), *arguments], trusted=True)

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
        """Of the driver. Without a master rospy tries for ever: nobody waits for that."""
        return self._driver.call(method, *arguments, in_vain=lambda: not self.master_lives)

    @property
    def master_lives(self):
        """Whether nobody has ended the master."""
        return not self._master.ended

    def wait(self, condition, deadline_s):
        """See Box.wait."""
        return self.box.wait(condition, deadline_s)

    def wait_for_start(self, condition, deadline_s=START_S):
        """Until programs are as far as the condition says, or do nothing more."""
        return self.box.wait(condition, deadline_s, or_idle=True)

    def end(self):
        """End everything on this stage."""
        self.box.clear()
        for helper in self._helpers:
            helper.end()
        if self._driver:
            self._driver.end()
        self._master.end()
        shutil.rmtree(self.session.folder / "home" / ".ros", ignore_errors=True)
