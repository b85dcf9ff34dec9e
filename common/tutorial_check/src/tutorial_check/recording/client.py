"""The checker's end of any type: services, messages, parameters and transforms."""

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
SLOW_S = 15.0  # for what needs no program of the student's


@dataclass(frozen=True)
class ServiceAnswer:
    """What came of a call of a service: the fields of the response, or why there is none."""

    values: Optional[Dict[str, Any]]
    trouble: str = ""


@dataclass(frozen=True)
class FrameTransform:
    """Where the source is in the target frame, (x, y, z) [m], and its rotation, (x, y, z, w)."""

    translation: Tuple[float, ...]
    rotation: Tuple[float, ...]


@dataclass(frozen=True)
class Seen:
    """A program beside a Client: what that heard, of each topic and service, and was answered."""

    program: Ran
    heard: Dict[str, Tuple[Dict[str, Any], ...]]
    answers: Tuple[Any, ...]
    types: Dict[str, str]


def _fault(why: object) -> CannotCheck:
    """Return that the course is at fault, with FILE:LINE of it that called the Client."""
    frames = traceback.extract_stack()[::-1]
    frame = next(frame for frame in frames if frame.filename != __file__)
    return CannotCheck(f"{Path(frame.filename).name}:{frame.lineno}: {why}")


class Client:
    """A node on a ros; see common/doc/COURSES.md.

    If a type of the student's workspace is missing or does not fit the values, that is their
    mistake, and ends the recording; with another type it is the course's. See client_node, too.
    """

    def __init__(self, ros: RosSession) -> None:
        """Start it, with the student's rights: it imports what their workspace generates."""
        self._ros, self._numbers, self._buffer = ros, itertools.count(), b""
        self._answers: dict[int, Any] = {}
        self._kinds: dict[str, str] = {}  # of topics that are advertised
        self._line, theirs = socket.socketpair()
        self._line.settimeout(SLOW_S)
        command = ["/usr/bin/python3", str(Path(__file__).with_name("client_node.py"))]
        self._node = ros.runner.start(command, ros.environment, stdin=theirs.fileno())
        theirs.close()
        self._tell("services")  # it is up: what programs do soon is not missed

    def fields(self, kind: str) -> Tuple[str, ...]:
        """Return "TYPE NAME" of each field of a message; of a service with "---" in between."""
        return tuple(self._tell("fields", kind, of=kind))

    def ask(
        self, service: str, kind: str, values: object = None, seconds: float = START_S
    ) -> ServiceAnswer:
        """Call a service once it is there; wait no longer than that for the response."""
        response = self._tell("ask", service, kind, values or {}, of=kind, seconds=seconds)
        if response:
            return ServiceAnswer(*response)
        known = self._tell("services")
        trouble = f"there is no service {service}; there are: {', '.join(known) or 'none'}"
        return ServiceAnswer(None, f"{service} does not respond" if service in known else trouble)

    def serve(self, service: str, kind: str, values: object) -> None:
        """Offer a service that always responds with these values; heard() has the requests."""
        self._tell("serve", service, kind, values, of=kind)

    def listen(self, topic: str, kind: str) -> None:
        self._tell("listen", topic, kind, of=kind)

    def heard(self, name: str, since: int = 0) -> List[Heard]:
        """Return the messages of a topic, or the requests of a service."""
        return [(at_s, node, values) for at_s, node, values in self._tell("heard", name, since)]

    def seen(self, program: Program, *names: str, answers: Sequence[object] = ()) -> Seen:
        """Return what was seen until now. names: of topics and services; answers: plain values."""
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
        """Publish one message on a topic that is advertised; return when [s]."""
        return float(self._tell("send", topic, values, of=self._kinds[topic]))

    def meet(self, program: Program, *topics: str) -> bool:
        """Wait until a program has connected on these topics, and return whether it has."""

        def has_met() -> bool:
            return all(self._tell("connections", topic) for topic in topics)

        self._ros.wait_for_start(lambda: program.ended or has_met())
        return self._ros.meet(program) and has_met()

    def parameter(self, name: str) -> object:
        """Return the value of a parameter, or None."""
        return self._tell("parameter", name)

    def lookup(
        self, target: str, source: str, seconds: float = START_S
    ) -> Optional[FrameTransform]:
        """Return the newest transform, or None if there is none within that time."""
        newest = self._ros.wait(lambda: self._tell("lookup", target, source), seconds)
        return FrameTransform(*map(tuple, newest)) if newest else None

    def transforms(self) -> Tuple[str, ...]:
        """Return "PARENT -> CHILD" of each transform that came since the first lookup()."""
        return tuple(self._tell("transforms"))

    def _tell(self, what: str, *about: Any, of: str = "", seconds: Optional[float] = None) -> Any:
        """Return the node's answer; None after seconds. of: the type that it is about."""
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
        """Return whether an answer has come, or none will; read what there is, of others, too."""
        if select.select([self._line], [], [], 0)[0]:
            with contextlib.suppress(OSError):
                self._buffer += self._line.recv(1 << 20)
            if len(self._buffer) > MOST_BYTES:
                raise _fault(f"an answer of more than {MOST_BYTES >> 20} MB")
            *lines, self._buffer = self._buffer.split(b"\n")
            self._answers.update((answer["id"], answer) for answer in map(json.loads, lines))
        return number in self._answers or self._node.ended
