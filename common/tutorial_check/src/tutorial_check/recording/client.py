"""The checker's node for any type: services, messages, parameters and transforms."""

from __future__ import annotations

import contextlib
import itertools
import json
import select
import socket
import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

from tutorial_check.data.recordings import Ran
from tutorial_check.errors import NO_TYPE, CannotCheck, CutShort
from tutorial_check.processes.started_program import Program
from tutorial_check.recording.ros_session import START_S, RosSession
from tutorial_check.submission.tracebacks import last_lines

Heard = Tuple[float, str, Dict[str, Any]]  # (when it came [s], from which node, its fields)
MOST_BYTES = 64 << 20
SLOW_S = 15.0  # for replies that need no student's program


@dataclass(frozen=True)
class ServiceAnswer:
    """The result of a service call: the fields of the response, or why there is none."""

    values: Optional[Dict[str, Any]]
    trouble: str = ""


@dataclass(frozen=True)
class FrameTransform:
    """Pose of the source in the target frame: (x, y, z) [m], and the rotation (x, y, z, w)."""

    translation: Tuple[float, ...]
    rotation: Tuple[float, ...]


@dataclass(frozen=True)
class Seen:
    """A program, and what a Client received on each topic and service, and as answers."""

    program: Ran
    heard: Dict[str, Tuple[Dict[str, Any], ...]]
    answers: Tuple[Any, ...]
    types: Dict[str, str]


def _fault(why: object) -> CannotCheck:
    """Return the CannotCheck for a mistake in the course, with the FILE:LINE of the call."""
    frames = traceback.extract_stack()[::-1]
    frame = next(frame for frame in frames if frame.filename != __file__)
    return CannotCheck(f"{Path(frame.filename).name}:{frame.lineno}: {why}")


class Client:
    """A node in a RosSession; see common/doc/COURSES.md and client_node.

    If a type of the student's workspace is missing or does not fit the values, that is the
    student's mistake, and ends the recording; with any other type it is the course's.
    """

    def __init__(self, ros: RosSession) -> None:
        """Start it, with the student's rights, as it imports code that the workspace generates."""
        self._ros, self._numbers, self._buffer = ros, itertools.count(), b""
        self._answers: dict[int, Any] = {}
        self._kinds: dict[str, str] = {}  # of advertised topics
        self._line, theirs = socket.socketpair()
        self._line.settimeout(SLOW_S)
        command = ["/usr/bin/python3", str(Path(__file__).with_name("client_node.py"))]
        self._node = ros.runner.start(command, ros.environment, stdin=theirs.fileno())
        theirs.close()
        self._tell("services")  # now it is up, and misses nothing

    def fields(self, kind: str) -> Tuple[str, ...]:
        """Return "TYPE NAME" of each field of a message, or of a service, with "---" in between."""
        return tuple(self._tell("fields", kind, of=kind))

    def ask(
        self, service: str, kind: str, values: object = None, seconds: float = START_S
    ) -> ServiceAnswer:
        """Wait for a service and call it. seconds: until the response, at most."""
        response = self._tell("ask", service, kind, values or {}, of=kind, seconds=seconds)
        if response:
            return ServiceAnswer(*response)
        known = self._tell("services")
        trouble = f"there is no service {service}; there are: {', '.join(known) or 'none'}"
        return ServiceAnswer(None, f"{service} does not respond" if service in known else trouble)

    def serve(self, service: str, kind: str, values: object) -> None:
        """Provide a service with this response; heard() returns the requests."""
        self._tell("serve", service, kind, values, of=kind)

    def listen(self, topic: str, kind: str) -> None:
        self._tell("listen", topic, kind, of=kind)

    def heard(self, name: str, since: int = 0) -> List[Heard]:
        """Return the messages of a topic, or the requests of a service."""
        return [(at_s, node, values) for at_s, node, values in self._tell("heard", name, since)]

    def seen(self, program: Program, *names: str, answers: Sequence[object] = ()) -> Seen:
        """Return what was seen so far. names: of topics and services. answers: plain values."""
        if isinstance(answers, (dict, ServiceAnswer)) or any(
            isinstance(it, ServiceAnswer) for it in answers
        ):
            raise _fault("answers= takes a list of plain values, as [answer.values]")
        heard = {name: tuple(values for *_, values in self.heard(name)) for name in names}
        return Seen(program.ran, heard, tuple(answers), self._ros.peer.types())

    def count(self, name: str) -> int:
        return int(self._tell("count", name))

    def advertise(self, topic: str, kind: str) -> None:
        self._tell("advertise", topic, kind, of=kind)
        self._kinds[topic] = kind

    def send(self, topic: str, values: object) -> float:
        """Publish a message on an advertised topic; return the time [s]."""
        return float(self._tell("send", topic, values, of=self._kinds[topic]))

    def meet(self, program: Program, *topics: str) -> bool:
        """Wait until a program has connected on these topics; return whether it has."""

        def has_met() -> bool:
            return all(self._tell("connections", topic) for topic in topics)

        self._ros.wait_for_start(lambda: program.ended or has_met())
        return self._ros.meet(program) and has_met()

    def parameter(self, name: str) -> object:
        return self._tell("parameter", name)

    def lookup(
        self, target: str, source: str, seconds: float = START_S
    ) -> Optional[FrameTransform]:
        """Return the newest transform, or None if none arrives in that time."""
        newest = self._ros.wait(lambda: self._tell("lookup", target, source), seconds)
        return FrameTransform(*map(tuple, newest)) if newest else None

    def transforms(self) -> Tuple[str, ...]:
        """Return "PARENT -> CHILD" of each transform that has arrived since the first lookup()."""
        return tuple(self._tell("transforms"))

    def _tell(self, what: str, *about: Any, of: str = "", seconds: Optional[float] = None) -> Any:
        """Return the node's answer; None after that many seconds. of: the type in question."""
        number = next(self._numbers)
        try:
            line = json.dumps({"id": number, "do": what, "with": about})
        except TypeError as error:
            raise _fault(error) from None
        with contextlib.suppress(OSError):  # it has ended, or hangs
            self._line.sendall(f"{line}\n".encode())
        if seconds is None:
            self._ros.wait(lambda: self._has(number), SLOW_S)
        elif not self._ros.wait_for_start(lambda: self._has(number), seconds):
            return None
        words = f"what uses {of or 'ROS'} ends, or hangs. {last_lines(self._node.output)}".strip()
        answer = self._answers.pop(number, {"fault": words})
        own = [package.name for package in self._ros.workspace.packages]
        if "fault" in answer and of.partition("/")[0] in own:
            raise CutShort(NO_TYPE, answer["fault"])
        if "value" not in answer:
            raise _fault(answer.get("fault", answer.get("error")))
        return answer["value"]

    def _has(self, number: int) -> bool:
        """Return whether an answer has come, or none will come; read all that have come."""
        if select.select([self._line], [], [], 0)[0]:
            with contextlib.suppress(OSError):
                self._buffer += self._line.recv(1 << 20)
            if len(self._buffer) > MOST_BYTES:
                raise _fault(f"an answer of more than {MOST_BYTES >> 20} MB")
            *lines, self._buffer = self._buffer.split(b"\n")
            self._answers.update((answer["id"], answer) for answer in map(json.loads, lines))
        return number in self._answers or self._node.ended
