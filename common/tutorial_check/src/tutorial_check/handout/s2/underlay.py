"""C1: the workspace, and the underlay that it was built over."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

from tutorial_check.course import check
from tutorial_check.handout.s2.packages import WANTED
from tutorial_check.model import Note, Wrong
from tutorial_check.record.session import Session
from tutorial_check.source.manifests import is_stand_in
from tutorial_check.source.workspace import underlays

SUITE = ("node_kit", "fake_turtlebot_sim")  # packages of the underlay
AGAIN = "in the workspace: rm -r build devel, then catkin_make"


@check("C1", "the workspace", "2.1", look="ls src devel", timeless=True, eager=True)
def workspace(session: Session) -> Note | str | None:
    layout = session.layout
    if not layout.source.is_dir():
        seen = f"none in {layout.root}, and no package"
        hint = "is this your workspace? --in ~/ros/hydro/catkin_ws; a new one begins with src"
        raise Wrong("a folder src in the workspace", seen, hint=hint)
    _check_names(session)
    if not layout.is_workspace:
        return Note("handed in as packages, without their workspace: built again here")
    devel = layout.root / "devel"
    real = Path(os.path.realpath(devel / "setup.sh"))
    if layout.root.resolve() not in real.parents and not session.may_see(real):
        return Note("never built here (devel is a link that leads elsewhere)")
    made_for, below = underlays(devel)
    setup = devel / "setup.bash"
    if made_for and os.path.realpath(made_for) != os.path.realpath(devel):
        return Note(f"its devel folder was made elsewhere ({made_for}); built again here")
    if setup.is_file() and not (made_for and below is not None and setup.stat().st_size):
        gone = setup.name if made_for and below is not None else "_setup_util.py or setup.sh"
        seen = f"it is not whole: {gone} is missing or empty"
        raise Wrong("a devel folder as catkin_make makes it", seen, "devel", AGAIN)
    if not made_for and any((layout.source / name).is_dir() for name in ("build", "devel")):
        hint = "catkin_make is called in the workspace: cd .., and remove src/build and src/devel"
        raise Wrong("build and devel beside src", "they are within src", hint=hint)
    if below is None:
        return Note("never built here (no devel/setup.bash)", hint="catkin_make in the workspace")
    own = str(devel.resolve())
    _check_below(session, [each for each in below if os.path.realpath(each) != own])
    return "src and devel, on top of this suite"


def _check_below(session: Session, below: Sequence[str]) -> None:
    """Raise Wrong unless this suite is among the folders that a workspace was built over."""
    suite = os.path.realpath(Path(session.order.underlay).parent)
    if suite in map(os.path.realpath, below):
        return
    seen = f"devel was built over {', '.join(below) or 'nothing'}"
    hint = "built in a terminal without ./tutorial shell: delete build and devel, then catkin_make in it"
    for other in below[::-1]:  # the first counts
        is_suite = any(os.path.isdir(f"{other}/share/{name}") for name in SUITE)
        if is_suite or Path(other).parts[-2:] == ("lower", "devel"):  # it may be hidden here
            seen = f"devel was built over another copy of the suite, {other}; this one is {suite}"
            hint = f"{AGAIN} in the ./tutorial shell of this copy; or check with the ./tutorial"
            hint += " (and TUTORIAL_WORKSPACE) of the other"
    raise Wrong("a workspace built on top of this suite", seen, "devel", hint)


def _check_names(session: Session) -> None:
    """Raise Wrong for a package with the name of one that the exercises need."""
    share = Path(session.order.underlay).parent / "share"
    for each in session.packages:
        is_suite = (share / each.name).is_dir() and not is_stand_in(each.name)
        brings = (each.folder / "msg", each.folder / "src" / each.name)
        is_ros = any(each.name in names for names in WANTED.values())
        # A clone of the real one is no package that catkin_create_pkg made by mistake.
        if is_suite or (is_ros and not any(map(Path.is_dir, brings))):
            seen = f"a package {each.name}: it hides {'the suite' if is_suite else 'ROS'}'s own"
            hint = "remove it from src. If catkin_create_pkg made it: its first word is the name"
            hint += " of the new package, those after it what that depends on"
            raise Wrong("packages of names of their own", seen, f"src/{each.inside}", hint)
