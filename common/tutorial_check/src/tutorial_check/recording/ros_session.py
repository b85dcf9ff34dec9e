"""A ROS master, the checker's node, and the programs that were started."""

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

START_S = 8.0  # a student's node has this long to appear
SETTLE_S = 0.5  # after connecting, a node has this long to attach its callback


class RosSession:
    """A master, a peer, and the student's programs."""

    def __init__(self, workspace: Builder, renamed: bool = True) -> None:
        """Start a master and a peer. renamed: topics have the names of the student's task."""
        # Load ROS for all processes forked later. It takes time, and not every check needs it.
        import rosmaster.master  # noqa: F401, PLC0415

        from tutorial_check.recording import peer  # noqa: PLC0415

        self.workspace, self.runner, self.wait = workspace, workspace.runner, workspace.runner.wait
        self._topics = dict(workspace.task.topics) if renamed else {}
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        master = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
        self.environment = {**workspace.environment, **master}
        # Our programs come from the underlay, even if the student has packages of the same name.
        # They log elsewhere, because the student's programs may not write into our folders.
        own = dict.fromkeys(("HOME", "ROS_HOME", "ROS_LOG_DIR"), str(workspace.folder / "ours"))
        self._ours = {**workspace.underlay_environment, **master, **own}
        self._helpers: list[Helper[Any]] = []
        self._master = self.help(MasterProcess, port)
        if not self._master.remote.uri():
            raise CannotCheck("no ROS master can be started here")
        self._peer = self.help(peer.Peer)
        self.peer = cast("Peer", Remote(self._call))
        # As roscore does; else of two roslaunch, which would each choose one, one would fail.
        self.peer.set_parameter("/run_id", str(uuid.uuid4()))
        # See common/node_kit/etc/ros/roscore.xml.
        self.peer.set_parameter("/rosout_disable_topics_generation", False)

    def start(self, package: str, script: str, *arguments: str) -> Program:
        return self.launch([*self.workspace.command(package, script), *arguments])

    def help(self, make: Callable[..., Served], *arguments: object) -> Helper[Served]:
        """Return a Helper for the object that make(*arguments) returns."""
        helper = Helper(functools.partial(make, *arguments), self._ours)
        self.runner.trusted.add(helper.pid)
        self._helpers.append(helper)
        return helper

    def echo(self, axis: int) -> tuple[Echo, str]:
        """Return an Echo of an axis, and its topic."""
        from tutorial_check.recording import peer  # noqa: PLC0415

        joy = self._topics.get(peer.JOY, peer.JOY)
        return self.help(peer.Echo, joy, axis).remote, peer.ECHO

    def plug_in(self, device: str = "/dev/input/js0") -> tuple[VirtualGamepad, Path]:
        """Return a virtual F710 and its device; without namespaces, that is a FIFO elsewhere."""
        from tutorial_check.recording.virtual_gamepad import VirtualGamepad  # noqa: PLC0415

        workspace = self.workspace
        path = Path(device) if workspace.order.sandbox.in_namespaces else workspace.folder / "js0"
        gamepad = self.help(VirtualGamepad, str(path), workspace.task.joy).remote
        gamepad.connected()
        return gamepad, path

    def start_ours(self, package: str, program: str, *arguments: str) -> Program:
        """Start one of the suite's programs, without rosrun, which searches for half a second."""
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
        """Call the peer. Stop waiting if the master has ended: rospy would retry forever."""
        if arguments:
            arguments = (self._topics.get(str(arguments[0]), arguments[0]), *arguments[1:])
        return self._peer.call(method, *arguments, in_vain=lambda: not self.master_lives)

    @property
    def master_lives(self) -> bool:
        """Whether no program has ended the master."""
        return not self._master.ended

    def wait_for_start(self, condition: Callable[[], Value], deadline_s: float = START_S) -> Value:
        """Wait until a condition holds, or the programs are idle."""
        return self.wait(condition, deadline_s, or_idle=True)

    def meet(self, program: Program, *topics: str) -> bool:
        """Wait until a program connects on these topics, or ends; return whether it connected.

        rospy connects before it attaches the callback, and publishers count a subscriber from the
        connection on. Messages sent in between are lost, so wait until all its threads wait.
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
