"""Make small changes to the rules, one at a time, and count those that no unit test notices.

cosmic-ray (PyPI) makes the changes in a copy of the repository. It runs the module's tests, then
the package's, then the invariants that use the package. The rules are the modules that import
neither ROS nor the operating system.
"""

import argparse
import os
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
MOST_SURVIVORS = 10  # %; a module with more fails
# These tests take longer than all others together, which must find the same changes.
NOT_RUN = "not 100_000 and not whatever_the_rate and not million"
IMPURE = re.compile(
    r"^(import|from) (os|pathlib|rospy|socket|subprocess|threading|time|\w+_msgs)\b", re.M
)
# Without plugins that run tests in parallel or again.
PYTEST = "-m pytest -x -q --hypothesis-seed=0" + "".join(
    f" -p no:{plugin}" for plugin in ("cacheprovider", "xdist", "benchmark")
)
# Changes to bits of a float, the identity of numbers and the | of a type do not concern the rules.
CONFIG = """
[cosmic-ray]
module-path = "{module}"
timeout = {timeout_s}
excluded-modules = []
test-command = "{command}"
[cosmic-ray.distributor]
name = "local"
[cosmic-ray.filters.operators-filter]
exclude-operators = [
    ".*_(RShift|LShift|BitOr|BitAnd|BitXor|Pow)$", ".*_BitOr_.*",
    ".*(?<!_Is)_IsNot$", ".*(?<!_IsNot)_Is$",
]
"""


def modules():
    """Return {name of a module: (its file, its tests)}, relative to the repository."""
    rules, invariants = {}, REPOSITORY / "test/suite/unit/test_stateful.py"
    judging = [*REPOSITORY.glob("test/support/tutorial_faults/**/*.py"), invariants]
    judges = "".join(path.read_text() for path in judging)
    for folder in sorted(REPOSITORY.glob("test/*/unit/")):
        tests = {test: test.read_text() for test in sorted(folder.glob("test_*.py"))}
        for source in sorted(REPOSITORY.glob(f"**/{folder.parent.name}/src/**/*.py")):
            name = ".".join(source.with_suffix("").parts).rpartition(".src.")[2]
            using = [test for test, text in tests.items() if f"from {name} import" in text]
            is_pure = not {"ros", "io"}.intersection(source.parts)
            if using and is_pure and not IMPURE.search(source.read_text()):
                more = [invariants] if f"from {name.split('.')[0]}." in judges else []
                tried = [str(path.relative_to(REPOSITORY)) for path in (*using, folder, *more)]
                rules[name] = (str(source.relative_to(REPOSITORY)), " ".join(tried))
    return rules


def leave_out(session, sample, seed):
    """Keep one in `sample` of the changes that were not filtered out, by a seed."""
    with sqlite3.connect(session) as database:
        order = "operator_name, occurrence, operator_args"
        wanted = "job_id NOT IN (SELECT job_id FROM work_results)"
        pending = f"SELECT job_id FROM mutation_specs WHERE {wanted} ORDER BY {order}"
        jobs = database.execute(pending).fetchall()
        random.Random(seed).shuffle(jobs)
        kept = ",".join(f"'{job}'" for (job,) in jobs[: -(-len(jobs) // sample)])
        for table in ("work_results", "mutation_specs", "work_items"):
            database.execute(f"DELETE FROM {table} WHERE job_id NOT IN ({kept})")


def examine(copy, module, source, tests, options):
    """Try the changes of a module; print the survivors; return whether they are few."""
    command = f"{sys.executable} {PYTEST} -k '{NOT_RUN}' {tests}"
    begin_s = time.monotonic()
    if subprocess.call(command, shell=True, cwd=copy, stdout=subprocess.DEVNULL):
        sys.exit(f"{module}: its tests fail as it is: see ./tutorial test unit")
    timeout_s = 10 + 4 * (time.monotonic() - begin_s)
    # cosmic-ray ends the shell alone, and would wait for a pytest that never ends.
    command = f"timeout --signal=KILL {timeout_s:.0f} {command}"
    config, session = f"{copy}/cosmic-ray.toml", f"{copy}/{module}.sqlite"
    Path(config).write_text(CONFIG.format(module=source, timeout_s=timeout_s + 10, command=command))
    tools = Path(sys.executable).parent

    def run(tool, *arguments):
        subprocess.run([tools / tool, *arguments], cwd=copy, check=True)

    run("cosmic-ray", "init", config, session)
    run("cr-filter-operators", session, config)
    leave_out(session, options.sample, options.seed)
    run("cosmic-ray", "exec", config, session)
    run("cr-report", "--surviving-only", "--show-diff", session)
    print(f"{module}: survivors [%]:", flush=True)
    return not subprocess.call([tools / "cr-rate", "--fail-over", str(MOST_SURVIVORS), session])


def main():
    """Examine the named modules, or all; return 1 if a module has too many survivors."""
    parser = argparse.ArgumentParser(prog="./tutorial test mutation", description=__doc__)
    known = modules()
    parser.add_argument("modules", nargs="*", metavar="MODULE", help=", ".join(known))
    text = "try one of N changes, drawn at random, in place of all"
    parser.add_argument("--sample", type=int, default=1, metavar="N", help=text)
    parser.add_argument("--seed", type=int, default=1, help="of that draw (1)")
    options = parser.parse_args()
    named = options.modules or list(known)
    unknown = ", ".join(name for name in named if name not in known)
    if unknown:
        parser.error(f"{unknown}: not one of {', '.join(known)}")
    if options.sample < 1:
        parser.error(f"--sample {options.sample}: not 1 or more")
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # two changes may come within one second
    with tempfile.TemporaryDirectory() as folder:
        ignored = shutil.ignore_patterns(".git")
        copy = shutil.copytree(REPOSITORY, Path(folder, "copy"), symlinks=True, ignore=ignored)
        few = [examine(copy, name, *known[name], options) for name in named]
    return 0 if all(few) else 1


if __name__ == "__main__":
    sys.exit(main())
