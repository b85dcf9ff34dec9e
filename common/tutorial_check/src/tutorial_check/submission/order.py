"""What a launcher and its worker send each other: an order, questions, replies."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Tuple

from tutorial_check.course.definition import HANDOUT
from tutorial_check.course.tasks import Variant
from tutorial_check.errors import CutShort
from tutorial_check.submission.packages import Layout

VERSION = 3  # increased by each change that an older check could not read


@dataclass(frozen=True)
class Sandbox:
    """What the student's programs get of this machine."""

    environment: Dict[str, str] = field(default_factory=dict)  # of the underlay
    readable: Tuple[Path, ...] = ()  # what they may read
    in_namespaces: bool = False  # isolated by bubblewrap


@dataclass(frozen=True)
class Order:
    """A workspace to check. launcher.prepared() sets the fields after the variant."""

    workspace: Path  # or a zip
    underlay: str  # setup.bash of the underlay's devel space
    exercises: Tuple[str, ...]
    only_first: bool = False  # stop at the first wrong check
    is_callers_own: bool = True  # its links may lead into the home folder
    course: Path = HANDOUT
    variant: Variant = field(default_factory=dict)  # of the student's task
    language: str = ""  # of the programs; "": the course's
    folder: Path = Path()  # for this order only, with the copy of the workspace
    layout: Layout = field(default_factory=Layout)  # messages name its paths
    sandbox: Sandbox = Sandbox()


@dataclass(frozen=True)
class Question:
    """A request for a recording."""

    recorder: str  # MODULE:NAME
    arguments: Tuple[Any, ...] = ()  # JSON


@dataclass(frozen=True)
class Reply:
    """A recording, or why there is none; with neither, the worker is ready."""

    recording: Any = None  # a dataclass; JSON at the receiver
    cut_short: Optional[CutShort] = None
    cannot: Optional[str] = None
    busy: bool = False  # the machine kept programs waiting: a late answer proves little
    overloaded: bool = False  # it proves nothing
    version: int = VERSION


Ask = Callable[[Question], Reply]  # asks a worker
