"""Packages of rqt that Debian lacks, so that rosrun finds their programs."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from tutorial_tools.windows import TABS

MODEL = "common/stand_ins/rqt_gui"  # from which the others are made
SCRIPTS = "common/tutorial_tools/scripts"
# Package -> its one program, of the same name.
RQT = {name: f"{MODEL}/scripts/rqt_gui" for name in sorted(set(TABS) - {"rqt_gui"})}
RQT.update({name: f"{SCRIPTS}/{name}" for name in ("rqt_bag", "rqt_graph")})


def make_rqt(repository: Path, share: Path, folder: Path) -> Iterator[Path]:
    """Make the packages that are not below share, where ROS has its own; yield each program."""
    for name, script in RQT.items():
        if (share / name / "package.xml").exists():
            continue
        program = folder / name / "scripts" / name
        program.parent.mkdir(parents=True, exist_ok=True)
        for file in ("CMakeLists.txt", "package.xml"):
            text = (repository / MODEL / file).read_text(encoding="utf-8")
            (folder / name / file).write_text(text.replace("rqt_gui", name), encoding="utf-8")
        with contextlib.suppress(FileExistsError):
            program.symlink_to(repository / script)
        yield program
