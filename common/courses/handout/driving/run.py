"""What came of starting a program and sending it Joy messages. Pure."""

from __future__ import annotations

import statistics
from dataclasses import dataclass, field, replace
from typing import Dict, Optional, Tuple

from tutorial_check import Ran, Topics

from ..task import HANDOUT, Joy, JoystickTask
from . import probes
from .evidence import FIELDS, Evidence
from .rules import judge

SOON_S = 0.05  # from Joy to Twist
NAP_S = 0.3  # for one Twist: a correct program never takes this long

Twist = Tuple[float, ...]
Sample = Tuple[Tuple[float, ...], Twist]


@dataclass(frozen=True)
class Asked:
    """A program, and what its text and the task say."""

    script: str
    program: Ran = Ran("", "", None, False, False)  # noqa: RUF009  frozen
    sleep_lines: Tuple[int, ...] = ()  # in a callback
    enough: float = 0.95  # so many of the Joys of a stream have to be answered
    factors: Dict[str, float] = field(default_factory=dict)  # by the name of the field
    needs_button: bool = False


@dataclass(frozen=True)
class Graph:
    """Where it is in the graph."""

    connected: bool = False
    publishers: Topics = field(default_factory=dict)
    subscribers: Topics = field(default_factory=dict)
    types: Dict[str, str] = field(default_factory=dict)
    warnings: Tuple[str, ...] = ()
    master_alive: bool = True


@dataclass(frozen=True)
class Numbered:
    """The numbered Joys, one at a time."""

    asked: int = 0
    samples: Tuple[Sample, ...] = ()
    first_samples: Tuple[Sample, ...] = ()  # from an earlier pass
    missing: int = 0
    unasked: int = 0
    came: int = 0  # for the numbered Joys
    waits: Tuple[float, ...] = ()  # [s] from a Joy to the next Twist
    at_rest: Optional[Twist] = None  # the answer to a Joy at rest
    twists: Tuple[Twist, ...] = ()  # all of the second pass
    has_clock: bool = False  # more come unasked
    repeats: bool = False  # and move the robot
    shown: int = 0  # how many Joys were displayed

    @property
    def all_shown(self) -> bool:
        return self.shown >= min(5, max(1, self.asked))


@dataclass(frozen=True)
class Streamed:
    """The stream of Joys."""

    sent: int = 0
    answered: int = 0
    strays: int = 0  # zeros between the answers
    delays: Tuple[float, ...] = ()
    possible: Optional[int] = None  # what our own Echo answered beside it
    unavoidable_s: Optional[float] = None

    @property
    def delay_s(self) -> float | None:
        return statistics.median(self.delays) if self.delays else None

    @property
    def rate(self) -> str:
        late = f", {1000 * self.delay_s:.1f} ms late" if self.delay_s is not None else ""
        return f"{self.answered} Twists for {self.sent} Joys{late}"


@dataclass(frozen=True)
class Drive(Streamed, Numbered, Graph, Asked):
    """A recording; Joys have the axes and buttons of the handout's task."""

    # The probes.
    answers: Tuple[Tuple[Joy, Twist], ...] = ()
    unanswered: Optional[Tuple[Joy, Joy]] = None  # (Joy, the one before) without a Twist
    # The end.
    ended_early: bool = False
    output: str = ""  # before Ctrl-C
    taken_s: Optional[float] = None  # to the end; None: it was killed
    last_words: str = ""

    @property
    def evidence(self) -> Evidence:
        given = self.factors
        factors = {index: given[name] for index, name in enumerate(FIELDS) if name in given}
        return Evidence(list(self.samples), list(self.first_samples), self.at_rest, factors)

    @property
    def complaint(self) -> str:
        """What is odd about the answers to the numbered Joys; empty if nothing is."""
        return judge(self.evidence)[0]

    def judge_probes(self, task: JoystickTask = HANDOUT) -> tuple[str, str]:
        """Return (what is wrong with the answers to the probes, what to do); empty if nothing."""
        evidence = replace(self.evidence, task=task)
        return probes.judge_probes(evidence, self.answers, self.needs_button)

    def silence(self, task: JoystickTask) -> probes.Silence | None:
        """Return the first probe that was not answered."""
        last = self.answers[-1][1] if self.answers else (1.0,)
        return probes.Silence(*self.unanswered, last, task) if self.unanswered else None

    @property
    def is_prompt(self) -> bool:
        """Whether enough Joys were answered, and soon, as far as the machine allows."""
        if self.answered < self.enough * min(self.sent, self.possible or self.sent):
            return False
        return self.delay_s is None or self.delay_s < SOON_S + (self.unavoidable_s or 0.0)

    @property
    def naps(self) -> bool:
        """Whether its callback sleeps, and so long that each Joy waits for the one before."""
        is_slow = len(self.waits) > 2 and statistics.median(self.waits[:5]) > NAP_S
        return bool(self.sleep_lines) and is_slow

    @property
    def shows_numbers(self) -> bool:
        """Whether it prints lines with as many numbers as a Joy has axes."""
        return any(len(probes.NUMBER.findall(line)) >= 6 for line in self.output.splitlines())

    @property
    def trouble(self) -> bool:
        return "Traceback (most recent call last)" in self.output
