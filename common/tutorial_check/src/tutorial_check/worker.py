"""The examination itself, isolated: python3 -m tutorial_check.worker.

Its orders come as JSON on standard input. What it finds goes out as JSON lines through a socket, which
unlike a pipe no path in /proc opens: {"exercise": id, "result": {...}}, {"exercise": id, "done":
seconds, "trouble": why it could not be checked as a whole, or ""}, and at the end {"end": true} or
{"cannot": "why"}.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import shlex
import shutil
import signal
import sys
import time
import traceback
from pathlib import Path
from typing import Any, Callable

from tutorial_check.isolation import bubblewrap, environment, privileges
from tutorial_check.model import CannotCheck, Result, Run, fault, passed
from tutorial_check.order import Order
from tutorial_check.record.recording import from_json
from tutorial_check.source import workspace

Send = Callable[..., None]
SHARED_PAGES = 1 << 16  # of System V shared memory: 256 MB


def main() -> None:
    """Read the orders, examine, send what is found."""
    os.umask(0o022)  # programs that run as another user read what we write
    privileges.keep_to_itself()
    order = from_json(Order, json.load(sys.stdin))
    if order.apart:
        privileges.prctl(privileges.PR_SET_PDEATHSIG, signal.SIGKILL)  # of bwrap
        with contextlib.suppress(OSError):  # where the kernel does not allow it
            Path("/proc/sys/kernel/shmall").write_text(str(SHARED_PAGES))
    else:  # its runner notices that the reader has ended, and ends what was started
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        privileges.prctl(
            privileges.PR_SET_CHILD_SUBREAPER, 1
        )  # in a container no other process may reap
    line = os.fdopen(os.dup(1), "w", buffering=1)
    os.set_inheritable(line.fileno(), False)
    os.dup2(2, 1)  # nothing else gets into the results

    def send(**what: Any) -> None:
        line.write(json.dumps(what) + "\n")

    try:
        examine(order, send, line.fileno())
        send(end=True)
    except Exception as error:  # not the student's fault, whatever it is
        if not isinstance(error, CannotCheck):
            traceback.print_exc()
        send(cannot=fault(error))
    finally:  # the process that made the folder may have been killed
        privileges.restore_rights()
        shutil.rmtree(order.folder, ignore_errors=True)


def examine(order: Order, send: Send, result: int) -> None:
    """Make the checks of an order, and send their results. result: see Runner."""
    scratch = Path(order.folder)
    layout = workspace.Layout(Path(order.root), Path(order.source), order.is_workspace)
    shutil.copytree(scratch / workspace.COPY, scratch / "ws" / "src", symlinks=True)
    # Before ROS, which reads the environment as it loads.
    home = str(scratch / "ours")
    os.environ.update(HOME=home, ROS_HOME=home, ROS_LOG_DIR=home, ROS_IP="127.0.0.1")
    os.environ.pop("ROS_HOSTNAME", None)

    from tutorial_check import variants  # noqa: PLC0415
    from tutorial_check.course import checks_of, read_course  # noqa: PLC0415
    from tutorial_check.isolation import landlock, runner  # noqa: PLC0415
    from tutorial_check.record.ground import Ground  # noqa: PLC0415

    uid = privileges.unused_user(order.number) if os.geteuid() == 0 else None
    environment.prepare(scratch, uid)
    scratch.chmod(0o755)
    apart = order.apart
    variables = environment.variables(scratch, order.environment)
    shown: list[str | Path] = [scratch, *order.shown, *bubblewrap.SYSTEM, "/proc"]
    own = [scratch / name for name in environment.OWN]
    ruleset = landlock.ruleset(shown, own) if landlock.version() and not apart else None
    course = read_course(order.course)
    checks = checks_of(course)
    one = Ground(
        scratch,
        layout,
        order.exercises,
        runner.Runner(variables, uid, apart, result, ruleset),
        underlay=order.underlay,
        can_have_devices=apart,
        needed=[*order.kept, Path(__file__)],
        task=variants.task_of(course)(order.variant),
    )
    run = Run(checks, one, one.second_look, one.runner.clock.hopeless)
    if uid is not None:
        if not apart:  # then the suite may lie where that user cannot read
            importlib.import_module("rosbag")
            importlib.import_module("tutorial_check.record.driver")
        os.setgroups([])
        privileges.touch_files_as(uid, uid)
    one.must_start_programs()
    as_sent = _paths_of_the_student(scratch, layout, order.own)
    try:
        _run_exercises(run, order, send, lambda found: as_sent(one.task.words(found)))
    finally:
        one.runner.clear()  # a build, too, is ended; where no namespace is, nothing else does that


def _run_exercises(
    run: Run, order: Order, send: Send, as_sent: Callable[[Result], dict[str, Any]]
) -> None:
    """Send the results of each exercise as they come, then how long it took."""
    for exercise in order.exercises:
        began_s, results = time.monotonic(), []
        for found in run.exercise(exercise, order.only_first):
            send(exercise=exercise, result=as_sent(found))
            results.append(found)
        seconds = round(time.monotonic() - began_s, 2)
        send(exercise=exercise, done=seconds, trouble=run.trouble(exercise))
        if order.only_first and not passed(results):
            return


def _paths_of_the_student(
    scratch: Path, layout: workspace.Layout, own: bool
) -> Callable[[Result], dict[str, Any]]:
    """Return a function that gives a Result as a dict, in which paths of the copy are the student's."""
    copied = f"{scratch}/ws/" if layout.is_workspace else f"{scratch}/ws/src/"
    # Commands work in any folder, where the workspace is known.
    is_known = own and scratch not in layout.root.parents
    root = f"{shlex.quote(str(layout.root))}/" if is_known else ""

    def as_sent(result: Result) -> dict[str, Any]:
        found = dict(vars(result))
        for name, words in found.items():
            if isinstance(words, str):
                found[name] = words.replace(copied, root if name in ("hint", "look") else "")
        return found

    return as_sent


if __name__ == "__main__":
    main()
