"""Starts examine isolated and reads what it finds. Knows no ROS."""

from __future__ import annotations

import compileall
import contextlib
import functools
import itertools
import json
import os
import select
import shutil
import socket
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Callable, Iterable, Mapping

from tutorial_check.course import FILE, OURS, read_course
from tutorial_check.isolation import bubblewrap, privileges
from tutorial_check.isolation.environment import environment_of
from tutorial_check.model import WRONG, CannotCheck, Result, passed
from tutorial_check.order import Order
from tutorial_check.record.recording import as_json
from tutorial_check.source import workspace as workspaces

# All exercises take 90 s on two quiet processors. Ten times as long is enough: where programs have less
# than a seventh of the time, there is no verdict anyway (cpu_clock.HOPELESS), and a student waits.
LONGEST_S = 900.0
# Of a shell of the suite: its roscore.xml, with which each roslaunch starts sooner, and what CMake 4
# needs to read catkin's files.
OF_SUITE = ("ROS_ETC_DIR", "CMAKE_POLICY_VERSION_MINIMUM")
END_S = 10.0  # an examination whose result is not wanted has this long to end what it started
SUITE = Path(__file__).resolve().parents[4]
NUMBERS = itertools.count(os.getpid() * 100)
_no_more = threading.Event()


@dataclass
class Outcome:
    """What came of one exercise."""

    id: str
    results: list[Result] = field(default_factory=list)
    seconds: float = 0.0
    done: bool = False
    trouble: str = ""  # why a check could not be made, through no fault of the student's
    title: str = ""
    points: float = 0.0  # for all of it; 0: one a check
    place: str = ""  # of the workspace in what was handed in, if that is another folder
    remark: str = ""  # how well a program of somebody else's was isolated, if not by bubblewrap

    @property
    def passed(self) -> bool:
        return self.done and passed(self.results)

    @property
    def empty(self) -> bool:
        """Whether it passed because there was nothing to check."""
        return self.passed and bool(self.results) and all(each.empty for each in self.results)

    @property
    def solved(self) -> bool:
        """Whether it passed and there was something to check."""
        return self.passed and not self.empty

    @property
    def wrong(self) -> list[Result]:
        """The checks that are wrong, in their order."""
        return [each for each in self.results if each.status == WRONG]


Report = Callable[[Outcome, Result], None]


def examine(
    workspace: str | Path,
    underlay: str | Path,
    exercises: Iterable[str],
    report: Report = lambda outcome, result: None,
    *,
    only_first: bool = False,
    own: bool = True,
    course: Path = OURS,
    variant: Mapping[str, Any] = MappingProxyType({}),
) -> list[Outcome]:
    """Return the Outcomes of a workspace; call report with each result as soon as it is there.

    underlay: setup.bash of the devel space with what students use and never write. only_first: end
    at the first check that is wrong. own: it is the caller's own workspace, whose links may lead
    into the home folder. course: its folder. variant: of the task; see variants.Variant. Raises CannotCheck.
    """
    if not os.path.isfile(underlay):
        why = "no such file, or may not be read; ./tutorial setup builds it"
        raise CannotCheck(f"{underlay}: {why}")
    # Isolated, an examination does not reach the folder itself.
    folder, cleaner = privileges.folder_until_end("tutorial_check_")
    try:
        # An examination, which writes nothing, would compile our modules each time.
        compileall.compile_dir(str(Path(__file__).parent), quiet=2)
        layout, shown = _hand_in(os.path.abspath(workspace), Path(folder), own)
        checks = _course_within(Path(folder), course)
        underlay = os.path.abspath(underlay)
        kept = _kept(underlay)
        seen = [*map(str, shown), str(checks), *kept]
        wrapper = bubblewrap.command(folder, seen, SUITE)
        order = Order(
            folder=folder, root=str(layout.root), source=str(layout.source),
            is_workspace=layout.is_workspace, own=own, exercises=tuple(exercises),
            only_first=only_first, course=str(checks), variant=dict(variant), underlay=underlay,
            environment=_environment(underlay), kept=tuple(kept), shown=tuple(seen),
            number=next(NUMBERS), apart=bool(wrapper),
        )  # fmt: skip
        outcomes = _examine(order, wrapper, report)
        remark = "" if own else bubblewrap.instead()
        return [replace(one, place=layout.place, remark=remark) for one in outcomes]
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        cleaner.communicate()


def end_all() -> None:
    """End the examinations of all threads, and those that have just begun; each raises CannotCheck."""
    _no_more.set()


@functools.lru_cache(maxsize=None)
def _environment(underlay: str) -> dict[str, str]:
    """Return what a shell has that has sourced setup.bash, and nothing else. Raises CannotCheck."""
    words = ["bash", "-c", '. "$1" >/dev/null && env -0', "bash", underlay]
    bare = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    about: dict[str, Any] = {"env": bare, "capture_output": True, "timeout": 120, "text": True}
    try:
        done = subprocess.run(words, check=True, **about)
    except (OSError, subprocess.SubprocessError) as error:
        why = (getattr(error, "stderr", "") or str(error))[-200:]
        raise CannotCheck(f"{underlay} cannot be sourced: {why}") from None
    # rospy loads numpy, which starts a thread for each processor; none is needed here.
    found = environment_of(done.stdout.split("\0"))
    return {**found, **_given(OF_SUITE), "OPENBLAS_NUM_THREADS": "1"}


def _given(names: Iterable[str]) -> dict[str, str]:
    return {name: os.environ[name] for name in names if name in os.environ}


def _kept(underlay: str) -> list[str]:
    """Return the folders that the programs need: the underlay and its sources, this package among them."""
    devel = Path(underlay).parent
    names = devel / ".catkin"
    sources = filter(None, names.read_text().split(";") if names.is_file() else [])
    links = [link for source in sources for link in Path(source).glob("*") if link.is_dir()]
    return [str(devel.parent), *(str(link.resolve()) for link in links)]


def _course_within(folder: Path, course: Path) -> Path:
    """Copy what the examination needs of a course, and no solution, into its folder; ours is there."""
    if course == OURS:
        return course
    copied = folder / "course"
    copied.mkdir()
    for path in (course / FILE, *course.glob("*.py")):
        shutil.copy(path, copied)
    return copied


def _hand_in(workspace: str, folder: Path, own: bool) -> tuple[workspaces.Layout, list[Path]]:
    """Copy a workspace or zip; return its Layout, and what to show of it. Raises CannotCheck."""
    layout, inside = workspaces.hand_in(workspace, folder)
    workspaces.must_be_ones_own(layout, SUITE)
    copied = workspaces.copy(layout, folder / workspaces.COPY, None if own else inside)
    shown = [inside, folder / workspaces.COPY]
    if own:
        shown += [layout.source, *map(Path, workspaces.named_outside(copied))]
    # A home folder is no workspace, though one may lie in it.
    home = Path(os.path.expanduser("~")).resolve()
    return layout, [each for each in shown if each.resolve() not in (home, *home.parents)]


def _examine(order: Order, wrapper: list[str], report: Report) -> list[Outcome]:
    if not wrapper:
        privileges.keep_to_itself()  # and the end of the socket
    environment = {**order.environment, **_given(("HOME", "LANG"))}
    environment.update(PATH="/usr/bin:/bin:/usr/sbin:/sbin", PYTHONDONTWRITEBYTECODE="1")
    # No pipe, which a path in /proc would open: a program could plant a link to that.
    ours, theirs = socket.socketpair()
    known = read_course(order.course).exercises
    outcomes = {
        name: Outcome(name, title=known[name].title, points=known[name].points)
        for name in order.exercises
    }
    with tempfile.TemporaryFile("w+") as log, ours:
        process = subprocess.Popen(
            # -s: without what pip put into the home folder, which may be shown nowhere
            [*wrapper, "/usr/bin/python3", "-s", "-m", "tutorial_check.worker"],
            stdin=subprocess.PIPE,
            stdout=theirs.fileno(),
            stderr=log,
            env=environment,
            start_new_session=True,
            pass_fds=bubblewrap.granted().descriptors if wrapper else (),
            cwd="/",
            text=True,
        )
        theirs.close()
        try:
            assert process.stdin
            json.dump(as_json(order), process.stdin)
            process.stdin.close()
            ending = _listen(ours, outcomes, report)
        finally:
            ours.close()  # so that it ends
            try:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(0 if wrapper else END_S)
            finally:
                process.kill()  # with it all of its namespaces
                process.wait()
        log.seek(0)
        logged = log.read()
    if ending is None:
        last = ["", *filter(str.strip, logged[-2000:].splitlines())][-1]
        ending = f"the examination ended without a result: {last}"
    found = list(outcomes.values())
    if ending and (_no_more.is_set() or not any(outcome.results for outcome in found)):
        raise CannotCheck(ending)
    for outcome in found:
        outcome.trouble = outcome.trouble if outcome.done else ending
    return found


def _listen(ours: socket.socket, outcomes: dict[str, Outcome], report: Report) -> str | None:
    """Return why the examination cannot go on, empty at its end; None if it ends without a final message."""
    end = time.monotonic() + LONGEST_S
    buffer = ""
    while time.monotonic() < end:
        if _no_more.is_set():
            return None
        if not select.select([ours], [], [], 0.2)[0]:
            continue
        data = ours.recv(65536).decode(errors="replace")
        if not data:
            return None
        *lines, buffer = (buffer + data).split("\n")
        for word in map(json.loads, lines):
            if "exercise" not in word:
                return str(word.get("cannot", ""))
            _note(word, outcomes, report)
    why = "the machine has too much else to do"
    return f"the examination took longer than {LONGEST_S:.0f} s: {why}"


def _note(word: dict[str, Any], outcomes: dict[str, Outcome], report: Report) -> None:
    outcome = outcomes.get(word["exercise"])
    if outcome is None or outcome.done:
        return  # it was not asked for, or has ended
    if "result" not in word:
        outcome.seconds, outcome.done, outcome.trouble = word["done"], True, word["trouble"]
        return
    result = Result(**word["result"])
    if result.id not in [each.id for each in outcome.results]:
        outcome.results.append(result)
        report(outcome, result)
