"""Record in isolation: python3 -m tutorial_check.recording.worker.

Arguments: descriptors, see BuildStore.

Standard output is a socket: unlike a pipe, it has no path in /proc that opens it. Each line is
JSON: an Order, then Questions, each answered by a Reply. Replies name no folder of this machine.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import shutil
import signal
import socket
import sys
import traceback
from dataclasses import replace
from pathlib import Path
from typing import Iterable, Iterator

from tutorial_check.course.definition import load, read_course
from tutorial_check.course.tasks import task_of
from tutorial_check.data.json_data import arguments_of, as_json, from_json
from tutorial_check.errors import CannotCheck, CutShort, fault
from tutorial_check.processes.runner import Runner
from tutorial_check.recording.workspace import Workspace
from tutorial_check.sandbox import environment, landlock, privileges
from tutorial_check.submission import handed_in
from tutorial_check.submission.order import Order, Question, Reply


def main() -> None:
    """Read the order, then answer questions until the connection closes."""
    privileges.keep_to_itself()
    line = socket.socket(fileno=os.dup(1))
    line.set_inheritable(False)
    os.dup2(2, 1)  # so that nothing else gets into the replies
    lines = line.makefile()
    order = from_json(Order, json.loads(next(lines)))
    if order.sandbox.in_namespaces:
        privileges.prctl(privileges.PR_SET_PDEATHSIG, signal.SIGKILL)  # ends with bwrap
    else:  # its runner notices the end of the reader, and ends the programs
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        # In a container there may be no other process that reaps.
        privileges.prctl(privileges.PR_SET_CHILD_SUBREAPER, 1)
    try:
        for reply in _replies(order, line.fileno(), lines):
            with contextlib.suppress(OSError):  # the reader has ended
                line.sendall(json.dumps(as_json(reply)).encode() + b"\n")
    finally:  # the process that made the folder may have been killed
        shutil.rmtree(order.folder, ignore_errors=True)


def _replies(order: Order, reader: int, lines: Iterable[str]) -> Iterator[Reply]:
    """Yield a Reply when ready, then the reply to each question. reader: see Runner."""
    try:
        workspace = _prepared(order, reader)
    except Exception as error:
        yield _cannot(error)
        return
    try:
        yield Reply()
        for line in lines:
            reply = reply_to(from_json(Question, json.loads(line)), workspace)
            yield workspace.places.named(reply)
    finally:
        workspace.runner.clear()  # ends builds, too: without a namespace nothing else does


def reply_to(question: Question, workspace: Workspace) -> Reply:
    """Return the reply to a question: a recording, or why there is none."""
    module, _, name = question.recorder.partition(":")
    try:
        recorder = getattr(importlib.import_module(module), name)
        recording = recorder(workspace, *arguments_of(recorder, question.arguments))
        _must_be_data(recording, question.recorder)
        reply = Reply(recording)
    except CutShort as end:
        reply = Reply(cut_short=end)
    except Exception as error:
        reply = _cannot(error)
    clock = workspace.runner.clock
    return replace(reply, busy=clock.busy(), overloaded=clock.overloaded())


def _must_be_data(recording: object, recorder: str) -> None:
    """Raise CannotCheck for a recording that has anything but data in it."""
    try:
        json.dumps(as_json(recording))
    except TypeError as error:
        module, _, name = recorder.rpartition(".")[2].partition(":")
        why = f"{name}() records what is no text, number or dataclass ({error})"
        raise CannotCheck(f"{module}.py: {why}; of a program record .ran") from None


def _cannot(error: Exception) -> Reply:
    """Return the reply for an error that is not the student's fault."""
    if not isinstance(error, CannotCheck):
        traceback.print_exc()
    return Reply(cannot=fault(error))


def _prepared(order: Order, reader: int) -> Workspace:
    scratch = order.folder
    shutil.copytree(scratch / handed_in.COPY, scratch / "ws" / "src", symlinks=True)
    environment.prepare(scratch)
    variables = environment.variables(scratch, order.sandbox.environment)
    readable: list[str | Path] = [scratch, *order.sandbox.readable, *environment.SYSTEM, "/proc"]
    own = [scratch / name for name in environment.OWN]
    ruleset = None
    if landlock.version() and not order.sandbox.in_namespaces:
        ruleset = landlock.ruleset(readable, own)
    course = read_course(order.course)
    load(course)  # its recorders
    runner = Runner(variables, order.sandbox.in_namespaces, reader, ruleset)
    return Workspace(order, task_of(course)(order.variant), runner, *map(int, sys.argv[1:]))


if __name__ == "__main__":
    main()
