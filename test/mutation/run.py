"""Makes small changes to the rules, one at a time, and sees whether a unit test notices each.

The changes are those of cosmic-ray (PyPI), which also makes them; but not to the file: a process of
its own, forked from one that has loaded all else, imports the changed module and runs the tests of
its package. So a change takes as long as the first test that fails, and the repository is left
alone.
"""

import argparse
import hashlib
import importlib.abc
import importlib.util
import json
import os
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import pytest
from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names
from explained import key_of, reasons
from hypothesis import Phase, settings
from modules import NOT_RUN, names, path_of, tests_of

RESULTS = Path(__file__).with_name("results.json")
# Not made, because no test could fail to notice them, or none could notice: bits of a float, and
# the identity of numbers.
NOT_MADE = ("_RShift", "_LShift", "_BitOr", "_BitAnd", "_BitXor", "_Pow", "_Is", "_IsNot")
MADE_NEVERTHELESS = ("_Is_IsNot", "_IsNot_Is")
PRELOADED = """pytest hypothesis.strategies hypothesis.stateful numpy rospy yaml rosgraph
    sensor_msgs.msg geometry_msgs.msg nav_msgs.msg diagnostic_msgs.msg std_msgs.msg tf2_msgs.msg
    visualization_msgs.msg"""
# A change after which the tests use so many times the processor time that they use without it, and
# a while, was noticed: something goes on for ever. If it waits for ever, the clock on the wall
# tells, which means little where other things run as well: so many times later.
LONGEST, A_WHILE_S, WAITS = 10.0, 10.0, 10.0
TICKS_PER_S = os.sysconf("SC_CLK_TCK")


def operators():
    """Names of cosmic-ray's changes that are made."""
    for name in operator_names():
        takes_arguments = get_operator(name).arguments()
        if takes_arguments or (name.endswith(NOT_MADE) and not name.endswith(MADE_NEVERTHELESS)):
            continue
        yield name


def changes(source):
    """All (operator, occurrence) of a module's source."""
    tree = get_ast(source)
    for name in operators():
        operator = get_operator(name)()
        count = sum(len(list(operator.mutation_positions(node))) for node in ast_nodes(tree))
        yield from ((name, occurrence) for occurrence in range(count))


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Gives one module another source when it is imported."""

    def __init__(self, module, source):
        """module: its full name."""
        self._module, self._source = module, source

    def find_spec(self, fullname, path, target=None):
        """As importlib asks."""
        if fullname != self._module:
            return None
        return importlib.util.spec_from_file_location(fullname, path_of(fullname), loader=self)

    def create_module(self, spec):
        """As usual."""
        return None

    def exec_module(self, module):
        """Run the changed source."""
        exec(compile(self._source, module.__file__, "exec"), module.__dict__)


def preload():
    """Load what all tests need, and nothing of ours: every change is spared it."""
    for name in PRELOADED.split():
        importlib.import_module(name)


def tests_pass(module, source, longest_s=600.0):
    """Whether the tests pass with a source of the module; run in a process of its own.

    longest_s: processor time, s.
    """
    pid = os.fork()
    if pid == 0:
        try:
            os._exit(_run_tests(module, source))
        finally:
            os._exit(99)
    deadline = time.monotonic() + WAITS * longest_s
    while True:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            return status == 0
        if time.monotonic() > deadline or processor_time_s(pid) > longest_s:
            os.killpg(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            return False
        time.sleep(0.005)


def processor_time_s(pid):
    """What a process and those of its children that have ended used, in s (proc(5), stat)."""
    after_name = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, after_name[11:15])) / TICKS_PER_S


def _run_tests(module, source):
    os.setpgid(0, 0)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(nowhere, descriptor)
    # A failure need not be made small here, and a slow machine is none.
    quick = {"phases": (Phase.explicit, Phase.generate), "database": None, "deadline": None}
    settings.register_profile("changes", derandomize=True, **quick)
    settings.load_profile("changes")
    sys.meta_path.insert(0, Changed(module, source))
    options = ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:benchmark"]
    options += ["-k", NOT_RUN]
    # The likeliest alone first: to load the others takes longer than to notice most changes.
    files = [str(path) for path in tests_of(module)]
    return any(pytest.main([*options, *some]) for some in (files[:1], files[1:]) if some)


def difference(before, after):
    """The lines of a source that a change touches: (was, becomes)."""
    old, new = before.splitlines(), after.splitlines()
    if len(old) != len(new):  # a decorator is gone, and perhaps the empty line before it
        at = next(i for i, (a, b) in enumerate(zip([*old, ""], [*new, ""])) if a != b)
        return next(filter(None, map(str.strip, old[at:])), ""), ""
    pairs = [(a.strip(), b.strip()) for a, b in zip(old, new) if a != b]
    return pairs[0] if pairs else ("", "")


def examine(module, only_survivors, known):
    """Try all changes of a module; the results: how many, and the survivors."""
    source = path_of(module).read_text(encoding="utf-8")
    digest = hashlib.sha256(source.encode()).hexdigest()[:16]
    begin_s = sum(os.times()[2:4])
    if not tests_pass(module, source):
        sys.exit(f"{module}: its tests fail as it is, or take too long: see ./tutorial test unit")
    longest_s = LONGEST * (sum(os.times()[2:4]) - begin_s) + A_WHILE_S
    again = None
    if only_survivors and known and known["source"] == digest:
        again = {tuple(one["change"]) for one in known["survivors"]}
    count, survivors = 0, []
    for change in changes(source):
        count += 1
        if again is not None and change not in again:
            continue
        name, occurrence = change
        changed = mutate_code(source, get_operator(name)(), occurrence)
        if changed is not None and tests_pass(module, changed, longest_s):
            was, becomes = difference(source, changed)
            survivors.append({"change": change, "was": was, "becomes": becomes})
    return {"source": digest, "changes": count, "survivors": survivors}


def report(module, found, known):
    """Print the score of a module and what has no reason; whether all is well."""
    survivors = [key_of(module, one) for one in found["survivors"]]
    open_ones = [change for change in survivors if change not in known]
    share = 100.0 * (1 - len(survivors) / found["changes"])
    counts = f"{len(survivors)} of {found['changes']} not noticed, {len(open_ones)} not explained"
    print(f"{module}: {share:.1f} %, {counts}", flush=True)
    for change in open_ones:
        print(f"    {change}", flush=True)
    return not open_ones


def main():
    """Run for the modules that are named, or for all; exit code 1 if a survivor has no reason."""
    parser = argparse.ArgumentParser(prog="./tutorial test mutation", description=__doc__)
    parser.add_argument("modules", nargs="*", metavar="MODULE", help="such as joy_to_twist.safety")
    parser.add_argument(
        "--survivors", action="store_true", help="only what was not noticed last time"
    )
    options = parser.parse_args()
    unknown = set(options.modules) - set(names())
    if unknown:
        parser.error(f"{', '.join(sorted(unknown))}: not one of {' '.join(names())}")
    preload()
    results = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    all_well = True
    for module in options.modules or names():
        results[module] = examine(module, options.survivors, results.get(module))
        RESULTS.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n")
        all_well = report(module, results[module], reasons()) and all_well
    return 0 if all_well else 1


if __name__ == "__main__":
    sys.exit(main())
