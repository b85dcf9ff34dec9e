#!/usr/bin/python3
"""Run tests: ./tutorial test [KIND] [ARGUMENT ...] in the environment of the suite's workspace.

The file `failed` in $TUTORIAL_RESULTS has the kinds that failed, for `test again`. It is removed at
the start, so that after an interruption nothing is known to have failed.
"""

import os
import signal
import subprocess
import sys
from pathlib import Path

from node_kit.arguments import Parser

REPOSITORY = Path(__file__).resolve().parents[1]
RESULTS = Path(os.environ["TUTORIAL_RESULTS"])
PYTEST = ["/usr/bin/python3", "-m", "pytest"]
QUIET = [*PYTEST, "-p", "no:benchmark"]  # several at a time, of which a benchmark would complain
JOBS = int(os.environ.get("TUTORIAL_JOBS", "2"))  # tests at a time
NUMBER_OF_INTERRUPT = 130
TOGETHER = ("ros", "system", "launch")  # of all; they mostly wait, so they run at the same time
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
RUNNING = []  # in the background
PART = "TUTORIAL_PART"  # environment variable: this is one kind of all, which another one sums up
BRIDGE = "--bridge"  # of the faults
KERNEL = "test/system/test_kernel_joystick.py"


def say(line):
    """Report to the user."""
    print(f"tutorial: {line}", file=sys.stderr, flush=True)


def interrupt(number, _):
    """Handle a signal of ENDING."""
    raise KeyboardInterrupt(number)


def run(*command):
    """Run a command in the repository; return its exit code. Ctrl-C reaches it, too."""
    process = subprocess.Popen(list(map(str, command)), cwd=REPOSITORY)
    try:
        return process.wait()
    except KeyboardInterrupt as error:
        if error.args == (signal.SIGTERM,):  # which arrives at this process alone
            process.send_signal(signal.SIGINT)
        process.wait()
        raise


def start(command, log):
    """Start a command in the background, in a process group of its own; return the process."""
    with log.open("w") as output:
        RUNNING.append(
            subprocess.Popen(
                command, cwd=REPOSITORY, start_new_session=True, stdin=subprocess.DEVNULL,
                stdout=output, stderr=output, env={**os.environ, PART: "yes"},
            )
        )  # fmt: skip
    return RUNNING[-1]


def end_background():
    """End what runs in the background, as Ctrl-C does."""
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
    for process in RUNNING:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
    for process in RUNNING:
        process.wait()


def with_folder(folder, arguments):
    """Return the arguments for pytest: a folder, unless they name something in it."""
    named = any(argument.startswith(folder) for argument in arguments)
    return arguments if named else [folder, *arguments]


def ros(arguments):
    """Run all rostests, or those in one folder of test/ros, or in these files, N times."""
    parser = Parser(prog="./tutorial test ros")
    parser.add_argument("--times", type=int, default=1, metavar="N", help="repeat each")
    parser.add_argument("tests", nargs="*", metavar="FOLDER_OR_FILE")
    options = parser.parse_args(arguments)
    folder, tests = REPOSITORY / "test" / "ros", list(map(Path, options.tests))
    if not tests:
        # Those that wait the longest first, so that none is left to run alone.
        tests = sorted(folder.glob("*/*.test"), key=lambda test: test.parent.name != "faults")
    elif len(tests) == 1 and (folder / tests[0]).is_dir():
        tests = sorted((folder / tests[0]).glob("*.test"))
    for test in tests:
        if not test.is_file():
            parser.error(f'"{test}" is no folder of test/ros, and no file of a rostest')
    tests = [test.resolve() for test in tests * options.times]
    # They wait more than they work.
    return run(REPOSITORY / "test/run_rostests", 2 * JOBS, RESULTS / "rostests", *tests)


def system(arguments, jobs=JOBS):
    """Run the system tests, a file of them at a time; pytest notes what fails."""
    several = ["-n", jobs, "--dist", "loadfile", f"--ignore={KERNEL}"]
    several += ["-o", f"cache_dir={RESULTS}/system_cache"]  # which no other kind writes into
    status = run(*QUIET, *several, *with_folder("test/system", arguments))
    if status < 0 or status in (3, 4):
        say(f"pytest itself ended early (exit code {status}), so other tests may not have run")
    return abs(status)


def again(_):
    """Run what failed once more, with little else beside it; no unit test goes by the clock."""
    if not (RESULTS / "failed").exists():
        todo = "./tutorial test must run to its end first"
        sys.exit(f"tutorial: test again: it is not known what failed: {todo}")
    status = 0
    for kind in (RESULTS / "failed").read_text().split():
        failed = RESULTS / "rostests/failed"
        if kind == "system":
            status |= bool(system(["--last-failed", "--last-failed-no-failures=all"], 1))
        elif kind == "ros" and failed.exists():
            tests = sorted(set(failed.read_text().splitlines()))
            status |= run(REPOSITORY / "test/run_rostests", 1, RESULTS / "rostests", *tests)
        else:
            say(f"tests: {kind}: no single ones to run again; next: ./tutorial test {kind}")
            status = 1
    return status


def bench(arguments):
    """Run the benchmarks of all packages, or of one."""
    package, *rest = arguments or [""]
    return run(*PYTEST, "-q", "-s", f"test/benchmark/{package}", *rest)


def faults(arguments):
    """Hit the live system with random faults; with --bridge the one between ROS 1 and ROS 2."""
    if BRIDGE not in arguments:
        return run("/usr/bin/python3", "-m", "tutorial_faults", *arguments)
    rest = [argument for argument in arguments if argument != BRIDGE]
    return run(*QUIET, "-q", "-s", "test/ros2/test_faults.py", *rest)


def mutation(arguments):
    """Run with the lowest priority, as it takes hours."""
    python = RESULTS / "mutation/bin/python"
    return run("nice", "-n", "19", python, "test/mutation/run.py", *arguments)


KINDS = {
    # Several at a time; with arguments in turn, so that -s shows what they print.
    "unit": lambda given: run(*PYTEST, *with_folder("test/unit", given or ["-n", str(JOBS)])),
    "launch": lambda given: run(*QUIET, "-n", JOBS, *with_folder("test/launch", given)),
    "ros": ros,
    # pytest forgets what failed before, so that it knows of nothing if it is killed.
    "system": lambda given: system(["--cache-clear", *given]),
    "again": again,
    "kernel": lambda given: run(*PYTEST, KERNEL, *given),
    # Four times as many at a time: they wait more than they work.
    "exercises": lambda given: run(*QUIET, "-n", 4 * JOBS, "test/exercises", *given),
    "ros2": lambda given: run(*QUIET, *with_folder("test/ros2", given)),
    "browser": lambda given: run(*QUIET, *with_folder("test/browser", given)),
    "containers": lambda given: run(REPOSITORY / "test/check_containers", *given),
    "faults": faults,
    "mutation": mutation,
    "bench": bench,
}


def run_all():
    """Run unit tests, then the others at once; return the kinds that failed."""
    say("tests: unit")
    failed = ["unit"] if KINDS["unit"]([]) else []
    logs = [RESULTS / f"test_{kind}.log" for kind in TOGETHER]
    processes = [start([__file__, kind], log) for kind, log in zip(TOGETHER, logs)]
    say("tests: ros, system and launch at once, for some minutes; till then see")
    say(f"   {RESULTS}/test_*.log")
    for kind, log, process in zip(TOGETHER, logs, processes):
        failed += [kind] if process.wait() else []
        say(f"tests: {kind}")
        sys.stdout.write(log.read_text(errors="replace"))
        sys.stdout.flush()
    return failed


def main():
    """Run one kind, or all; exit code 1 if a test failed."""
    for number in ENDING:
        signal.signal(number, interrupt)
    folders = [str(REPOSITORY / "test" / name) for name in ("src", "faults")]
    os.environ["PYTHONPATH"] = ":".join([*folders, os.environ.get("PYTHONPATH", "")])
    kind, *arguments = sys.argv[1:] or [""]
    is_part = os.environ.pop(PART, "")  # the tests of ./tutorial test run others, which are whole
    noted = RESULTS / "failed"
    try:
        if any(argument.split("=")[0] == "--cluster" for argument in arguments):
            from tutorial_testing.in_parts import run_in_parts  # noqa: PLC0415

            sys.exit(run_in_parts(kind, arguments))
        if kind in ("again", "faults", "bench") or is_part:
            sys.exit(KINDS[kind](arguments))
        noted.unlink(missing_ok=True)
        failed = run_all() if not kind else [kind] if KINDS[kind](arguments) else []
    except KeyboardInterrupt:
        end_background()
        say("test: interrupted")
        sys.exit(NUMBER_OF_INTERRUPT)
    noted.write_text("".join(f"{kind}\n" for kind in failed))
    if {"ros", "system"} & set(failed):
        say("next, for ros and system: ./tutorial test again")
    if failed:
        sys.exit(f"tutorial: failed: {' '.join(failed)}")


if __name__ == "__main__":
    main()
