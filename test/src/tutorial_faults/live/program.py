"""./tutorial faults: hit the live system with random faults, and say what it did."""

import argparse
import contextlib
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

from tutorial_faults.live import hosts, trial
from tutorial_faults.live.fuzz import fuzz
from tutorial_faults.live.kinds import KINDS, chosen
from tutorial_faults.live.plan import draw, in_words
from tutorial_faults.live.report import violation_lines
from tutorial_faults.live.shrink import shrink
from tutorial_faults.live.soak import soak
from tutorial_faults.live.table import Result, by_invariant, by_kind, last_line, write
from tutorial_faults.live.world import World

NAME = "faults"
LITERAL = Path(__file__).resolve().parents[3] / "exercises/literal/joy2twist/scripts"
# The handout's own class, as printed there, by the name under which --node knows it.
HANDOUT = "handout"
FIRST_SEED = 1


def parse(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="./tutorial faults", description="Hit the live system with random faults."
    )
    how_long = parser.add_mutually_exclusive_group()
    how_long.add_argument(
        "--for", type=float, metavar="SECONDS", dest="seconds", help="so long (60)"
    )
    how_long.add_argument("--trials", type=int, metavar="N", help="so many trials")
    parser.add_argument("--seed", type=int, default=FIRST_SEED, help="of the first trial (1)")
    parser.add_argument("--kinds", nargs="+", default=[], metavar="KIND", help="these faults alone")
    parser.add_argument(
        "--shrink", action="store_true", help="look for the fewest faults that do it"
    )
    parser.add_argument(
        "--node", metavar="PACKAGE/TYPE", help=f"in place of joy2twist; or {HANDOUT}"
    )
    parser.add_argument(
        "--table", metavar="FILE", help="write each trial to FILE, and print a table"
    )
    parser.add_argument("--fuzz", type=int, metavar="N", help="N random messages and device bytes")
    parser.add_argument("--soak", type=float, metavar="HOURS", help="so long without faults")
    parser.add_argument("--picture", metavar="FILE", default="soak.png", help="of the soak")
    return parser.parse_args(arguments)


def command_of_node(word):
    """The command line of --node. Raises ValueError."""
    if word is None:
        return ()
    if word == HANDOUT:
        return (str(LITERAL / "new_joy2twist.py"),)
    if word.count("/") != 1:
        raise ValueError(f"--node {word}: must be PACKAGE/TYPE, such as joy2twist/joy2twist.py")
    return ("rosrun", *word.split("/"))


class Hunt:
    """The trials, one after the other, on a world that is made anew when a trial needs another."""

    def __init__(self, the_hosts, folder, options):
        """options: of parse()."""
        self._hosts, self._folder, self._options = the_hosts, folder, options
        self._node = command_of_node(options.node)
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
        seconds = options.seconds or (0.0 if options.trials else 60.0)
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
            except (AssertionError, TimeoutError, OSError) as error:  # of the hunt itself
                self.not_judged += 1
                print(f"{NAME}: seed {seed} could not be tried: {error}", file=sys.stderr)
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
                    fewest = shrink(plan, lambda p: bool(self.attempt(p)[0].violations))
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

    def _again(self, seed):
        options = self._options
        kinds = f" --kinds {' '.join(options.kinds)}" if options.kinds else ""
        node = f" --node {options.node}" if options.node else ""
        return f"./tutorial faults --seed {seed} --trials 1{node}{kinds}"


def hunt(options):
    """Run the trials; the exit code."""
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        home = os.path.join(folder, "home")
        os.mkdir(home)
        table = stack.enter_context(open(options.table, "w", 1)) if options.table else None
        the_hosts = stack.enter_context(hosts.Hosts(home, options.seed))
        os.environ.update(the_hosts.robot_environment)
        for need, why in the_hosts.refused.items():
            kinds = ", ".join(kind.name for kind in KINDS.values() if kind.needs == need)
            print(f"{NAME}: without {kinds}: {why}", flush=True)
        the_hunt = stack.enter_context(Hunt(the_hosts, folder, options))
        if table:
            write(table, [])

        def tell(result, lines):
            for line in lines:
                print(line, flush=True)
            if table:
                write(table, [result], header=False)
            progress = f"\r{len(the_hunt.results)} trials, seed {result.seed} "
            if sys.stderr.isatty():
                print(progress, end="", file=sys.stderr, flush=True)

        with contextlib.suppress(KeyboardInterrupt):
            the_hunt.run(tell)
            the_hunt.end()
    results = the_hunt.results
    if options.table or options.node:
        print("\n".join(by_kind(results)))
    if options.node:
        whose = "the handout's own class" if options.node == HANDOUT else options.node
        counts = ", ".join(f"({k}) {n}" for k, n in by_invariant(results).items()) or "none"
        print(f"{whose}: trials that violate an invariant, of {len(results)}: {counts}")
    if the_hunt.not_judged:
        print(f"{the_hunt.not_judged} trials not judged: this machine was too late or failed")
    print(last_line(results))
    return int(any(result.violations for result in results))


def main(arguments=None):
    """Run until done; exit code 1 if an invariant was violated, 2 if this cannot work."""
    arguments = sys.argv[1:] if arguments is None else arguments
    options = parse(arguments)
    try:
        command_of_node(options.node)
        chosen(options.kinds, ())
    except ValueError as error:
        print(f"{NAME}: {error}", file=sys.stderr)
        return 2
    hosts.move_in(arguments)
    # As the first process of a namespace this is spared every signal that it does not ask for.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if options.fuzz:
        return fuzz(options.fuzz, options.seed)
    if options.soak:
        return soak(options.soak, options.picture)
    return hunt(options)
