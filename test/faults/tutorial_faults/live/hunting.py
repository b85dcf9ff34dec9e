"""Many trials, one after the other, on a live world, and what each came to."""

import contextlib
import heapq
import itertools
import sys
import time

from tutorial_faults.live.judge import judge
from tutorial_faults.live.kinds import BASE, KINDS, chosen, inflicted
from tutorial_faults.live.plan import draw
from tutorial_faults.live.report import Result, timeline
from tutorial_faults.live.world import World
from tutorial_testing.hands import RELEASED

SHORTEST_S = 60.0  # without --for and --trials
LATE_S = 0.15  # a gap in which this machine did not run the hunt, or the base: judged again
ATTEMPTS = 4  # at a trial in which the machine was late


class LateError(Exception):
    """This machine was too late, again and again, to judge a trial."""


# Of the hunt itself: a program that does not start, an answer that does not come.
FAILURES = (AssertionError, TimeoutError, OSError, LateError)


def run_trial(world, plan):
    """Try a Plan; return (Judgement, judge.Record). Raises LateError."""
    for _ in range(ATTEMPTS):
        record = act(world, plan)
        judgement = judge(record)
        if not judgement.violations or not was_late(record):
            return judgement, record
    raise LateError("this machine was too late")


def was_late(record):
    """Return whether what was seen may be the lateness of this machine."""
    if any(length > LATE_S for _, length in record.late):
        return True
    lost = any(KINDS[injury.kind].part == BASE for injury in record.injuries)
    stamps = [wheels.at_s for wheels in record.wheels]
    return not lost and any(b - a > LATE_S for a, b in zip(stamps, stamps[1:]))


def act(world, plan):
    """Do what the plan says; return the judge.Record."""
    try:
        world.hands.be_radio(plan.is_radio)
        world.drive(plan.heading_rad)
    except AssertionError as error:
        if was_late(world.record):
            raise LateError("this machine was too late") from error
        world.begin_record()
        world.report("h", f"before the faults: {error}")
        world.is_used_up = True
        return world.record
    began = time.monotonic()
    numbers = itertools.count()
    schedule = [(hand.at_s, next(numbers), world.hands.show, hand.shows) for hand in plan.hands]
    with contextlib.ExitStack() as stack:
        for fault in plan.faults:
            own = stack.enter_context(contextlib.ExitStack())
            begin = (own.enter_context, inflicted(world, fault))
            schedule.append((fault.at_s, next(numbers), *begin))
            schedule.append((fault.end_s, next(numbers), lambda end: end.close(), own))
        heapq.heapify(schedule)
        while schedule:
            at_s, _, do, what = heapq.heappop(schedule)
            time.sleep(max(0.0, began + at_s - time.monotonic()))
            do(what)
    time.sleep(max(0.0, began + plan.lasts_s - time.monotonic()))
    world.hands.show(RELEASED)
    return world.record


class Hunt:
    """The trials, on a world that is replaced when it cannot be repaired. A context manager."""

    def __init__(self, hosts, options, node=()):
        """hosts: hosts.Hosts. options: of program.parse(). node: see world.World."""
        self._hosts, self._options, self._node = hosts, options, node
        self._names = chosen(options.kinds, hosts.granted)
        self._world = None
        self._last_words = []
        self.results, self.not_judged = [], 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._world:
            self._world.__exit__()
        self._world = None

    def end(self):
        """End all nodes as by Ctrl-C; report those that do not exit, or leave a process."""
        for violation in self._world.end() if self._world and not self._node else ():
            print(f"VIOLATION at the end: (g) {violation.what}", flush=True)
            self.results.append(Result(self._options.seed, (), 0.0, ("g",)))

    def _seeds(self):
        options, began = self._options, time.monotonic()
        seconds = options.seconds or (0.0 if options.trials else SHORTEST_S)
        for number in itertools.count() if seconds else range(options.trials):
            if seconds and time.monotonic() - began > seconds:
                return
            yield options.seed + number

    def run(self):
        """Try all; yield each Result and the lines about it."""
        for seed in self._seeds():
            plan = draw(seed, self._names)
            try:
                judgement, record = self._attempt(plan)
            except FAILURES as error:
                self.not_judged += 1
                if not isinstance(error, LateError):
                    print(f"faults: seed {seed} could not be tried: {error}", file=sys.stderr)
                    self.__exit__()
                continue
            letters = tuple(sorted({v.invariant for v in judgement.violations}))
            kinds = tuple(fault.kind for fault in plan.faults)
            self.results.append(Result(seed, kinds, judgement.rest_s, letters))
            yield self.results[-1], self._lines(plan, judgement, record) if letters else []

    def _attempt(self, plan):
        if not self._world:
            world = World(self._hosts, self._node, self._options.in_a_cell)
            self._world = world.__enter__()
        answer = run_trial(self._world, plan)
        self._last_words = self._world.last_words()
        if self._world.is_used_up:
            self.__exit__()
        return answer

    def _lines(self, plan, judgement, record):
        """Return the lines about a trial that violates an invariant."""
        options = self._options
        node = f" --node {options.node}" if self._node else ""
        kinds = f" --kinds {' '.join(options.kinds)}" if options.kinds else ""
        cell = " --in-a-cell" if options.in_a_cell else ""
        lines = [f"VIOLATION, seed {plan.seed}: {plan}"]
        lines += [f"  ({v.invariant}) {v.what}" for v in judgement.violations]
        lines += [f"  {line}" for line in timeline(record, judgement.violations)]
        again = f"./tutorial test faults --seed {plan.seed} --trials 1{node}{kinds}{cell}"
        return [*lines, f"  again: {again}", *self._last_words]
