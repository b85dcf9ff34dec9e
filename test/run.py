#!/usr/bin/python3
"""Run tests: ./tutorial test [KIND] [ARGUMENT ...] in the environment of the suite's workspace.

The file `failed` in $TUTORIAL_RESULTS has the kinds that failed, for `test again`. It is removed at
the start, so that after an interruption nothing is known to have failed.
"""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
RESULTS = Path(os.environ["TUTORIAL_RESULTS"])
FAILED, CACHES = RESULTS / "failed", RESULTS / "pytest"
PYTEST = ["/usr/bin/python3", "-m", "pytest"]
JOBS = int(os.environ.get("TUTORIAL_JOBS", "2"))  # tests at a time
NUMBER_OF_INTERRUPT = 130
TOGETHER = ("ros", "system", "launch")  # they mostly wait, so they run at the same time
ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
RUNNING = []  # in the background
BRIDGE = "--bridge"  # option of the faults
MUTATE = RESULTS / "mutation/bin/python"  # with the lowest priority, as it takes hours


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


def end_background():
    """End what runs in the background, as Ctrl-C does."""
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
    for process in RUNNING:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
    for process in RUNNING:
        process.wait()


def tests(kind, given, *options):
    """Run pytest on the folder of a kind, or on what is named in it; it notes what fails."""
    folder = f"test/{kind}"
    where = [] if any(argument.startswith(folder) for argument in given) else [folder]
    cache = ["-o", f"cache_dir={CACHES / kind}"]  # one per kind, as several run at a time
    return run(*PYTEST, "-p", "no:benchmark", *cache, *options, *where, *given)


def again(_):
    """Run what failed once more, with little else beside it; no unit test goes by the clock."""
    if not FAILED.exists():
        todo = "./tutorial test must run to its end first"
        sys.exit(f"tutorial: test again: it is not known what failed: {todo}")
    kinds = FAILED.read_text().split()
    say(f"what failed: {' '.join(kinds) or 'nothing'}")
    if not set(kinds) <= set(TOGETHER):
        sys.exit(f"tutorial: test again: only for {', '.join(TOGETHER)}; failed: {' '.join(kinds)}")
    return any([KINDS[kind](["--last-failed", "-n", "1"]) for kind in kinds])


def faults(arguments):
    """Hit the live system with random faults; with --bridge the one between ROS 1 and ROS 2."""
    if BRIDGE not in arguments:
        return run("/usr/bin/python3", "-m", "tutorial_faults.live.program", *arguments)
    rest = [argument for argument in arguments if argument != BRIDGE]
    return tests("ros2", ["-q", "-s", "test/ros2/test_faults.py", "-k", "random", *rest])


KINDS = {
    # Several at a time; with arguments in turn, so that -s shows what they print.
    "unit": lambda given: tests("unit", given or ["-n", str(JOBS)]),
    "launch": lambda given: tests("launch", given, "-n", JOBS),
    # More at a time: they wait more than they work.
    "ros": lambda given: tests("ros", given, "-n", 2 * JOBS),
    "exercises": lambda given: tests("exercises", given, "-n", 4 * JOBS),
    "system": lambda given: tests("system", given, "-n", JOBS + 2, "--dist", "loadgroup"),
    "again": again,
    "kernel": lambda given: tests("kernel", given),
    "ros2": lambda given: tests("ros2", given),
    "browser": lambda given: tests("browser", given, "-n", JOBS, "--dist", "loadfile"),
    "containers": lambda given: run(REPOSITORY / "test/check_containers", *given),
    "faults": faults,
    "mutation": lambda given: run("nice", "-n", "19", MUTATE, "test/mutation/run.py", *given),
    "bench": lambda given: run(*PYTEST, "-qs", f"test/benchmark/{''.join(given[:1])}", *given[1:]),
}


def run_all():
    """Run unit tests, then the others at once; return the kinds that failed."""
    shutil.rmtree(CACHES, ignore_errors=True)  # a killed run may have left some
    say("tests: unit")
    options = os.environ.get("TUTORIAL_UNIT", "").split()  # pytest options: .ci/run
    failed = ["unit"] if KINDS["unit"](options) else []
    logs = [RESULTS / f"test_{kind}.log" for kind in TOGETHER]
    for kind, log in zip(TOGETHER, logs):
        with log.open("w") as output:
            command = subprocess.Popen(
                [__file__, kind], cwd=REPOSITORY, start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=output, stderr=output,
            )  # fmt: skip
        RUNNING.append(command)
    say("tests: ros, system and launch at once, for some minutes; until then see")
    say(f"   {RESULTS}/test_*.log")
    for kind, log, process in zip(TOGETHER, logs, RUNNING):
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
    try:
        if kind in ("again", "faults", "bench"):
            sys.exit(KINDS[kind](arguments))
        FAILED.unlink(missing_ok=True)
        failed = run_all() if not kind else [kind] if KINDS[kind](arguments) else []
    except KeyboardInterrupt:
        end_background()
        FAILED.unlink(missing_ok=True)
        say("test: interrupted")
        sys.exit(NUMBER_OF_INTERRUPT)
    FAILED.write_text("".join(f"{kind}\n" for kind in failed))
    if failed and set(failed) <= set(TOGETHER):
        say("next: ./tutorial test again")
    if failed:
        sys.exit(f"tutorial: failed: {' '.join(failed)}")


if __name__ == "__main__":
    main()
