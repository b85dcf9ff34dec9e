"""Faults and mutations on a Dask cluster: each part is a ./tutorial test where a worker is."""

import argparse
import importlib.util
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

TRIALS = 10  # per part: a start takes as long as some trials
MUTATION = Path(__file__).resolve().parents[2] / "mutation" / "run.py"


def parts(options, others):
    """Return the arguments of each part: so many trials of faults, or a module to mutate."""
    if options.kind == "mutation":
        spec = importlib.util.spec_from_file_location("mutation", MUTATION)
        mutation = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(mutation)
        return [[name] for name in others or mutation.modules()]
    end = options.seed + options.trials
    return [
        ["--trials", str(min(TRIALS, end - seed)), "--seed", str(seed), *others]
        for seed in range(options.seed, end, TRIALS)
    ]


def tutorial(words):
    """Return (exit code, output) of ./tutorial on this machine."""
    import subprocess  # noqa: PLC0415  where it runs, this module is not

    from tutorial_check.launcher import SUITE  # noqa: PLC0415

    command = [str(SUITE / "tutorial"), *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout.decode(errors="replace")


tutorial.__module__ = "__main__"  # sent as it is: a worker has no modules of tests


def run_in_parts(kind, arguments):
    """Run a kind of tests on the workers of --cluster ADDRESS; return the worst exit code."""
    from tutorial_check.cluster import MOST_AT_ONCE, Cluster  # noqa: PLC0415
    from tutorial_check.model import CannotCheck  # noqa: PLC0415

    parser = argparse.ArgumentParser(prog=f"./tutorial test {kind}", allow_abbrev=False)
    parser.set_defaults(kind=kind)
    parser.add_argument("--cluster", required=True, metavar="ADDRESS")
    if kind == "faults":
        parser.add_argument("--trials", type=int, required=True, metavar="N", help="--cluster")
        parser.add_argument("--seed", type=int, default=1)
    options, others = parser.parse_known_args(arguments)
    worst, words = 0, {}
    try:
        cluster = Cluster(options.cluster)
        with ThreadPoolExecutor(MOST_AT_ONCE) as pool:
            for part in parts(options, others):
                words[pool.submit(cluster.call, tutorial, ["test", kind, *part])] = " ".join(part)
            for done, call in enumerate(as_completed(words), 1):
                code, output = call.result()
                worst = max(worst, code)
                said = f"part {done} of {len(words)}: {words[call]}: exit code {code}"
                print(f"{output}{said}", flush=True)
    except CannotCheck as error:
        print(f"tutorial: {kind}: {error}", file=sys.stderr)
        return 2
    return worst
