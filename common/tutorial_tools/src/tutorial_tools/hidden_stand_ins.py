"""Finds packages of a student that hide a stand-in and cannot run here."""

from __future__ import annotations

import re
from pathlib import Path

from node_kit.manifests import manifests

# A package in a launch file.
NAMED = re.compile(r"""\$\(find +(\w+) *\)|\bpkg=["'](\w+)["']""")


def hidden_stand_ins(workspace: Path, suite: Path, share: Path) -> list[tuple[str, str]]:
    """Return [(what is wrong, what to do)] for the packages of a workspace that hide a stand-in.

    Only for those that need a missing package, as rbx1_bringup of ROS by Example needs xacro, in
    a launch file that the stand-in has, too. share: the folder of installed packages.
    """
    own = {path.parent.name: path.parent for path in manifests(workspace / "src")}
    stand_ins = {path.parent.name: path.parent for path in manifests(suite / "common/stand_ins")}
    installed = [*manifests(suite), *share.glob("*/package.xml")]
    known = {*own, *(path.parent.name for path in installed)}
    complaints = []
    for name in sorted(set(own) & set(stand_ins)):
        theirs = stand_ins[name].glob("launch/*.launch")
        files = [own[name] / "launch" / file.name for file in theirs]
        texts = [file.read_text(errors="replace") for file in files if file.is_file()]
        pairs = NAMED.findall(re.sub("(?s)<!--.*?-->", "", "".join(texts)))
        missing = {package for pair in pairs for package in pair if package} - known
        if missing:
            needed = f"needs {', '.join(sorted(missing))}, which is not installed"
            seen = f"{own[name]} hides the suite's own {name}, and {needed}"
            complaints.append((seen, f"touch {own[name]}/CATKIN_IGNORE"))
    return complaints
