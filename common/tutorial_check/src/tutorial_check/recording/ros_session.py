"""A ROS master, the checker's end of the topics, and what was started on it."""

from __future__ import annotations

import functools
import shutil
import socket
import uuid
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Sequence, cast

from tutorial_check.errors import CANNOT_START, CannotCheck, CutShort
from tutorial_check.processes.helper_process import Helper, MasterProcess, Remote, Served
from tutorial_check.processes.runner import Value
from tutorial_check.processes.started_program import Program
from tutorial_check.recording.builder import Builder

if TYPE_CHECKING:  # The module loads ROS.
    from tutorial_check.recording.peer import Echo, Peer
    from tutorial_check.recording.virtual_gamepad import VirtualGamepad

START_S = 8.0  # a node of the student's has this long to appear
SETTLE_S = 0.5  # once connected, a thread of it has this long to attach its callback


class RosSession:
    """A master, a peer, and the student's programs."""

    def __init__(self, workspace: Builder, renamed: bool = True) -> None:
        """Start a master and a peer. renamed: topics have the names of the student's task."""
        # ROS, for all that are forked from here on. Not every check needs it, and it takes time.
        import rosmaster.master  # noqa: F401, PLC0415

        from tutorial_check.recording import peer  # noqa: PLC0415

        self.workspace, self.runner, self.wait = workspace, workspace.runner, workspace.runner.wait
        self._topics = dict(workspace.task.topics) if renamed else {}
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        master = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
        self.environment = {**workspace.environment, **master}
        # Our programs are found in the underlay alone, whatever the student has of their name. Logs
        # are elsewhere: the student's may not write in folders of ours.
        own = dict.fromkeys(("HOME", "ROS_HOME", "ROS_LOG_DIR"), str(workspace.folder / "ours"))
        self._ours = {**workspace.underlay_environment, **master, **own}
        self._helpers: list[Helper[Any]] = []
        self._master = self.help(MasterProcess, port)
        if not self._master.remote.uri():
            raise CannotCheck("no ROS master can be started here")
        self._peer = self.help(peer.Peer)
        self.peer = cast("Peer", Remote(self._call))
        # As roscore does; else two roslaunch at once would each make up one, and one of them fail.
        self.peer.set_parameter("/run_id", str(uuid.uuid4()))
        # As common/node_kit/etc/ros/roscore.xml, which says why.
        self.peer.set_parameter("/rosout_disable_topics_generation", False)

    def start(self, package: str, script: str, *arguments: str) -> Program:
        return self.launch([*self.workspace.command(package, script), *arguments])

    def help(self, make: Callable[..., Served], *arguments: object) -> Helper[Served]:
        """Return a Helper with what make(*arguments) returns."""
        helper = Helper(functools.partial(make, *arguments), self._ours)
        self.runner.trusted.add(helper.pid)
        self._helpers.append(helper)
        return helper

    def echo(self, axis: int) -> tuple[Echo, str]:
        """Return an Echo of an axis, and the topic on which it answers."""
        from tutorial_check.recording import peer  # noqa: PLC0415

        joy = self._topics.get(peer.JOY, peer.JOY)
        return self.help(peer.Echo, joy, axis).remote, peer.ECHO

    def plug_in(self, device: str = "/dev/input/js0") -> tuple[VirtualGamepad, Path]:
        """Return a virtual F710 and its device, which is a FIFO elsewhere without namespaces."""
        from tutorial_check.recording.virtual_gamepad import VirtualGamepad  # noqa: PLC0415

        workspace = self.workspace
        path = Path(device) if workspace.order.in_namespaces else workspace.folder / "js0"
        gamepad = self.help(VirtualGamepad, str(path), workspace.task.joy).remote
        gamepad.connected()
        return gamepad, path

    def start_ours(self, package: str, program: str, *arguments: str) -> Program:
        """Start a program of the suite's. Without rosrun, which searches it for half a second."""
        path = Path(self.workspace.order.underlay).parent / "lib" / package / program
        renamed = [f"{topic}:={own}" for topic, own in self._topics.items()]
        return self.launch([str(path), *renamed, *arguments], trusted=True)

    def launch(self, command: Sequence[str], trusted: bool = False) -> Program:
        try:
            return self.runner.start(command, self._ours if trusted else self.environment, trusted)
        except OSError as error:
            seen = f"{Path(command[0]).name}: {error.strerror}"
            raise CutShort(CANNOT_START, seen) from None

    def _call(self, method: str, *arguments: object) -> object:
        """Call the peer. Stop waiting if the master has ended: rospy would retry without end."""
        if arguments:
            arguments = (self._topics.get(str(arguments[0]), arguments[0]), *arguments[1:])
        return self._peer.call(method, *arguments, in_vain=lambda: not self.master_lives)

    @property
    def master_lives(self) -> bool:
        """Whether no program has ended the master."""
        return not self._master.ended

    def wait_for_start(self, condition: Callable[[], Value], deadline_s: float = START_S) -> Value:
        """Wait until programs are as far as the condition says, or do nothing more."""
        return self.wait(condition, deadline_s, or_idle=True)

    def meet(self, program: Program, *topics: str) -> bool:
        """Return whether a program connected to ours on these topics; wait for that, or its end.

        rospy connects before it attaches the callback, and a publisher counts a subscriber from the
        connection on: what is sent in between is lost, so wait until all its threads wait.
        """

        def has_met() -> bool:
            return all([self.peer.has_met(topic) for topic in topics])

        self.wait_for_start(lambda: program.ended or has_met())
        self.wait(lambda: program.ended or program.rests(), SETTLE_S)
        return not program.ended and has_met()

    def end(self) -> None:
        self.runner.clear()
        for helper in reversed(self._helpers):
            helper.end()
        shutil.rmtree(self.workspace.folder / "home" / ".ros", ignore_errors=True)
