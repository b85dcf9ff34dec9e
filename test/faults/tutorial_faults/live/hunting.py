"""Many trials, one after the other, and what came of each."""

import sys
import time

from tutorial_faults.live import trial
from tutorial_faults.live.kinds import chosen
from tutorial_faults.live.plan import draw, in_words
from tutorial_faults.live.report import violation_lines
from tutorial_faults.live.shrink import shrink
from tutorial_faults.live.table import Result
from tutorial_faults.live.world import World

SHORTEST_S = 60.0  # without --for and --trials
# Of the hunt itself: a program that does not start, an answer that does not come.
FAILURES = (AssertionError, TimeoutError, OSError)


class Hunt:
    """The trials, one after the other, on a world that is made anew when a trial needs another."""

    def __init__(self, the_hosts, folder, options, node=()):
        """the_hosts: hosts.Hosts. options: of program.parse(). node: see world.World."""
        self._hosts, self._folder, self._options = the_hosts, folder, options
        self._node = node
        self._names = chosen(options.kinds, the_hosts.granted)
        self._world, self._last_words = None, []
        self.results, self.not_judged = [], 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._leave()

    def _leave(self):
        """End the world."""
        if self._world:
            self._world.__exit__(None, None, None)
        self._world = None

    def end(self):
        """Have all nodes end as by Ctrl-C; say so if one does not, or leaves a process."""
        for violation in self._world.end() if self._world and not self._node else ():
            print(f"VIOLATION at the end: (g) {violation.what}", flush=True)
            self.results.append(Result(self._options.seed, (), 0.0, ("g",)))

    def world(self, simulated):
        """The World, started if need be."""
        if self._world and self._world.simulated != simulated:
            self._leave()
        if not self._world:
            self._world = World(self._hosts, self._folder, self._node, simulated).__enter__()
        return self._world

    def seeds(self):
        """The seeds of the trials, as long as there shall be more."""
        options, began = self._options, time.monotonic()
        seconds = options.seconds or (0.0 if options.trials else SHORTEST_S)
        number = 0
        while number < (options.trials or float("inf")):
            if seconds and time.monotonic() - began > seconds:
                return
            yield options.seed + number
            number += 1

    def run(self, tell):
        """Try all; tell: called with each Result and the lines about it."""
        for seed in self.seeds():
            plan = draw(seed, self._names)
            try:
                judgement, record = self.attempt(plan)
            except trial.LateError:
                self.not_judged += 1
                continue
            except FAILURES as error:
                self.not_judged += 1
                print(f"faults: seed {seed} could not be tried: {error}", file=sys.stderr)
                self._leave()
                continue
            letters = tuple(sorted({v.invariant for v in judgement.violations}))
            kinds = tuple(fault.kind for fault in plan.faults)
            self.results.append(Result(seed, kinds, judgement.rest_s, letters))
            lines = []
            if letters:
                lines = violation_lines(plan, judgement, record, self._again(seed))
                lines += self._last_words
                if self._options.shrink:
                    fewest = shrink(plan, self._breaks)
                    lines.append(f"  fewest faults that still do it: {in_words(fewest)}")
            tell(self.results[-1], lines)

    def attempt(self, plan):
        """Try one Plan: (judge.Judgement, judge.Record). A world that went deaf is made anew."""
        world = self.world(plan.simulated)
        judgement, record = trial.run(world, plan)
        self._last_words = [
            f"  {node}: {line}"
            for node, words in world.last_words().items()
            for line in words.splitlines()[-3:]
        ]
        if any(violation.invariant == "h" for violation in record.told):
            self._leave()
        return judgement, record

    def _breaks(self, plan):
        """Whether a Plan breaks an invariant, as far as it can be told."""
        try:
            return bool(self.attempt(plan)[0].violations)
        except (trial.LateError, *FAILURES):
            return False

    def _again(self, seed):
        options = self._options
        kinds = f" --kinds {' '.join(options.kinds)}" if options.kinds else ""
        node = f" --node {options.node}" if self._node else ""
        return f"./tutorial faults --seed {seed} --trials 1{node}{kinds}"
