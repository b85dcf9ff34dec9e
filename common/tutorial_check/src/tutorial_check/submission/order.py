"""What a launcher and its worker send each other, as frozen data: an order, questions, replies."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Dict, Optional, Tuple

from tutorial_check.course.definition import HANDOUT
from tutorial_check.course.tasks import Variant
from tutorial_check.errors import CutShort
from tutorial_check.submission.packages import Layout

VERSION = 2  # raised by each change of recordings that an older check could not read


@dataclass(frozen=True)
class Order:
    """One workspace to be checked. What follows the variant is from launcher.prepared()."""

    workspace: Path  # or a zip
    underlay: str  # setup.bash of the devel space with what students use and never write
    exercises: Tuple[str, ...]
    only_first: bool = False  # end at the first check that is wrong
    is_callers_own: bool = True  # its links may lead into the home folder
    course: Path = HANDOUT
    variant: Variant = field(default_factory=dict)  # The student's task names it.
    folder: Path = Path()  # for this order alone; the copy of the workspace is in it
    layout: Layout = field(default_factory=Layout)  # Messages name places as they were handed in.
    environment: Dict[str, str] = field(default_factory=dict)  # A shell with the underlay has it.
    readable: Tuple[Path, ...] = ()  # what the student's programs may read
    in_namespaces: bool = False  # in namespaces of its own, by bubblewrap


@dataclass(frozen=True)
class Question:
    """What is to be recorded."""

    recorder: str  # MODULE:NAME
    arguments: Tuple[Any, ...] = ()  # JSON


@dataclass(frozen=True)
class Reply:
    """What was recorded, or why nothing was; without these a worker has started."""

    recording: Any = None  # a dataclass; JSON where it arrives
    cut_short: Optional[CutShort] = None
    cannot: Optional[str] = None
    busy: bool = False  # the machine kept programs waiting: a late answer proves little
    overloaded: bool = False  # it proves nothing
    version: int = VERSION


Ask = Callable[[Question], Reply]  # the worker, for those who ask it
