"""What the launcher asks of the worker."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Tuple

from tutorial_check.source.workspace import Layout

Variant = Dict[str, Any]  # {name of a value: what it is}; what is not named is as the course has it
Line = Dict[str, Any]  # of JSON, between the two


@dataclass(frozen=True)
class Order:
    """One workspace to be checked. Paths are whole."""

    folder: Path  # for this order alone; the copy of the workspace is in it
    layout: Layout  # of the workspace as it was handed in
    own: bool  # the caller's own workspace
    exercises: Tuple[str, ...]
    only_first: bool  # end at the first check that is wrong
    course: Path
    variant: Variant  # of the student
    underlay: str  # its setup.bash
    environment: Dict[str, str]  # as in a shell that has sourced it
    kept: Tuple[Path, ...]  # what the student's programs need of the suite
    shown: Tuple[Path, ...]  # what they may read
    apart: bool = False  # in namespaces of its own, by bubblewrap
