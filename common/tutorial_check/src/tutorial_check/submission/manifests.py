"""The package.xml files of a workspace: a broken one stops the other packages, too."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

from node_kit.manifests import broken_manifests
from tutorial_check.submission.packages import Package

# A student's src may have the real packages.
STAND_INS = Path(__file__).resolve().parents[5] / "common/stand_ins"


def is_stand_in(name: str) -> bool:
    """Return whether the suite has a stand-in for a package of that name."""
    return (STAND_INS / name / "package.xml").is_file()


def first_broken(source: Path, packages: Sequence[Package]) -> Package | None:
    """Return the first package below src whose package.xml is no XML, or None. No node starts then.

    rospy first reads every package.xml, even in hidden folders, which catkin skips.
    """
    broken = broken_manifests(source)
    if not broken:
        return None
    path, complaint = broken[0]
    inside = os.path.relpath(os.path.dirname(path), source)
    hidden = Package(source / inside, inside, error=complaint, malformed=True)
    return next((package for package in packages if package.inside == inside), hidden)
