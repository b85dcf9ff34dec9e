"""Run the checks of a workspace, with workers that record."""

from __future__ import annotations

import contextlib
import os
import threading
import time
from dataclasses import replace
from typing import Callable, Iterator

from tutorial_check.checking.checks import CheckRunner, checks_of
from tutorial_check.checking.results import Outcome, Result
from tutorial_check.checking.submission import Submission
from tutorial_check.course.definition import Course, read_course
from tutorial_check.course.tasks import task_of
from tutorial_check.errors import CannotCheck, CheckerError, Ended
from tutorial_check.examining.ask_once import AskOnce, Replies
from tutorial_check.recording.launcher import sourced, started
from tutorial_check.recording.worker_process import no_more
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Ask, Order

Report = Callable[[Outcome, Result], None]


def silent(outcome: Outcome, result: Result) -> None:
    """Report nothing."""


def examine(bare: Order, report: Report = silent, side_by_side: bool = False) -> list[Outcome]:
    """Return the Outcomes of a workspace; report each result as it comes. Raises CannotCheck.

    side_by_side: a second worker may record for the last exercises at the same time.
    """
    bare, course = sourced(bare), read_course(bare.course)
    try:
        with contextlib.ExitStack() as stack:
            order, worker = stack.enter_context(started(bare))
            ask: Ask = worker.ask
            several = len(bare.exercises) > 1 and len(os.sched_getaffinity(0)) > 1
            if side_by_side and several and order.sandbox.in_namespaces:
                if _needs_build(order, course, ask):  # once, not in both workers
                    worker.build()
                ask = stack.enter_context(_with_another(bare, course, ask))
            outcomes = judge(order, course, ask, report)
        remark = "" if order.is_callers_own else bubblewrap.instead()
        place = order.layout.place
        return [replace(outcome, place=place, remark=remark) for outcome in outcomes]
    except Ended as error:  # before a first result
        raise CannotCheck(str(error)) from None


def _needs_build(order: Order, course: Course, ask: Ask) -> bool:
    """Return whether programs need a build, as far as the files can be read."""
    checks_of(course)  # loads the course
    with contextlib.suppress(CheckerError):
        return Submission(order, task_of(course)(order.variant), ask).needs_build()
    return False


@contextlib.contextmanager
def _with_another(bare: Order, course: Course, ask: Ask) -> Iterator[Ask]:
    """Yield ask() of a worker, while another one records from the last exercise backwards."""
    shared: Replies = {}
    checks_of(course)  # loads the course before the thread asks for it
    with started(replace(bare, exercises=bare.exercises[::-1])) as (order, other):

        def make_checks() -> None:
            with contextlib.suppress(Exception, Ended):  # its recordings are still useful
                judge(order, course, AskOnce(other.ask, shared))

        thread = threading.Thread(target=make_checks)
        thread.start()
        try:
            yield AskOnce(ask, shared)
        finally:
            other.end()
            thread.join()


def judge(order: Order, course: Course, ask: Ask, report: Report = silent) -> list[Outcome]:
    """Run the checks of an order on a worker's recordings. Raises CannotCheck."""
    checks = checks_of(course)
    task = task_of(course)(order.variant)  # its class is defined beside the checks
    submission = Submission(order, task, ask)

    def filled(text: str) -> str:
        return submission.with_names(task.fill(text))

    checks = [replace(c, title=filled(c.title), look=filled(c.look)) for c in checks]
    runner = CheckRunner(checks, submission)
    outcomes = []
    for name in order.exercises:
        exercise = course.exercises[name]
        outcomes.append(Outcome(name, title=exercise.title, points=exercise.points))
    try:
        for outcome in outcomes:
            _make_checks(runner, submission, outcome, order.only_first, report)
            if order.only_first and not outcome.passed:
                break
    except Ended as error:
        if no_more.is_set() or not any(outcome.results for outcome in outcomes):
            raise CannotCheck(str(error)) from None
        for outcome in outcomes:
            outcome.trouble = outcome.trouble if outcome.done else str(error)
    return outcomes


def _make_checks(
    runner: CheckRunner, submission: Submission, outcome: Outcome, only_first: bool, report: Report
) -> None:
    began_s, already = time.monotonic(), len(submission.exchanges)
    try:
        for made in runner.exercise(outcome.id, only_first):
            result = submission.as_sent(made)
            outcome.results.append(result)
            report(outcome, result)
    finally:  # what was recorded before the worker ended matters most
        outcome.recordings = submission.exchanges[already:]
    outcome.seconds = round(time.monotonic() - began_s, 2)
    outcome.done, outcome.trouble = True, runner.trouble(outcome.id)
