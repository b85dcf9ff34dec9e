"""One trial: the hands and faults of a plan on a live world, and the judgement on it."""

import contextlib
import heapq
import itertools
import time

from tutorial_faults.events import Violation
from tutorial_faults.live.injuries import inflict
from tutorial_faults.live.judge import judge
from tutorial_faults.live.kinds import BASE, KINDS
from tutorial_faults.live.plan import RELEASED

LATE_S = 0.15  # a gap in which this machine did not run the hunt, or the base: judged anew
ATTEMPTS = 4  # at a trial in which the machine was late


class LateError(Exception):
    """This machine was too late, again and again, to judge a trial."""


def run(world, plan):
    """Try a Plan; (Judgement, judge.Record). Raises LateError."""
    for _ in range(ATTEMPTS):
        record = _act(world, plan)
        if not was_late(record):
            return judge(record), record
        judgement = judge(record)
        if not judgement.violations:
            return judgement, record
    raise LateError


def was_late(record):
    """Whether what was seen may be the lateness of this machine."""
    if any(length > LATE_S for _, length in record.late):
        return True
    lost = any(KINDS[injury.kind].part == BASE for injury in record.injuries)
    stamps = [wheels.at_s for wheels in record.wheels]
    return not lost and any(b - a > LATE_S for a, b in zip(stamps, stamps[1:]))


def _act(world, plan):
    """Do what the plan says; the judge.Record."""
    try:
        world.hands.be_radio(plan.is_radio)
        world.drive()
    except AssertionError as error:
        record = world.record
        if was_late(record):
            raise LateError from error
        world.begin_record()
        record.told.append(Violation("h", time.time(), f"before the faults: {error}"))
        return record
    began = time.monotonic()
    numbers = itertools.count()
    schedule = [(hand.at_s, next(numbers), world.hands.show, hand.shows) for hand in plan.hands]
    with contextlib.ExitStack() as stack:
        for fault in plan.faults:
            injury = inflict(world, fault)
            own = stack.enter_context(contextlib.ExitStack())
            schedule.append((fault.at_s, next(numbers), own.enter_context, injury))
            schedule.append((fault.end_s, next(numbers), lambda end: end.close(), own))
        heapq.heapify(schedule)
        while schedule:
            at_s, _, do, what = heapq.heappop(schedule)
            time.sleep(max(0.0, began + at_s - time.monotonic()))
            do(what)
    time.sleep(max(0.0, began + plan.lasts_s - time.monotonic()))
    world.hands.show(RELEASED)
    return world.record
