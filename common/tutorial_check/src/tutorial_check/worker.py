"""Records in isolation: python3 -m tutorial_check.worker.

Its order comes as JSON on standard input. Then each line of a socket asks for a recording,
{"recorder": "MODULE:NAME", "arguments": [...]}, and is answered by a line: {"recording": {...}},
{"cut_short": {"kind", "seen"}} (see model.CutShort), or {"cannot": "why"}; each also says whether the
machine kept the programs waiting, and has the version of recordings. A socket, unlike a pipe, is
opened by no path in /proc.
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
from pathlib import Path

from tutorial_check.course import checks_of, read_course
from tutorial_check.isolation import bubblewrap, environment, landlock, privileges
from tutorial_check.isolation.runner import Runner
from tutorial_check.model import CannotCheck, CutShort, fault
from tutorial_check.order import Line, Order
from tutorial_check.record.ground import Ground
from tutorial_check.record.recording import VERSION, arguments_of, as_json, from_json
from tutorial_check.source import workspace
from tutorial_check.variants import task_of


def main() -> None:
    """Read the order, then record what is asked for until nobody asks any more."""
    privileges.keep_to_itself()
    order = from_json(Order, json.load(sys.stdin))
    if order.apart:
        privileges.prctl(privileges.PR_SET_PDEATHSIG, signal.SIGKILL)  # ends with bwrap
    else:  # its runner notices that the reader has ended, and ends what was started
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        # In a container no other process may reap.
        privileges.prctl(privileges.PR_SET_CHILD_SUBREAPER, 1)
    line = socket.socket(fileno=os.dup(1))
    line.set_inheritable(False)
    os.dup2(2, 1)  # nothing else gets into the answers
    try:
        _serve(order, line)
    except Exception as error:  # not the student's fault, whatever it is
        if not isinstance(error, CannotCheck):
            traceback.print_exc()
        _send(line, {"cannot": fault(error)})
    finally:  # the process that made the folder may have been killed
        shutil.rmtree(order.folder, ignore_errors=True)


def _send(line: socket.socket, what: Line) -> None:
    with contextlib.suppress(OSError):  # nobody listens
        line.sendall(json.dumps(what).encode() + b"\n")


def _serve(order: Order, line: socket.socket) -> None:
    ground = _prepared(order, line.fileno())
    try:
        _send(line, {"ready": True})
        for asked in line.makefile():
            _send(line, answer(ground, json.loads(asked)))
    finally:
        ground.runner.clear()  # a build, too, is ended; where no namespace is, nothing else does that


def answer(ground: Ground, asked: Line) -> Line:
    """Return the answer to a question; both as above."""
    clock, found = ground.runner.clock, _recorded(ground, asked)
    return {"version": VERSION, **found, "strained": clock.strained(), "hopeless": clock.hopeless()}


def _recorded(ground: Ground, asked: Line) -> Line:
    module, _, name = asked["recorder"].partition(":")
    try:
        recorder = getattr(importlib.import_module(module), name)
        return {"recording": as_json(recorder(ground, *arguments_of(recorder, asked["arguments"])))}
    except CutShort as end:
        return {"cut_short": {"kind": end.kind, "seen": end.seen}}
    except Exception as error:
        if not isinstance(error, CannotCheck):
            traceback.print_exc()
        return {"cannot": fault(error)}


def _prepared(order: Order, reader: int) -> Ground:
    """Return the ground of an order. reader: see Runner."""
    scratch = order.folder
    shutil.copytree(scratch / workspace.COPY, scratch / "ws" / "src", symlinks=True)
    environment.prepare(scratch)
    variables = environment.variables(scratch, order.environment)
    shown: list[str | Path] = [scratch, *order.shown, *bubblewrap.SYSTEM, "/proc"]
    own = [scratch / name for name in environment.OWN]
    ruleset = landlock.ruleset(shown, own) if landlock.version() and not order.apart else None
    course = read_course(order.course)
    checks_of(course)  # its recorders
    task = task_of(course)(order.variant)
    return Ground(order, task, Runner(variables, order.apart, reader, ruleset))


if __name__ == "__main__":
    main()
