#!/usr/bin/python3
"""Run tests: ./tutorial test [KIND|PACKAGE] [ARGUMENT ...], in the environment of the workspace.

Failed tests are in pytest's caches: one for each kind, and one for a plain ./tutorial test.
"""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent
CACHES = Path(os.environ["TUTORIAL_RESULTS"]) / "pytest"
PYTEST = ["/usr/bin/python3", "-m", "pytest"]
JOBS = int(os.environ.get("TUTORIAL_JOBS", "2"))  # tests at a time
NUMBER_OF_INTERRUPT = 130
TOGETHER = "launch ros system"  # they mostly wait, so they run together
ALL = "all"  # the cache of ./tutorial test
BRIDGE = "--bridge"  # option of the faults
MUTATE = CACHES.parent / "mutation/bin/python"  # at the lowest priority, because it takes hours
BY_GROUP = ("--dist", "loadgroup")


def interrupt(number, _):
    raise KeyboardInterrupt(number)


def run(*command):
    """Run a command in the repository; return its exit code. Ctrl-C also reaches the command."""
    process = subprocess.Popen(list(map(str, command)), cwd=TESTS.parent)
    try:
        return process.wait()
    except KeyboardInterrupt as error:
        if error.args == (signal.SIGTERM,):  # only this process receives it
            process.send_signal(signal.SIGINT)
        process.wait()
        raise


def folders(kinds, package="*"):
    """Return the folders of these kinds of tests, of one package or all."""
    paths = [path for kind in kinds.split() for path in sorted(TESTS.glob(f"{package}/{kind}"))]
    return [path.relative_to(TESTS.parent) for path in paths]


def within(argument, kinds):
    """Return the folders of some kinds in a folder such as test/gamepad, or else the argument."""
    folder = Path(argument)
    return folders(kinds, folder.name) if folder.parent == Path("test") else [argument]


def tests(kinds, given, *options, package="*", cache=""):
    """Run pytest on the folders of these kinds, or on given paths; its cache notes what fails."""
    given = [path for argument in given for path in within(argument, kinds)]
    is_named = any(Path(argument).parts[:1] == ("test",) for argument in given)
    where = [] if is_named else folders(kinds, package)
    noted = ["-o", f"cache_dir={CACHES / (cache or kinds)}"]
    return run(*PYTEST, "-p", "no:benchmark", *noted, *options, *where, *given)


def run_all(_):
    """Run the unit tests, then the others together."""
    shutil.rmtree(CACHES / ALL, ignore_errors=True)  # a killed run may have left one
    options = os.environ.get("TUTORIAL_UNIT", f"-n {JOBS}").split()  # .ci/run sets it
    failed = tests("unit", options, cache=ALL)
    return tests(TOGETHER, [], "-n", 5 * JOBS, *BY_GROUP, cache=ALL) or failed


def again(given):
    """Run what failed once more, one by one, with less load."""
    if not (CACHES / ALL).exists():
        sys.exit("tutorial: test again: first run ./tutorial test to its end")
    # Distributed as before, so that tests of a group keep their names and nothing else runs.
    only = ["--last-failed", "--last-failed-no-failures", "none", "-n", "1", *BY_GROUP]
    return tests(f"unit {TOGETHER}", given, *only, cache=ALL)


def quick(package, given):
    """Run the quick tests of a package."""
    options = ["-n", 2 * JOBS, *BY_GROUP, "-m", "not night and not long"]
    return tests(f"unit {TOGETHER}", given, *options, package=package, cache=package)


def faults(arguments):
    """Cause random faults in the live system; with --bridge, in the bridge to ROS 2."""
    if BRIDGE not in arguments:
        return run("/usr/bin/python3", "-m", "tutorial_faults.live.hunt", *arguments)
    rest = [argument for argument in arguments if argument != BRIDGE]
    file = "test/ros2_bridge/ros2/test_faults.py"
    return tests("ros2", ["-q", "-s", file, "-k", "random", *rest])


KINDS = {
    "": run_all,
    # Several at a time; with arguments one by one, so that -s shows their output.
    "unit": lambda given: tests("unit", given or ["-n", str(JOBS)]),
    "launch": lambda given: tests("launch", given, "-n", JOBS),
    # More at a time, because they mostly wait.
    "ros": lambda given: tests("ros", given, "-n", 2 * JOBS),
    "exercises": lambda given: tests("exercises", given, "-n", 4 * JOBS),
    "system": lambda given: tests("system", given, "-n", JOBS + 2, *BY_GROUP),
    "again": again,
    "kernel": lambda given: tests("kernel", given),
    "ros2": lambda given: tests("ros2", given),
    "browser": lambda given: tests("browser", given, "-n", JOBS, "--dist", "loadfile"),
    "containers": lambda given: run(TESTS / "check_containers", *given),
    "faults": faults,
    "mutation": lambda given: run("nice", "-n", "19", MUTATE, "test/suite/mutation/run.py", *given),
    "bench": lambda given: run(*PYTEST, "-qs", *folders("benchmark", *given[:1]), *given[1:]),
}


def main():
    """Run one kind, or all; exit code 1 if a test failed."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupt)
    os.environ["PYTHONPATH"] = f"{TESTS}/support:{os.environ.get('PYTHONPATH', '')}"
    what, *arguments = sys.argv[1:] or [""]
    try:
        code = KINDS[what](arguments) if what in KINDS else quick(what, arguments)
    except KeyboardInterrupt:
        shutil.rmtree(CACHES / ALL, ignore_errors=True)  # it does not know what failed
        print("tutorial: test: interrupted", file=sys.stderr)
        sys.exit(NUMBER_OF_INTERRUPT)
    if code and what not in ("again", "faults", "bench"):
        sys.exit(f"tutorial: failed: {what or 'see above, or ./tutorial test again'}")
    sys.exit(code)


if __name__ == "__main__":
    main()
