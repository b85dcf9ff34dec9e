"""What the launcher asks of the worker."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Tuple


@dataclass(frozen=True)
class Order:
    """One workspace to be checked. Paths are whole."""

    folder: str  # for this order alone; the copy of the workspace is in it
    root: str  # the workspace as it was handed in
    source: str  # its src
    place: str  # root within what was handed in, if another folder
    is_workspace: bool  # not only packages
    own: bool  # the caller's own workspace
    exercises: Tuple[str, ...]
    only_first: bool  # end at the first check that is wrong
    course: str  # its folder
    variant: Dict[str, Any]  # the values of the student's task
    underlay: str  # its setup.bash
    environment: Dict[str, str]  # as in a shell that has sourced it
    kept: Tuple[str, ...]  # what the student's programs need of the suite
    shown: Tuple[str, ...]  # what they may read
    apart: bool = False  # in namespaces of its own, by bubblewrap
