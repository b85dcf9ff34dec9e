"""Every package.xml of the workspace: a fault in one stops the other packages, too."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

from node_kit.manifests import broken_manifests
from tutorial_check.submission.packages import Package

# The real ones may well be in a student's src.
STAND_INS = Path(__file__).resolve().parents[5] / "common/stand_ins"


def is_stand_in(name: str) -> bool:
    """Return whether the suite's package of that name stands in for the one that Debian lacks."""
    return (STAND_INS / name / "package.xml").is_file()


def first_broken(source: Path, packages: Sequence[Package]) -> Package | None:
    """Return the first package below src whose package.xml is no XML, or None: no node starts then.

    rospy reads every package.xml first, also in a hidden folder, where catkin sees no package.
    """
    broken = broken_manifests(source)
    if not broken:
        return None
    path, complaint = broken[0]
    inside = os.path.relpath(os.path.dirname(path), source)
    hidden = Package(source / inside, inside, error=complaint, malformed=True)
    return next((package for package in packages if package.inside == inside), hidden)
