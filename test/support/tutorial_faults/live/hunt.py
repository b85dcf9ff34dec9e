"""./tutorial test faults: hit the live system with random faults, and report its reactions."""

import contextlib
import itertools
import logging
import math
import os
import random
import shlex
import signal
import sys
import tempfile
import time
from typing import NamedTuple

from node_kit.parameters.arguments import Parser, above_zero
from tutorial_faults.live.judge import VELOCITIES, Trial
from tutorial_faults.live.table import FAULTS
from tutorial_faults.live.world import SerialWorld, World
from tutorial_faults.worlds import moves
from tutorial_testing.hands import DRIVE, RELEASED, STICK, TURBO, TURN
from tutorial_testing.processes import free_port

# The value of --node for the handout's own class, as printed there.
HANDOUT = "handout"
LITERAL = "test/tutorial_check/exercises/literal/joy2twist/scripts/new_joy2twist.py"
SHORTEST_S = 60.0  # without --for and --trials
WATCHED_S = 1.8  # after the last act of a trial: a restarted node needs a second
ATTEMPTS = 4  # at a trial for which this machine was late
CANNOT = 2  # exit code


class Plan(NamedTuple):
    """A trial; times [s] count from when the hands have made the robot move."""

    seed: int
    hands: list  # (time, what they show from then on)
    hits: list  # (time, end, name of a Fault)
    ends_s: float


def draw(seed, names):
    """Return the Plan of a seed, with faults of these names; always the same Plan.

    The hands mostly hold on; some release, and some of these hold again.
    """
    dice = random.Random(seed)
    hands, hits, at_s = [(0.0, DRIVE)], [], dice.uniform(0.05, 0.3)
    chosen = dice.choices(names, k=dice.choice((1, 2)))
    if len({FAULTS[name].part for name in chosen}) < len(chosen):
        chosen.pop()  # two faults of one part would disturb each other
    for name in chosen:
        hits.append((at_s, at_s + dice.uniform(*FAULTS[name].lasts_s), name))
        at_s += dice.uniform(0.0, 0.6)
    if dice.random() < 0.3:
        hands.append((dice.uniform(0.1, 0.6), dice.choice((TURN, TURBO))))
    if dice.random() < 0.4:
        hands.append((dice.uniform(0.65, 1.6), dice.choice((RELEASED, STICK))))
        if dice.random() < 0.4:
            hands.append((hands[-1][0] + dice.uniform(0.3, 0.7), RELEASED))
            hands.append((hands[-1][0] + dice.uniform(0.3, 0.7), DRIVE))
    return Plan(seed, hands, hits, max(hands[-1][0], *(hit[1] for hit in hits)) + WATCHED_S)


def parse(arguments):
    parser = Parser(prog="./tutorial test faults", description="Hit the live system with faults.")
    add, ends = parser.add_argument, parser.add_mutually_exclusive_group()
    ends.add_argument("--for", type=above_zero, metavar="SECONDS", dest="seconds", help="(60)")
    ends.add_argument("--trials", type=int, default=0, metavar="N", help="so many trials")
    add("--seed", type=int, default=1, help="of the first trial (1); the next one has the next")
    names = sorted({*FAULTS, *(fault.family for fault in FAULTS.values())})
    add("--kinds", choices=names, nargs="+", metavar="KIND", help=", ".join(FAULTS))
    text = "a Kobuki's driver and a robot on a serial line, in place of the simulated base"
    add("--serial", action="store_true", help=text)
    text = f"a command in place of joy2twist; {HANDOUT}: the handout's own class"
    add("--node", type=shlex.split, default=[], metavar="COMMAND", help=text)
    options = parser.parse_args(arguments)
    if options.kinds and not named(options):
        parser.error("these --kinds need --serial: there is no line without it")
    return options


def named(options):
    """Return the names of the wanted faults that can hit this system."""
    wanted = {*(options.kinds or FAULTS)}
    return [
        name
        for name, fault in FAULTS.items()
        if {name, fault.family} & wanted and (options.serial or not fault.of_line)
    ]


def tried(world, plan):
    """Return the judge.Trial of a Plan. Raises TimeoutError."""
    for _ in range(ATTEMPTS):
        trial = Trial(world.act(plan), world.sees_truth)
        if not trial.violations or not trial.was_late:
            return trial
    raise TimeoutError("this machine was too late")


def show(options, plan, trial):
    """Print a trial that violates an invariant: its events, and how to repeat it."""
    print(f"VIOLATION, seed {plan.seed}: {' + '.join(name for *_, name in plan.hits)}")
    begin, last = trial.events[0].at_s, {}
    for letter, at_s, what in trial.violations:
        print(f"  ({letter}) {what}, at {at_s - begin:.3f} s")
    for at_s, what, value in trial.events:
        is_velocity = what in VELOCITIES
        changed = moves(value) if is_velocity else value
        if last.get(what) != changed:
            shown = [round(part, 2) for part in value if part] if is_velocity else value
            print(f"  {at_s - begin:8.3f} s  {what} {shown or 'rest'}")
        last[what] = changed
    again = ["--seed", str(plan.seed), "--trials", "1"]
    again += ["--node", shlex.join(options.node)] if options.node else []
    again += ["--serial"] if options.serial else []
    again += ["--kinds", *options.kinds] if options.kinds else []
    print(f"  again: ./tutorial test faults {shlex.join(again)}", flush=True)


def hunt(options):
    """Yield Trials; a world that cannot be repaired is replaced."""
    names = named(options)
    node = [LITERAL] if options.node == [HANDOUT] else options.node
    end_s = time.monotonic() + (math.inf if options.trials else options.seconds or SHORTEST_S)
    world, kind = None, SerialWorld if options.serial else World
    with contextlib.ExitStack() as stack:
        for seed in itertools.islice(itertools.count(options.seed), options.trials or None):
            if time.monotonic() > end_s:
                return
            plan = draw(seed, names)
            try:
                world = world or stack.enter_context(kind(node))
                trial = tried(world, plan)
                yield trial
            except (AssertionError, OSError) as error:
                print(f"faults: seed {seed} could not be tried: {error}", file=sys.stderr)
                world = stack.close()
                continue
            if trial.violations:
                show(options, plan, trial)
            if world.is_deaf:
                world = stack.close()


def main():
    """Run the hunt; return 1 if an invariant was violated, 2 if no trial was possible."""
    options = parse(sys.argv[1:])
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    logging.disable(logging.CRITICAL)  # this process reports what it ended itself
    trials = []
    with tempfile.TemporaryDirectory() as home:
        os.environ.update(ROS_HOME=home, ROS_MASTER_URI=f"http://localhost:{free_port()}")
        with contextlib.suppress(KeyboardInterrupt):
            for trial in hunt(options):
                trials.append(trial)
    hits, violations = (sum(len(t.hits) for t in trials), sum(bool(t.violations) for t in trials))
    worst_s = max((trial.rest_s for trial in trials), default=0.0)
    counts = f"{len(trials)} trials, {hits} faults, {violations} violations"
    print(f"{counts}, worst time to rest {worst_s:.2f} s")
    return int(violations > 0) if trials else CANNOT


if __name__ == "__main__":
    sys.exit(main())
