"""./tutorial test faults: hit the live system with random faults, and report what it did."""

import argparse
import contextlib
import csv
import os
import shlex
import signal
import sys
import tempfile
from pathlib import Path

from node_kit.arguments import Parser, above_zero
from tutorial_faults.live import hosts
from tutorial_faults.live.hunting import Hunt
from tutorial_faults.live.kinds import KINDS
from tutorial_faults.live.report import by_kind, last_line
from tutorial_faults.live.soak import soak

# The handout's own class, as printed there, by the name under which --node knows it.
HANDOUT, LITERAL = "handout", "exercises/literal/joy2twist/scripts/new_joy2twist.py"
FIRST_SEED = 1
CANNOT = 2  # exit code


def count(text):
    """Return how many. Raises argparse.ArgumentTypeError."""
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}: not a whole number above 0, such as 100")
    return int(text)


def node(text):
    """Return the name of a node. Raises argparse.ArgumentTypeError."""
    if text != HANDOUT and text.count("/") != 1:
        raise argparse.ArgumentTypeError(f"{text}: not PACKAGE/TYPE, such as gamepad/joy_node")
    return text


def kind(text):
    """Return the name of a kind, or of a family. Raises argparse.ArgumentTypeError."""
    families = sorted({one.family for one in KINDS.values()})
    if text not in KINDS and text not in families:
        there_are = f"there are {', '.join(families)}"
        raise argparse.ArgumentTypeError(f"{text}: is no kind of fault; {there_are}")
    return text


def parse(arguments):
    """Return the options; seed: None if there is none."""
    description = "Hit the live system with random faults."
    parser = Parser(prog="./tutorial test faults", description=description)
    add = parser.add_argument
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--for", type=above_zero, metavar="SECONDS", dest="seconds", help="(60)")
    what.add_argument("--trials", type=count, metavar="N", help="so many trials")
    what.add_argument("--soak", type=above_zero, metavar="HOURS", help="without faults: what grows")
    add("--seed", type=int, help=f"of the first trial ({FIRST_SEED})")
    add("--kinds", type=kind, nargs="+", default=[], metavar="KIND", help="these faults alone")
    add("--node", type=node, metavar="PACKAGE/TYPE", help=f"in place of joy2twist; or {HANDOUT}")
    add(
        "--in-a-cell", action="store_true", help="between walls and edges, with a safety controller"
    )
    file = argparse.FileType("w", 1)
    add("--table", type=file, metavar="FILE", help="write each trial to FILE; print a table")
    return parser.parse_args(arguments)


def hunt(options):
    """Run the trials; return the exit code."""
    command = ()
    if options.node:
        is_handout = options.node == HANDOUT
        literal = Path(__file__).resolve().parents[3] / LITERAL
        command = (str(literal),) if is_handout else ("rosrun", *options.node.split("/"))
    with contextlib.ExitStack() as stack:
        home = stack.enter_context(tempfile.TemporaryDirectory())
        the_hosts = stack.enter_context(hosts.Hosts(home, options.seed))
        os.environ.update(the_hosts.robot_environment)
        for need, why in the_hosts.refused.items():
            kinds = ", ".join(kind.name for kind in KINDS.values() if kind.needs == need)
            print(f"faults: without {kinds}: {why}", flush=True)
        table = csv.writer(options.table or stack.enter_context(open(os.devnull, "w")))
        table.writerow(("seed", "kinds", "rest_s", "violations"))
        the_hunt = stack.enter_context(Hunt(the_hosts, options, command))
        with contextlib.suppress(KeyboardInterrupt):
            for result, lines in the_hunt.run():
                table.writerow(result.row())
                print(*lines, sep="\n", end="\n" if lines else "", flush=True)
                if sys.stderr.isatty():
                    print(f"\rseed {result.seed} ", end="", file=sys.stderr, flush=True)
            the_hunt.end()
    results = the_hunt.results
    if the_hunt.not_judged:
        print(f"{the_hunt.not_judged} trials not judged: this machine was too late or failed")
    if options.table:
        print("\n".join(by_kind(results)))
    print(last_line(results))
    return int(any(result.violations for result in results)) if results else CANNOT


def main(arguments=None):
    """Run until done; return 1 if an invariant was violated, 2 if this cannot work."""
    arguments = sys.argv[1:] if arguments is None else arguments
    options = parse(arguments)
    hosts.move_in(arguments)
    # As the first process of a namespace this receives only signals with a handler.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if options.soak:
        return soak(options.soak, options.table)
    if options.seed is None:
        options.seed = FIRST_SEED
        again = shlex.join(["./tutorial", "test", "faults", *arguments, "--seed", str(FIRST_SEED)])
        print(f"faults: seed {FIRST_SEED}; the same again: {again}", flush=True)
    return hunt(options)
