#!/usr/bin/python3
"""Run tests: ./tutorial test [KIND] [ARGUMENT ...] in the environment of the suite's workspace.

The file `failed` in $TUTORIAL_RESULTS has the kinds that failed, for `test again`. It is removed at
the start, so that after an interruption nothing is known to have failed.
"""

import argparse
import os
import signal
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
RESULTS = Path(os.environ["TUTORIAL_RESULTS"])
PYTEST = ["/usr/bin/python3", "-m", "pytest"]
JOBS = int(os.environ.get("TUTORIAL_JOBS", "2"))  # tests at a time
NUMBER_OF_INTERRUPT = 130
TOGETHER = ("ros", "system", "launch")  # of all; they mostly wait, so they run at the same time
# pytest: all passed, some failed, or none was selected. Others: it ended early, without a summary.
PYTEST_SUMMED_UP = (0, 1, 5)
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
RUNNING = []  # in the background
PART = "TUTORIAL_PART"  # environment variable: this is one kind of all, which another one sums up


def say(line):
    """Report to the user."""
    print(f"tutorial: {line}", file=sys.stderr, flush=True)


def interrupt(number, _):
    """Handle a signal of ENDING."""
    raise KeyboardInterrupt(number)


def run(command, **variables):
    """Run a command in the repository; return its exit code. Ctrl-C reaches it, too."""
    environment = {**os.environ, **variables}
    process = subprocess.Popen(list(map(str, command)), cwd=REPOSITORY, env=environment)
    try:
        return process.wait()
    except KeyboardInterrupt as error:
        if error.args == (signal.SIGTERM,):  # which comes to this process alone
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
    """The arguments for pytest: a folder, unless they name something in it."""
    named = any(argument.startswith(folder) for argument in arguments)
    return arguments if named else [folder, *arguments]


def unit(arguments):
    """All of them several at a time; with arguments in turn, so that -s shows what they print."""
    return run([*PYTEST, *with_folder("test/unit", arguments or ["-n", str(JOBS)])])


def launch(arguments):
    """Whether roslaunch can read each launch file."""
    return run([*PYTEST, "-p", "no:benchmark", "-n", JOBS, *with_folder("test/launch", arguments)])


def ros(arguments):
    """All rostests, or those in one folder of test/ros, or in these files, N times."""
    parser = argparse.ArgumentParser(prog="./tutorial test ros")
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
            sys.exit(f'tutorial: test: "{test}" is no folder of test/ros, and no file of a rostest')
    tests = [test.resolve() for test in tests * options.times]
    # They wait more than they work.
    return run([REPOSITORY / "test/run_rostests", 2 * JOBS, RESULTS / "rostests", *tests])


def system(arguments):
    """By file, as the tests of a file share what takes long to set up."""
    noted = RESULTS / "failed_system"
    noted.unlink(missing_ok=True)
    arguments = with_folder("test/system", arguments)
    kernel_test = "--ignore=test/system/test_kernel_joystick.py"
    several = ["-p", "no:benchmark", "-n", str(JOBS), "--dist", "loadfile", kernel_test]
    status = run([*PYTEST, *several, *arguments], TUTORIAL_FAILED=str(noted))
    if status not in PYTEST_SUMMED_UP:
        print("", *(f"FAILED {test}" for test in names_in(noted)), sep="\n", flush=True)
        status = 128 - status if status < 0 else status
        say(f"pytest itself ended early (exit code {status}), so other tests may not have run")
        noted.write_text("test/system\n")
    return status


def again(_):
    """Run what failed once more, with little else beside it; no unit test goes by the clock."""
    if not (RESULTS / "failed").exists():
        todo = "./tutorial test must run to its end first"
        sys.exit(f"tutorial: test again: it is not known what failed: {todo}")
    status = 0
    for kind in names_in(RESULTS / "failed"):
        noted = {"system": "failed_system", "ros": "rostests/failed"}.get(kind, "none")
        tests = names_in(RESULTS / noted)
        if not tests:
            say(f"tests: {kind}: no single ones to run again; next: ./tutorial test {kind}")
            status = 1
        elif kind == "system":
            status |= bool(system(["-n", "1", *tests]))
        else:
            rostests = [REPOSITORY / "test/run_rostests", 1, RESULTS / "rostests", *tests]
            status |= bool(run(rostests))
    return status


def names_in(file):
    """The different lines of a file, in order; none if there is no file."""
    return sorted(set(file.read_text().splitlines())) if file.exists() else []


def kernel(arguments):
    """A joystick of a real kernel: this one's, or Debian's in QEMU."""
    return run([*PYTEST, "test/system/test_kernel_joystick.py", *arguments])


def exercises(arguments):
    """Four times as many at a time: they wait more than they work."""
    return run([*PYTEST, "-p", "no:benchmark", "-n", 4 * JOBS, "test/exercises", *arguments])


def browser(arguments):
    """The cockpit's page in browsers."""
    return run([*PYTEST, "-p", "no:benchmark", *with_folder("test/browser", arguments)])


def containers(arguments):
    """The suite in containers, on a Docker engine."""
    return run([REPOSITORY / "docker/check_containers", *arguments])


def faults(arguments):
    """The hunt for faults on the live system."""
    return run(["/usr/bin/python3", "-m", "tutorial_faults", *arguments])


def mutation(arguments):
    """In the background of whatever else runs here: it takes hours."""
    python = RESULTS / "mutation/bin/python"
    return run(["nice", "-n", "19", python, "test/mutation/run.py", *arguments])


def bench(arguments):
    """The benchmarks of all packages, or of one."""
    package, *rest = arguments or [""]
    return run([*PYTEST, "-q", "-s", f"test/benchmark/{package}", *rest])


KINDS = (unit, launch, ros, system, again, kernel, exercises, browser, containers)
KINDS = {kind.__name__: kind for kind in (*KINDS, faults, mutation, bench)}


def run_all():
    """Unit tests, then the others at once; return the kinds that failed."""
    say("tests: unit")
    failed = ["unit"] if unit([]) else []
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
