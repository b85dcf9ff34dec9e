"""The checker's end of any type: services, messages, parameters and transforms."""

from __future__ import annotations

import json
import select
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Optional, Tuple

from tutorial_check.isolation.program import Program
from tutorial_check.model import NO_TYPE, CannotCheck, CutShort
from tutorial_check.record.stage import SETTLE_S, START_S, Stage
from tutorial_check.source.tracebacks import last_lines

Heard = Tuple[float, str, Dict[str, Any]]  # (when it came [s], from which node, its fields)
SLOW_S = 30.0  # for what needs no program of the student's


@dataclass(frozen=True)
class Answer:
    """What came of a call of a service: the fields of the response, or why there is none."""

    values: Optional[Dict[str, Any]]
    trouble: str = ""


@dataclass(frozen=True)
class Transform:
    """Where the source frame is in the target frame [m], its rotation (x, y, z, w), and when [s]."""

    translation: Tuple[float, float, float]
    rotation: Tuple[float, float, float, float]
    stamp: float


class _Fault(Exception):
    """OF_PROGRAM; see client_node."""


class Client:
    """A node on a stage; see common/doc/COURSES.md.

    A type that the student's workspace has to define, and does not, or otherwise, is their mistake
    and ends the recording; another such type is the course's. Values are maps, lists, texts, numbers.
    """

    def __init__(self, stage: Stage) -> None:
        """Start it, with the student's rights: it imports what their workspace generates."""
        self._stage, self._asked = stage, 0
        self._answers: dict[int, Any] = {}
        self._kinds: dict[str, str] = {}  # of topics that are advertised
        self._buffer = b""
        self._line, theirs = socket.socketpair()
        command = ["/usr/bin/python3", str(Path(__file__).with_name("client_node.py"))]
        self._node = stage.runner.start(command, stage.environment, stdin=theirs.fileno())
        theirs.close()
        self._tell("services")  # it is up: what programs do soon is not missed

    def fields(self, kind: str) -> Tuple[str, ...]:
        """Return "TYPE NAME" of each field of a message; of a service with "---" in between."""
        return tuple(self._tell("fields", kind, of=kind))

    def ask(self, service: str, kind: str, values: Any = (), seconds: float = START_S) -> Answer:
        """Call a service, once it is there; wait no longer than that for the response."""
        try:
            return Answer(self._tell("ask", service, kind, values, of=kind, seconds=seconds))
        except _Fault as fault:
            return Answer(None, str(fault))
        except TimeoutError:
            there = self._tell("services")
        known = ", ".join(
            name for name in there if not name.endswith(("_loggers", "_logger_level"))
        )
        trouble = f"there is no service {service}; there are: {known or 'none'}"
        return Answer(None, f"{service} does not respond" if service in there else trouble)

    def serve(self, service: str, kind: str, values: Any) -> None:
        """Offer a service that always responds with these values; heard() has the requests."""
        self._tell("serve", service, kind, values, of=kind)

    def listen(self, topic: str, kind: str) -> None:
        self._tell("listen", topic, kind, of=kind)

    def heard(self, name: str, since: int = 0) -> Tuple[Heard, ...]:
        """Return the messages of a topic, or the requests of a service."""
        return tuple(
            (at_s, node, values) for at_s, node, values in self._tell("heard", name, since)
        )

    def count(self, name: str) -> int:
        return int(self._tell("count", name))

    def advertise(self, topic: str, kind: str) -> None:
        self._tell("advertise", topic, kind, of=kind)
        self._kinds[topic] = kind

    def send(self, topic: str, values: Any) -> float:
        """Publish one message on a topic that is advertised; return when [s]."""
        return float(self._tell("send", topic, values, of=self._kinds[topic]))

    def meet(self, program: Program, *topics: str) -> bool:
        """Return whether a program has connected on these topics; wait for that. See Stage.meet."""

        def has_met() -> bool:
            return all([self._tell("connections", topic) for topic in topics])

        self._stage.wait_for_start(lambda: program.ended or has_met())
        self._stage.wait(lambda: program.ended or program.rests(), SETTLE_S)
        return not program.ended and has_met()

    def parameter(self, name: str) -> Any:
        """Return the value of a parameter, or None."""
        return self._tell("parameter", name)

    def lookup(self, target: str, source: str, seconds: float = START_S) -> Optional[Transform]:
        """Return the newest transform, or None if there is none within that time."""
        found = self._stage.wait(lambda: self._tell("lookup", target, source), seconds)
        return Transform(tuple(found[0]), tuple(found[1]), found[2]) if found else None

    def _tell(self, what: str, *about: Any, of: str = "", seconds: float = SLOW_S) -> Any:
        """Return the node's answer. of: the type that it is about. Raises TimeoutError, _Fault."""
        self._asked += 1
        number = self._asked
        try:
            line = json.dumps({"id": number, "do": what, "with": about})
        except TypeError as error:
            raise CannotCheck(f"client.{what}: {error}") from None
        self._line.sendall(f"{line}\n".encode())
        self._stage.wait(
            lambda: self._has(number) or self._node.ended, seconds, or_idle=what == "ask"
        )
        if not self._has(number):
            if self._node.ended:
                raise CannotCheck(
                    f"the checker's client has ended: {last_lines(self._node.output)}"
                )
            raise TimeoutError
        answer = self._answers.pop(number)
        fault = answer.get("fault")
        if not fault:
            return answer["value"]
        if fault["kind"] == "program":
            raise _Fault(fault["text"])
        is_students = any(
            each.name == of.partition("/")[0] for each in self._stage.session.packages
        )
        if fault["kind"] == "type" and is_students:
            raise CutShort(NO_TYPE, fault["text"])
        raise CannotCheck(f"client.{what}: {fault['text']}")

    def _has(self, number: int) -> bool:
        """Return whether an answer has come; read what is there."""
        while select.select([self._line], [], [], 0)[0]:
            data = self._line.recv(1 << 20)
            if not data:
                break
            *lines, self._buffer = (self._buffer + data).split(b"\n")
            for line in lines:
                answer = json.loads(line)
                self._answers[answer["id"]] = answer
        return number in self._answers
