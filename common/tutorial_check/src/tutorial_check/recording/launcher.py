"""Start an isolated worker with a copy of the submission and the environment of its programs."""

from __future__ import annotations

import contextlib
import functools
import itertools
import os
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any, Iterator

from tutorial_check.course.definition import SUITE, copy_sources
from tutorial_check.errors import CannotCheck
from tutorial_check.recording.build_store import BuildStore
from tutorial_check.recording.worker_process import Worker
from tutorial_check.sandbox import bubblewrap, privileges
from tutorial_check.sandbox.environment import environment_of
from tutorial_check.submission import cpp_tree, handed_in
from tutorial_check.submission.order import Order

# Set in a ./tutorial shell: roscore.xml, for a faster roslaunch; what catkin needs with CMake 4.
OF_SUITE = ("ROS_ETC_DIR", "CMAKE_POLICY_VERSION_MINIMUM")
NUMBERS = itertools.count(os.getpid() * 100)


@contextlib.contextmanager
def started(bare: Order) -> Iterator[tuple[Order, Worker]]:
    """Yield the complete order and a worker that can record."""
    user = privileges.unused_user(next(NUMBERS)) if os.geteuid() == 0 else None
    # An isolated worker cannot remove the folder itself.
    folder, cleaner = privileges.folder_until_end("tutorial_check_", user)
    try:
        order = prepared(bare, Path(folder))
        course = order.folder / "course" / bare.course.name
        copy_sources(bare.course, course)
        shown = replace(order.sandbox, readable=(*order.sandbox.readable, course))
        order = replace(order, course=course, sandbox=shown)
        wrapper = bubblewrap.command(folder, order.sandbox.readable, SUITE)
        order = replace(order, sandbox=replace(order.sandbox, in_namespaces=bool(wrapper)))
        must_start_programs(order, is_other=user is not None)
        if user is not None:
            privileges.open_to(user, folder)
        wrapper = [*privileges.unlimited(), *wrapper, *privileges.as_user(user)]
        with BuildStore(order) as store, Worker(order, wrapper, store) as worker:
            worker.begin()
            yield order, worker
    finally:
        cleaner.communicate()


def prepared(bare: Order, folder: Path) -> Order:
    """Copy a workspace or zip into an empty folder; complete the order. Raises CannotCheck."""
    layout, inside = handed_in.hand_in(os.path.abspath(bare.workspace), folder)
    handed_in.must_be_ones_own(layout, SUITE)
    within = None if bare.is_callers_own else inside
    copied = handed_in.copy(layout, folder / handed_in.COPY, within)
    readable = [inside, copied]
    if bare.is_callers_own:
        readable += [layout.source, *map(Path, handed_in.named_outside(copied))]
    # A home folder is not shown, even if it has a workspace.
    home = Path(os.path.expanduser("~")).resolve()
    readable = [path for path in readable if path.resolve() not in (home, *home.parents)]
    bare, parser = sourced(bare), cpp_tree.folder()
    readable += [parser] if parser else []
    return replace(
        bare, folder=folder, layout=layout,
        sandbox=replace(bare.sandbox, readable=(*readable, *_needed(bare.underlay))),
    )  # fmt: skip


def sourced(bare: Order) -> Order:
    """Return an order with the environment of its underlay. Raises CannotCheck."""
    if bare.sandbox.environment:
        return bare
    if not os.path.isfile(bare.underlay):
        why = "no such file, or not readable; ./tutorial setup builds it"
        raise CannotCheck(f"{bare.underlay}: {why}")
    underlay = os.path.abspath(bare.underlay)
    sandbox = replace(bare.sandbox, environment=_environment(underlay))
    return replace(bare, underlay=underlay, sandbox=sandbox)


def _needed(underlay: str) -> tuple[Path, ...]:
    """Return what programs need: the underlay and its sources, including this package."""
    devel = Path(underlay).parent
    names = devel / ".catkin"
    sources = filter(None, names.read_text().split(";") if names.is_file() else [])
    links = [link for source in sources for link in Path(source).glob("*") if link.is_dir()]
    return (devel.parent, *(link.resolve() for link in links))


@functools.lru_cache(maxsize=None)
def _environment(underlay: str) -> dict[str, str]:
    """Return the environment of a bare shell that sourced setup.bash. Raises CannotCheck."""
    words = ["bash", "-c", '. "$1" >/dev/null && env -0', "bash", underlay]
    bare = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
    about: dict[str, Any] = {"env": bare, "capture_output": True, "timeout": 120, "text": True}
    try:
        done = subprocess.run(words, check=True, **about)
    except (OSError, subprocess.SubprocessError) as error:
        why = (getattr(error, "stderr", "") or str(error))[-200:]
        raise CannotCheck(f"{underlay} cannot be sourced: {why}") from None
    # rospy loads numpy, which would start a thread for each CPU.
    variables = environment_of(done.stdout.split("\0"))
    own = {name: os.environ[name] for name in OF_SUITE if name in os.environ}
    # No Python here loads what a student's program has put into its home folder.
    return {**variables, **own, "OPENBLAS_NUM_THREADS": "1", "PYTHONNOUSERSITE": "1"}


def must_start_programs(order: Order, is_other: bool) -> None:
    """Raise CannotCheck if no program can be started. is_other: as another user."""
    if not order.sandbox.in_namespaces and os.statvfs(order.folder).f_flag & os.ST_NOEXEC:
        why = "is mounted noexec: set TMPDIR to another folder"
        raise CannotCheck(f"no program can be started: {order.folder.parent} {why}")
    needed = set(_needed(order.underlay)) if is_other else set()
    ways = {up for path in (order.folder, *needed) for up in path.parents} if is_other else set()
    for folder in sorted(needed if order.sandbox.in_namespaces else needed | ways):
        if not folder.stat().st_mode & 0o001:
            # Open everything below a needed folder, but of a home folder only the folder itself.
            is_needed = needed & {folder, *folder.parents}
            how = f"{'chmod -R o+rX' if is_needed else 'chmod o+x'} {folder}"
            how += ", or keep this suite, TUTORIAL_WORKSPACE and TMPDIR where others may enter"
            why = "is closed to others, and the programs run as another user"
            raise CannotCheck(f"{folder} {why}: {how}")
