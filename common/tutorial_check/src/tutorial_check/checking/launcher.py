"""Starts a worker isolated, and makes the checks from what it records and what files say."""

from __future__ import annotations

import contextlib
import functools
import itertools
import json
import os
import subprocess
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Iterator

from tutorial_check.checking.ask_once import HANDED_IN, Answers, Ask, AskOnce
from tutorial_check.checking.checks import Run, checks_of
from tutorial_check.checking.results import Outcome, Result
from tutorial_check.checking.submission import Submission
from tutorial_check.course.definition import SUITE, Course, copy_sources, read_course
from tutorial_check.course.tasks import task_of
from tutorial_check.processes.errors import CannotCheck
from tutorial_check.recording.worker_process import Ended, Worker, no_more
from tutorial_check.sandbox import bubblewrap, privileges
from tutorial_check.sandbox.environment import environment_of
from tutorial_check.submission import workspace as workspaces
from tutorial_check.submission.order import Order

# Of a shell of the suite: roscore.xml, for a faster roslaunch; what CMake 4 needs for catkin.
OF_SUITE = ("ROS_ETC_DIR", "CMAKE_POLICY_VERSION_MINIMUM")
NUMBERS = itertools.count(os.getpid() * 100)

Report = Callable[[Outcome, Result], None]


def examine(
    asked: Order,
    report: Report = lambda outcome, result: None,
    side_by_side: bool = False,
) -> list[Outcome]:
    """Return the Outcomes of a workspace; report each result as it comes. Raises CannotCheck.

    side_by_side: a second worker may record what the last exercises need while the first are made.
    """
    asked, course = sourced(asked), read_course(asked.course)
    try:
        with contextlib.ExitStack() as stack:
            order, worker = stack.enter_context(_worker(asked))
            ask: Ask = worker.ask
            several = len(asked.exercises) > 1 and len(os.sched_getaffinity(0)) > 1
            if side_by_side and several and order.apart:
                ask = stack.enter_context(_with_another(asked, course, ask, order.folder))
            outcomes = judge(order, course, ask, report)
        remark = "" if order.own else bubblewrap.instead()
        return [replace(one, place=order.layout.place, remark=remark) for one in outcomes]
    except Ended as error:  # before a first result
        raise CannotCheck(str(error)) from None


@contextlib.contextmanager
def _worker(asked: Order) -> Iterator[tuple[Order, Worker]]:
    """Yield the whole order and a worker that can record."""
    user = privileges.unused_user(next(NUMBERS)) if os.geteuid() == 0 else None
    # Isolated, a worker does not reach the folder itself.
    folder, cleaner = privileges.folder_until_end("tutorial_check_", user)
    try:
        order = prepared(asked, Path(folder))
        wrapper = bubblewrap.command(folder, order.shown, SUITE)
        order = replace(order, apart=bool(wrapper))
        must_start_programs(order, is_other=user is not None)
        if user is not None:
            privileges.open_to(user, folder)
        wrapper = [*privileges.unlimited(), *wrapper, *privileges.as_user(user)]
        with Worker(order, wrapper) as worker:
            worker.begin()
            yield order, worker
    finally:
        cleaner.communicate()


@contextlib.contextmanager
def _with_another(asked: Order, course: Course, ask: Ask, folder: Path) -> Iterator[Ask]:
    """Yield ask() of a worker, while another one makes the checks from the last exercise on."""
    shared: Answers = {}
    with _worker(replace(asked, exercises=asked.exercises[::-1])) as (order, other):

        def make_checks() -> None:
            with contextlib.suppress(Exception, Ended):  # What it has recorded is of use.
                judge(order, course, AskOnce(other.ask, order.folder, shared))

        thread = threading.Thread(target=make_checks)
        thread.start()
        try:
            yield AskOnce(ask, folder, shared)
        finally:
            other.end()
            thread.join()


def prepared(asked: Order, folder: Path) -> Order:
    """Copy a workspace or zip into an empty folder; return the whole order. Raises CannotCheck."""
    layout, inside = workspaces.hand_in(os.path.abspath(asked.workspace), folder)
    workspaces.must_be_ones_own(layout, SUITE)
    copied = workspaces.copy(layout, folder / workspaces.COPY, None if asked.own else inside)
    shown = [inside, copied]
    if asked.own:
        shown += [layout.source, *map(Path, workspaces.named_outside(copied))]
    # A home folder is no workspace, though one may be in it.
    home = Path(os.path.expanduser("~")).resolve()
    shown = [each for each in shown if each.resolve() not in (home, *home.parents)]
    course = folder / "course" / asked.course.name
    copy_sources(asked.course, course)
    asked = sourced(asked)
    return replace(
        asked, course=course, folder=folder, layout=layout,
        shown=(*shown, course, *_needed(asked.underlay)),
    )  # fmt: skip


def sourced(asked: Order) -> Order:
    """Return an order with the environment of a shell of its underlay. Raises CannotCheck."""
    if asked.environment:
        return asked
    if not os.path.isfile(asked.underlay):
        why = "no such file, or may not be read; ./tutorial setup builds it"
        raise CannotCheck(f"{asked.underlay}: {why}")
    underlay = os.path.abspath(asked.underlay)
    return replace(asked, underlay=underlay, environment=_environment(underlay))


def _needed(underlay: str) -> tuple[Path, ...]:
    """Return what programs need: the underlay and its sources, this package among them."""
    devel = Path(underlay).parent
    names = devel / ".catkin"
    sources = filter(None, names.read_text().split(";") if names.is_file() else [])
    links = [link for source in sources for link in Path(source).glob("*") if link.is_dir()]
    return (devel.parent, *(link.resolve() for link in links))


@functools.lru_cache(maxsize=None)
def _environment(underlay: str) -> dict[str, str]:
    """Return what a shell has that has sourced setup.bash, and nothing else. Raises CannotCheck."""
    words = ["bash", "-c", '. "$1" >/dev/null && env -0', "bash", underlay]
    bare = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    about: dict[str, Any] = {"env": bare, "capture_output": True, "timeout": 120, "text": True}
    try:
        done = subprocess.run(words, check=True, **about)
    except (OSError, subprocess.SubprocessError) as error:
        why = (getattr(error, "stderr", "") or str(error))[-200:]
        raise CannotCheck(f"{underlay} cannot be sourced: {why}") from None
    # rospy loads numpy, which starts a thread for each processor; none is needed here.
    found = environment_of(done.stdout.split("\0"))
    own = {name: os.environ[name] for name in OF_SUITE if name in os.environ}
    # Nor what a student's program puts into a home folder for all that Python starts later.
    return {**found, **own, "OPENBLAS_NUM_THREADS": "1", "PYTHONNOUSERSITE": "1"}


def must_start_programs(order: Order, is_other: bool) -> None:
    """Raise CannotCheck where no program can be started. is_other: as another user."""
    if not order.apart and os.statvfs(order.folder).f_flag & os.ST_NOEXEC:
        why = "is mounted noexec: set TMPDIR to another folder"
        raise CannotCheck(f"no program can be started: {order.folder.parent} {why}")
    needed = set(_needed(order.underlay)) if is_other else set()
    ways = {up for one in (order.folder, *needed) for up in one.parents} if is_other else set()
    for folder in sorted(needed if order.apart else needed | ways):
        if not folder.stat().st_mode & 0o001:
            # What is below a needed one is as closed; but a home folder is opened no further.
            is_needed = needed & {folder, *folder.parents}
            how = f"{'chmod -R o+rX' if is_needed else 'chmod o+x'} {folder}"
            how += ", or keep this suite, TUTORIAL_WORKSPACE and TMPDIR where others may enter"
            why = "is closed to others, and the programs run as another user"
            raise CannotCheck(f"{folder} {why}: {how}")


def judge(
    order: Order, course: Course, ask: Ask, report: Report = lambda outcome, result: None
) -> list[Outcome]:
    """Make the checks of an order from what a worker answers. Raises CannotCheck."""
    checks = checks_of(course)
    task = task_of(course)(order.variant)  # its class is among the checks
    checks = [replace(one, title=task.fill(one.title), look=task.fill(one.look)) for one in checks]
    case = Submission(order, task, ask)
    run = Run(checks, case, case.second_look, lambda: case.hopeless)
    known = ((name, course.exercises[name]) for name in order.exercises)
    outcomes = [Outcome(name, title=one.title, points=one.points) for name, one in known]
    try:
        for outcome in outcomes:
            _make_checks(run, case, outcome, order.only_first, report)
            if order.only_first and not outcome.passed:
                break
    except Ended as error:
        if no_more.is_set() or not any(outcome.results for outcome in outcomes):
            raise CannotCheck(str(error)) from None
        for outcome in outcomes:
            outcome.trouble = outcome.trouble if outcome.done else str(error)
    return outcomes


def _make_checks(
    run: Run, case: Submission, outcome: Outcome, only_first: bool, report: Report
) -> None:
    began_s, already = time.monotonic(), len(case.asked)
    try:
        for found in run.exercise(outcome.id, only_first):
            result = case.as_sent(found)
            outcome.results.append(result)
            report(outcome, result)
    finally:  # what was recorded before the worker ended is of most interest
        asked = json.dumps(case.asked[already:])
        outcome.recordings = json.loads(asked.replace(f"{case.folder}/", f"{HANDED_IN}/"))
    outcome.seconds = round(time.monotonic() - began_s, 2)
    outcome.done, outcome.trouble = True, run.trouble(outcome.id)
