"""The windows of rqt, which Debian lacks: their packages, and the matching tabs of the cockpit."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Iterator, Sequence
from urllib.parse import urlencode

# Command and package: the tab.
TABS = {
    "rqt": "", "rqt_gui": "", "rqt_bag": "Bag", "rqt_console": "log", "rqt_graph": "Graph",
    "rqt_logger_level": "log", "rqt_plot": "plot", "rqt_publisher": "topics",
    "rqt_service_caller": "topics", "rqt_topic": "topics",
}  # fmt: skip
MODEL = "common/stand_ins/rqt_gui"  # the others are copies of it


def place(window: str, names: Sequence[str]) -> str:
    """Return the fragment of the page's address, which follows #.

    names: of topics, or of fields as rqt_plot takes them, such as /turtle1/pose/x:y,/joy/axes[0]
    """
    tab = TABS[window]
    full = [f"/{name.lstrip('/')}" for text in names for name in text.split(",") if name]
    if tab == "plot" and full:
        return f"plot?{urlencode([('f', f) for name in full for f in _fields(name)], safe='/[]')}"
    return f"{tab}{full[0]}" if tab == "topics" and full else tab


def _fields(text: str) -> list[str]:
    first, *others = text.split(":")
    above = first.rpartition("/")[0]
    return [first, *(f"{above}/{other}" for other in others)]


def make_rqt(repository: Path, real: Sequence[str], folder: Path) -> Iterator[Path]:
    """Make the packages that ROS itself does not have; yield the program of each."""
    for name in TABS:
        if name == "rqt_gui" or name in real:
            continue
        program = folder / name / "scripts" / name
        program.parent.mkdir(parents=True, exist_ok=True)
        for file in ("CMakeLists.txt", "package.xml"):
            text = (repository / MODEL / file).read_text(encoding="utf-8")
            (folder / name / file).write_text(text.replace("rqt_gui", name), encoding="utf-8")
        # A copy: through a link, catkin would write into the clone, which may be another user's.
        program.unlink(missing_ok=True)
        shutil.copyfile(repository / MODEL / "scripts/rqt_gui", program)
        program.chmod(0o755)
        yield program
