"""Faults and mutations on a Dask cluster: each part is a ./tutorial test where a worker is."""

import argparse
import importlib.util
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

TRIALS = 10  # of a part: the start of a system takes as long as some trials
MUTATION = Path(__file__).resolve().parents[2] / "mutation" / "run.py"


def parts_of_faults(arguments):
    """Return the arguments of each part of so many trials."""
    parser = argparse.ArgumentParser(prog="./tutorial test faults", allow_abbrev=False)
    parser.add_argument("--trials", type=int, required=True, metavar="N", help="with --cluster")
    parser.add_argument("--seed", type=int, default=1)
    options, others = parser.parse_known_args(arguments)
    end = options.seed + options.trials
    return [
        ["--trials", str(min(TRIALS, end - seed)), "--seed", str(seed), *others]
        for seed in range(options.seed, end, TRIALS)
    ]


def parts_of_mutation(arguments):
    """Return the arguments of each part: a module."""
    spec = importlib.util.spec_from_file_location("mutation", MUTATION)
    mutation = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(mutation)
    return [[name] for name in arguments or mutation.modules()]


def tutorial(words):
    """Return (exit code, output) of ./tutorial on this machine."""
    import subprocess  # noqa: PLC0415  where it runs, this module is not

    from tutorial_check.examination import SUITE  # noqa: PLC0415

    command = [str(SUITE / "tutorial"), *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout.decode(errors="replace")


tutorial.__module__ = "__main__"  # sent as it is: a worker has no modules of tests


PARTS = {"faults": parts_of_faults, "mutation": parts_of_mutation}


def run_in_parts(kind, arguments):
    """Run a kind of tests on the workers of --cluster ADDRESS; return the worst exit code."""
    from tutorial_check.cluster import MOST_AT_ONCE, Cluster  # noqa: PLC0415
    from tutorial_check.model import CannotCheck  # noqa: PLC0415

    parser = argparse.ArgumentParser(prog=f"./tutorial test {kind}", allow_abbrev=False)
    parser.add_argument("--cluster", required=True, metavar="ADDRESS")
    options, others = parser.parse_known_args(arguments)
    parts = PARTS[kind](others)
    worst = 0
    try:
        cluster = Cluster(options.cluster)
        with ThreadPoolExecutor(min(MOST_AT_ONCE, len(parts))) as pool:
            calls = {
                pool.submit(cluster.call, tutorial, ["test", kind, *part]): part for part in parts
            }
            for done, call in enumerate(as_completed(calls), 1):
                code, output = call.result()
                worst = max(worst, code)
                words = " ".join(calls[call])
                print(f"{output}part {done} of {len(parts)}: {words}: exit code {code}", flush=True)
    except CannotCheck as error:
        print(f"tutorial: {kind}: {error}", file=sys.stderr)
        return 2
    return worst
