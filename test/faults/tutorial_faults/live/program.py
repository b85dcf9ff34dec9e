"""./tutorial faults: hit the live system with random faults, and say what it did."""

import argparse
import contextlib
import os
import shlex
import signal
import sys
import tempfile
from pathlib import Path

from node_kit.arguments import above_zero
from tutorial_faults.live import hosts
from tutorial_faults.live.fuzz import fuzz
from tutorial_faults.live.hunting import Hunt
from tutorial_faults.live.kinds import KINDS, chosen
from tutorial_faults.live.soak import soak
from tutorial_faults.live.table import beside, by_kind, last_line, write

NAME = "faults"
LITERAL = Path(__file__).resolve().parents[3] / "exercises/literal/joy2twist/scripts"
# The handout's own class, as printed there, by the name under which --node knows it.
HANDOUT = "handout"
FIRST_SEED = 1
CANNOT = 2  # exit code


def count(text):
    """How many; the type of --trials and --fuzz. Raises what argparse tells the user."""
    try:
        number = int(text)
    except ValueError:
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: not a whole number above 0, such as 100")
    return number


def parse(arguments):
    """The command line; seed: None if it has none."""
    parser = argparse.ArgumentParser(
        prog="./tutorial faults", description="Hit the live system with random faults."
    )
    how_long = parser.add_mutually_exclusive_group()
    how_long.add_argument(
        "--for", type=above_zero, metavar="SECONDS", dest="seconds", help="so long (60)"
    )
    how_long.add_argument("--trials", type=count, metavar="N", help="so many trials")
    parser.add_argument("--seed", type=int, help=f"of the first trial ({FIRST_SEED})")
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
    how_long.add_argument(
        "--fuzz", type=count, metavar="N", help="N random messages and device bytes"
    )
    how_long.add_argument("--soak", type=above_zero, metavar="HOURS", help="so long without faults")
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


def check_writable(path):
    """Raise ValueError if a file cannot be written; what stands in it stays."""
    try:
        with open(path, "a"):
            pass
    except OSError as error:
        raise ValueError(f"{path}: cannot be written: {error.strerror}") from error


def hunt(options):
    """Run the trials; the exit code."""
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        home = os.path.join(folder, "home")
        os.mkdir(home)
        the_hosts = stack.enter_context(hosts.Hosts(home, options.seed))
        os.environ.update(the_hosts.robot_environment)
        for need, why in the_hosts.refused.items():
            kinds = ", ".join(kind.name for kind in KINDS.values() if kind.needs == need)
            print(f"{NAME}: without {kinds}: {why}", flush=True)
        table = stack.enter_context(open(options.table, "w", 1)) if options.table else None
        results = run(Hunt(the_hosts, folder, options, command_of_node(options.node)), table)
        if options.node:
            # Ours, with the same seeds.
            options.seconds, options.trials = None, len(results) or 1
            ours = run(Hunt(the_hosts, folder, options), None)
            whose = "the handout's own class" if options.node == HANDOUT else options.node
            print("\n".join(beside({whose: results, "ours": ours})))
    if options.table:
        print("\n".join(by_kind(results)))
    print(last_line(results))
    return int(any(result.violations for result in results)) if results else CANNOT


def run(the_hunt, table):
    """Run a hunting.Hunt until its end or Ctrl-C: its results. table: an open file, or None."""
    if table:
        write(table, [])

    def tell(result, lines):
        for line in lines:
            print(line, flush=True)
        if table:
            write(table, [result], header=False)
        if sys.stderr.isatty():
            progress = f"\r{len(the_hunt.results)} trials, seed {result.seed} "
            print(progress, end="", file=sys.stderr, flush=True)

    with the_hunt, contextlib.suppress(KeyboardInterrupt):
        the_hunt.run(tell)
        the_hunt.end()
    if the_hunt.not_judged:
        print(f"{the_hunt.not_judged} trials not judged: this machine was too late or failed")
    return the_hunt.results


def main(arguments=None):
    """Run until done; exit code 1 if an invariant was violated, 2 if this cannot work."""
    arguments = sys.argv[1:] if arguments is None else arguments
    options = parse(arguments)
    try:
        command_of_node(options.node)
        chosen(options.kinds, ())
        file = options.picture if options.soak else options.table
        if file and not options.fuzz:
            check_writable(file)
    except ValueError as error:
        print(f"{NAME}: {error}", file=sys.stderr)
        return CANNOT
    hosts.move_in(arguments)
    # As the first process of a namespace this is spared every signal that it does not ask for.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if options.soak:
        return soak(options.soak, options.picture)
    if options.seed is None:
        options.seed = FIRST_SEED
        again = shlex.join(["./tutorial", NAME, *arguments, "--seed", str(FIRST_SEED)])
        print(f"{NAME}: seed {FIRST_SEED}; the same again: {again}", flush=True)
    if options.fuzz:
        return fuzz(options.fuzz, options.seed)
    return hunt(options)
