"""Starts examine in a place apart and reads what it tells. Knows no ROS."""

import compileall
import functools
import itertools
import json
import os
import selectors
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from tutorial_check import place
from tutorial_check import workspace as workspaces
from tutorial_check.model import CannotCheck, Result, passed

# All exercises take 90 s on two quiet processors, and each check has deadlines of its own, which a busy
# machine stretches. Ten times as long is enough: where programs have less than a seventh of the time,
# there is no verdict anyway (patience.HOPELESS), and a student waits for an answer.
LONGEST_S = 900.0
# Of a shell of the suite: its roscore.xml, with which each roslaunch starts sooner, and what CMake 4
# needs to read catkin's files.
OF_SUITE = ("ROS_ETC_DIR", "CMAKE_POLICY_VERSION_MINIMUM")
END_S = 10.0  # an examination that nobody listens to has this long to end what it started
SUITE = Path(__file__).resolve().parents[4]
_no_more = threading.Event()
NUMBERS = itertools.count(os.getpid() * 100)


@dataclass
class Outcome:
    """What came of one exercise."""

    id: str
    results: list = field(default_factory=list)
    seconds: float = 0.0
    done: bool = False
    trouble: str = ""  # why a check could not be made, through no fault of the student's

    @property
    def passed(self):
        """Whether it is done, and nothing in it wrong."""
        return self.done and passed(self.results)

    @property
    def empty(self):
        """Whether there was nothing to check: nothing is wrong, and nothing done."""
        return self.passed and bool(self.results) and all(each.empty for each in self.results)


def examine(
    workspace, floor, exercises, tell=lambda outcome, result: None, *, only_first=False, own=True
):
    """[Outcome] of a workspace. tell is called with each result as soon as it is there.

    floor: setup.bash of the devel space with what students use and never write. only_first: end
    each exercise at the first check that is wrong. own: it is the caller's own workspace, whose
    links may lead into his home folder.
    Raises CannotCheck.
    """
    try:
        if not Path(floor).is_file():
            raise CannotCheck(f"{floor}: no such file; ./tutorial setup builds it")
        if not Path(workspace).exists():
            raise CannotCheck(
                f"{workspace}: no such folder or zip; ./tutorial shell --in FOLDER makes a workspace"
            )
    except PermissionError as error:
        raise CannotCheck(f"{error.filename}: may not be read") from None
    folder = tempfile.mkdtemp(prefix="tutorial_check_")
    # If this process is killed; isolated, an examination does not reach the folder itself.
    cleaner = subprocess.Popen(
        ["sh", "-c", 'read -r _; rm -rf -- "$1"', "sh", folder],
        stdin=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        return _examine(
            os.path.abspath(workspace),
            os.path.abspath(floor),
            exercises,
            folder,
            tell=tell,
            only_first=only_first,
            own=own,
        )
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        cleaner.communicate()


def end_all():
    """End the examinations of all threads, and those that are just begun; each raises CannotCheck."""
    _no_more.set()


@functools.lru_cache(maxsize=None)
def _environment(floor):
    """What a shell has that has sourced setup.bash of the floor, and nothing else. Raises CannotCheck."""
    try:
        done = subprocess.run(
            ["bash", "-c", '. "$1" >/dev/null && env -0', "bash", floor],
            env={"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"},
            capture_output=True,
            check=False,
            timeout=120,
            text=True,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CannotCheck(f"{floor} cannot be sourced: {error}") from None
    if done.returncode != 0:
        raise CannotCheck(f"{floor} cannot be sourced: {done.stderr[-200:]}")
    found = dict(word.split("=", 1) for word in done.stdout.split("\0") if "=" in word)
    found.update({name: os.environ[name] for name in OF_SUITE if name in os.environ})
    # rospy loads numpy, which starts a thread for each processor; none is needed here.
    found["OPENBLAS_NUM_THREADS"] = "1"
    return {name: found[name] for name in found if name not in ("_", "SHLVL", "PWD", "OLDPWD")}


@functools.lru_cache(maxsize=None)
def _compiled():
    """Compile our modules once: an examination, which writes nothing, would compile them each time."""
    compileall.compile_dir(Path(__file__).parent, quiet=2)


def _kept(floor):
    """Folders that the programs need: the floor, and its sources, this package among them."""
    devel = Path(floor).parent
    kept = [devel.parent]
    with_sources = devel / ".catkin"
    if with_sources.is_file():
        for source in with_sources.read_text().split(";"):
            kept += (
                [link.resolve() for link in Path(source).glob("*") if link.is_dir()]
                if source
                else []
            )
    return [str(each) for each in kept]


def _hand_in(workspace, folder, own):
    """(Layout, files and folders to show) of a workspace or zip, of which a copy is made. Raises CannotCheck."""
    layout, inside = workspaces.hand_in(workspace, folder)
    workspaces.must_be_ones_own(layout, SUITE)
    copied = workspaces.copy(layout, folder / workspaces.COPY, None if own else inside)
    shown = [inside, folder / workspaces.COPY]
    if own:
        shown += [layout.source, *workspaces.named_outside(copied)]
    # A home folder is no workspace, though one may lie in it.
    home = Path(os.path.expanduser("~")).resolve()
    return layout, [each for each in shown if Path(each).resolve() not in (home, *home.parents)]


def _examine(workspace, floor, exercises, folder, *, tell, only_first, own):
    _compiled()
    layout, shown = _hand_in(workspace, Path(folder), own)
    wrapper = place.command(folder, [*shown, *_kept(floor)], SUITE)
    if not wrapper:
        place.keep_to_itself()  # and the end of the pipe
    orders = {
        "layout": [layout.root, layout.source, layout.is_workspace],
        "own": own,
        "floor": floor,
        "exercises": list(exercises),
        "folder": folder,
        "apart": bool(wrapper),
        "kept": _kept(floor),
        "number": next(NUMBERS),
        "only_first": only_first,
        "environment": _environment(floor),
    }
    environment = {
        **_environment(floor),
        **{
            name: os.environ[name]
            for name in ("HOME", "LANG", "TUTORIAL_CHECK_TIMES")
            if name in os.environ
        },
        "PATH": "/usr/bin:/bin:/usr/sbin:/sbin",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    log = tempfile.TemporaryFile("w+")  # noqa: SIM115  read below
    # No pipe, which a path in /proc would open: a program could plant a link to that.
    ours, theirs = socket.socketpair()
    process = subprocess.Popen(
        # -s: without what pip put into the home folder, which may be shown nowhere
        [*wrapper, "/usr/bin/python3", "-s", "-m", "tutorial_check.examine"],
        stdin=subprocess.PIPE,
        stdout=theirs,
        stderr=log,
        env=environment,
        start_new_session=True,
        pass_fds=place.granted().descriptors if wrapper else (),
        cwd="/",
        text=True,
    )
    theirs.close()
    outcomes = {exercise: Outcome(exercise) for exercise in exercises}
    try:
        process.stdin.write(json.dumps(orders, default=str))
        process.stdin.close()
        ending = _listen(ours, outcomes, tell)
    finally:
        ours.close()  # by which it knows
        try:
            if not wrapper:
                process.wait(END_S)
        except subprocess.TimeoutExpired:
            pass
        finally:
            process.kill()  # with it all of its namespaces
            process.wait()

    if "TUTORIAL_CHECK_TIMES" in os.environ:
        log.seek(0)
        print(log.read(), file=sys.stderr)
    if ending is None:
        log.seek(0)
        last = [line for line in log.read()[-2000:].splitlines() if line.strip()][-1:]
        ending = {"cannot": f"the examination ended without a result: {''.join(last)}"}
    return _concluded(list(outcomes.values()), ending.get("cannot", ""))


def _concluded(outcomes, trouble):
    """The Outcomes, those that were not done with the trouble. Raises CannotCheck if that is all."""
    if trouble and (_no_more.is_set() or not any(outcome.results for outcome in outcomes)):
        raise CannotCheck(trouble)
    for outcome in outcomes:
        if not outcome.done:
            outcome.trouble = trouble
    return outcomes


def _listen(line_in, outcomes, tell):
    """The last word of the examination, or None if it ends without one."""
    end = time.monotonic() + LONGEST_S
    buffer = ""
    with selectors.DefaultSelector() as selector:
        selector.register(line_in, selectors.EVENT_READ)
        while time.monotonic() < end:
            if _no_more.is_set():
                return None
            if not selector.select(0.2):
                continue
            data = line_in.recv(65536).decode(errors="replace")
            if not data:
                return None
            *lines, buffer = (buffer + data).split("\n")
            for line in lines:
                word = json.loads(line)
                if "exercise" not in word:
                    return word
                outcome = outcomes.get(word["exercise"])
                if outcome is None or outcome.done:
                    continue  # nobody asked, or it was told already
                if "result" in word:
                    result = Result(**word["result"])
                    if result.id not in [each.id for each in outcome.results]:
                        outcome.results.append(result)
                        tell(outcome, result)
                else:
                    outcome.seconds, outcome.done = word["done"], True
                    outcome.trouble = word["trouble"]
    return {
        "cannot": f"the examination took longer than {LONGEST_S:.0f} s: "
        "the machine has too much else to do"
    }
