"""The recording of a program that was started and sent Joys."""

from __future__ import annotations

import statistics
from dataclasses import dataclass, field
from typing import Dict, Optional, Tuple

from tutorial_check import Ran, Topics, has_error

from ..task import HANDOUT, Joy, JoystickTask
from . import joys
from .evidence import FIELDS, Evidence
from .replies import Replies, Silence

SOON_S = 0.05  # from Joy to Twist
NAP_S = 0.3  # for a Twist: a correct program never takes this long

Twist = Tuple[float, ...]
JoySample = Tuple[Tuple[float, ...], Twist]


@dataclass(frozen=True)
class Connections:
    """A program's connections in the graph."""

    connected: bool = False
    publishers: Topics = field(default_factory=dict)
    subscribers: Topics = field(default_factory=dict)
    types: Dict[str, str] = field(default_factory=dict)
    warnings: Tuple[str, ...] = ()
    master_alive: bool = True


@dataclass(frozen=True)
class NumberedJoys:
    """Its answers to the numbered Joys, sent one at a time."""

    sent: int = 0
    samples: Tuple[JoySample, ...] = ()
    first_samples: Tuple[JoySample, ...] = ()  # from an earlier pass
    missing: int = 0
    extra: int = 0  # Twists in addition to the answers
    came: int = 0  # all Twists
    waits: Tuple[float, ...] = ()  # [s] from a Joy to the next Twist
    at_rest: Optional[Twist] = None  # the answer to a Joy at rest
    twists: Tuple[Twist, ...] = ()  # all Twists of the second pass
    has_clock: bool = False  # Twists come without a Joy
    repeats: bool = False  # and they move the robot
    displayed: int = 0  # number of Joys that it displayed

    @property
    def all_displayed(self) -> bool:
        return self.displayed >= min(5, max(1, self.sent))


@dataclass(frozen=True)
class Probes:
    """Its answers to the probes."""

    answers: Tuple[Tuple[Joy, Twist], ...] = ()
    unanswered: Optional[Tuple[Joy, Joy]] = None  # (Joy without a Twist, the Joy before it)


@dataclass(frozen=True)
class Stream:
    """Its answers to a stream of Joys."""

    sent: int = 0
    answered: int = 0
    stray_zeros: int = 0  # between the answers
    delays: Tuple[float, ...] = ()
    possible: Optional[int] = None  # the answers of our Echo to the same stream
    unavoidable_s: Optional[float] = None

    @property
    def delay_s(self) -> float | None:
        return statistics.median(self.delays) if self.delays else None

    def is_prompt(self, enough: float) -> bool:
        """Return whether enough Joys were answered in time, as far as the machine allows."""
        if self.answered < enough * min(self.sent, self.possible or self.sent):
            return False
        return self.delay_s is None or self.delay_s < SOON_S + (self.unavoidable_s or 0.0)


@dataclass(frozen=True)
class Ending:
    """How it ended."""

    early: bool = False  # before Ctrl-C
    output: str = ""  # until Ctrl-C
    taken_s: Optional[float] = None  # after Ctrl-C; None: it was killed
    last_words: str = ""


@dataclass(frozen=True)
class Joy2TwistRun:
    """A program that was sent Joys, with the axes and buttons of the handout's task."""

    script: str
    program: Ran = Ran("", "", None, False, False)  # noqa: RUF009  frozen
    sleep_lines: Tuple[int, ...] = ()  # in a callback
    enough: float = 0.95  # share of a stream's Joys that it must answer
    factors: Dict[str, float] = field(default_factory=dict)  # {name of a field: factor}
    needs_button: bool = False
    connections: Connections = Connections()
    numbered: NumberedJoys = NumberedJoys()
    probes: Probes = Probes()
    stream: Stream = Stream()
    ending: Ending = Ending()

    def evidence(self, task: JoystickTask = HANDOUT) -> Evidence:
        """Return the evidence in the answers to the numbered Joys. task: for names."""
        seen, given = self.numbered, self.factors
        factors = {index: given[name] for index, name in enumerate(FIELDS) if name in given}
        return Evidence([*seen.samples], [*seen.first_samples], seen.at_rest, factors, task)

    def replies(self, task: JoystickTask = HANDOUT) -> Replies:
        return Replies(self.evidence(task), self.probes.answers, self.needs_button)

    def silence(self, task: JoystickTask) -> Silence | None:
        """Return the first probe without an answer, or None."""
        joys_sent, answers = self.probes.unanswered, self.probes.answers
        last = answers[-1][1] if answers else (1.0,)
        return Silence(*joys_sent, last, task) if joys_sent else None

    @property
    def is_prompt(self) -> bool:
        return self.stream.is_prompt(self.enough)

    @property
    def naps(self) -> bool:
        """Whether its callback sleeps so long that each Joy waits for the one before."""
        waits = self.numbered.waits
        is_slow = len(waits) > 2 and statistics.median(waits[:5]) > NAP_S
        return bool(self.sleep_lines) and is_slow

    @property
    def displays_numbers(self) -> bool:
        """Whether it prints a line with as many numbers as a Joy has axes."""
        lines = self.ending.output.splitlines()
        return any(len(joys.NUMBER.findall(line)) >= 6 for line in lines)

    @property
    def has_traceback(self) -> bool:
        """Whether it printed the error of a program that fails, in any language."""
        return has_error(self.ending.output)
