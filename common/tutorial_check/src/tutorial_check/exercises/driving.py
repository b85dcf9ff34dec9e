"""One program that turns Joy into Twist, driven over its topics; what was seen, without a verdict."""

from __future__ import annotations

import re
import statistics
import time
from typing import Any, Callable, Sequence

from tutorial_check.box import GRACE_S
from tutorial_check.exercises import probing
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.exercises.mapping import LINEAR, RIGHT, Evidence, judge, rule_of
from tutorial_check.session import Session
from tutorial_check.stage import START_S

JOY, CMD_VEL = "/joy", "/cmd_vel"
COUNT = 20
RATE, STREAM_S = 50.0, 2.5
NEUTRAL = ((0.0,) * 6, (0,) * 12)
RATED = frozenset(["4.3", "6.2"])  # the exercises that look at the rate
SOON_S = 0.05  # from Joy to Twist
ANSWER_S = 1.0  # for one Twist, before it counts as missing
SETTLE_S = 0.15  # after it, in which more of them may come
QUIET_S = 0.25  # without a Joy, or longer for a slow one: a clock of its own makes itself heard
SAME_S = 0.06  # in which several Twists answer one Joy
NAP_S = 0.3  # for one Twist: a correct program never takes this long
COLOUR = re.compile(r"\x1b\[[0-9;]*m")


class Drive:
    """What came of starting a program and sending it Joy messages."""

    def __init__(self, session: Session, script: str, wants_twist: bool = True) -> None:
        self.session, self.script, self._task = session, script, session.task
        self.samples: list[Any] = []
        self.first_samples: list[Any] = []  # of an earlier pass
        self.missing = self.unasked = self.shown = self.asked = 0
        self.sent = self.answered = self.strays = self.came = 0  # came: for the numbered Joys
        self.delays: list[float] = []
        self.at_rest: Any = None  # the answer to a Joy at rest
        self.waits: list[float] = []  # [s] from a Joy to the next Twist, one at a time
        self.twists: list[Any] = []  # all of the second pass
        self.has_clock = self.repeats = False  # whether more come unasked; and move the robot
        self.answers: list[Any] = []  # of the probes
        self.unanswered: Any = None  # (Joy, one before) without a Twist
        facts = session.scripts(PACKAGE).get(script)
        self.sleep_lines = facts.called_back.get("sleep", []) if facts else []
        # A queue of one drops what it has no time for, and the newest value is not late.
        drops = facts and facts.keeps_newest and not self.sleep_lines
        self.enough = 0.5 if drops else 0.95  # of the Joys of a stream answered
        self.possible: int | None = None
        self.unavoidable_s: float | None = None  # what our own Echo answered beside it
        with session.stage() as stage:
            self._stage = stage
            stage.call("advertise", JOY, "Joy")
            stage.call("listen", CMD_VEL, "Twist")
            self.program = stage.start(PACKAGE, script)
            stage.wait_for_start(lambda: stage.call("listeners", JOY) or self.program.ended)
            self.connected = bool(stage.call("listeners", JOY)) and not self.program.ended
            if self.connected and wants_twist:
                self._wait(lambda: stage.call("speakers", CMD_VEL), 1.5)
            self.publishers, self.subscribers = stage.call("state")
            if self.connected:
                self._converse(wants_twist)
            self.ended_early = self.program.ended
            publishers, _ = stage.call("state") if stage.master_lives else ({}, {})
            self.publishers = {**self.publishers, **publishers}
            self.types, self.warnings = stage.call("types"), stage.call("warnings")
            self.output = self.program.output
            self.master_alive = stage.master_lives
            # Only where its end is asked for it is waited for.
            grace_s = GRACE_S if "4.3" in session.exercises else 0.5
            self.taken_s = session.box.end(self.program, grace_s)
            self.last_words = self.program.output[len(self.output) :]

    def _wait(self, condition: Callable[[], Any], longest_s: float) -> None:
        self._stage.wait(lambda: self.program.ended or condition(), longest_s)

    def _pause(self, longest_s: float) -> None:
        self._wait(lambda: False, longest_s)

    def _count(self) -> int:
        return self._stage.call("count", CMD_VEL)

    def _heard(self, since: int) -> list[Any]:
        return self._stage.call("heard", CMD_VEL, since)

    def _converse(self, wants_twist: bool) -> None:
        stage, joys = self._stage, probing.numbered_joys(COUNT)
        self.joys = joys
        stage.call("send", JOY, NEUTRAL)
        if wants_twist:
            stage.wait(self._count, 0.5)
            self._one_by_one(joys, 0.0)
            doubtful = self.unasked > 2 or (self.samples and self.complaint)
            if doubtful and not self.naps:
                self._ask_again(joys)
            if len(self.samples) > COUNT / 2 and not self.naps:
                self._keep_quiet()
                if self.has_clock and not self.repeats and not self.twists:
                    self._ask_again(joys)  # zeros by a watchdog, or between all answers
                if not self.repeats and not self.complaint:
                    self._probe(joys)
        else:
            for joy in joys:
                stage.call("send", JOY, self._task.joy(joy))
            self.asked = COUNT
        self._wait(lambda: self._displayed() >= min(5, self.asked), 0.7)
        self.shown = self._displayed()
        goes = self.answers and not self.unanswered
        goes = goes and not self.judge_probes()[0]
        if goes and RATED & self.session.exercises and not self.program.ended:
            self._stream()
            if not self.is_prompt and not self.program.ended:
                before = stage.call("listeners", JOY)
                echo, answers = stage.echo(self._task.axes[RIGHT[LINEAR]])
                stage.call("listen", answers, "Twist")
                stage.wait(
                    lambda: echo.call("ready") and stage.call("listeners", JOY) > before, START_S
                )
                self._stream(beside=answers)

    def _ask_again(self, joys: Sequence[probing.Joy]) -> None:
        """Ask the same with time: it has a clock of its own, publishes several, or is only slow."""
        is_plain = self.unasked <= 2
        low = [] if self.missing else probing.low_joys()
        first, self.samples, self.missing = self.samples, [], 0
        self._pause(SETTLE_S)  # late ones belong to the first pass
        begun = self._count()
        self._one_by_one([*joys, *low], SETTLE_S)
        self.twists = [twist for _, _, twist in self._heard(begun)]
        if len(self.samples) < len(first):
            first, self.samples = self.samples, first
        # Of several Twists for one Joy it is not known which of them answers it.
        self.first_samples = first if is_plain else []
        heard = self._ask(probing.AT_REST, SETTLE_S)[1]
        self.at_rest = heard[-1][2] if heard else None
        self._ask(joys[-1], SETTLE_S)  # the last one moves the robot

    def _keep_quiet(self) -> None:
        """See whether Twists come without a Joy. The last one moves the robot."""
        begun_s, before = time.monotonic(), self._count()
        self._pause(max(QUIET_S, 2.5 * min(ANSWER_S, statistics.median(self.waits))))
        unasked = self._heard(before)
        self.has_clock = len(unasked) > 1
        late = [twist for when, _, twist in unasked if when > begun_s + SAME_S]
        self.repeats = self.has_clock and any(map(any, late))

    def _probe(self, joys: Sequence[probing.Joy]) -> None:
        """Send the other Joys, each until it is answered; end at one that is not when asked again."""
        before, settle_s = joys[-1], SETTLE_S if self.twists else 0.0
        # By now it is known how many Twists one Joy gets: no time is needed to wait for more.
        times = max(1, round(len(self.twists) / len(self.samples)))
        plan = [(joy, settle_s, 1) for joy in probing.probes(joys)]
        plan += [(joy, 0.0, times) for joy in probing.small_and_button_probes()]
        for joy, wait_s, often in plan:
            _, heard = self._ask(joy, wait_s, often)
            if not heard and not self.program.ended:
                self._ask(before, wait_s, often)
                _, heard = self._ask(joy, wait_s, often)
            if not heard:
                self.unanswered = joy, before
                return
            self.answers.append((joy, heard[-1 if settle_s else 0][2]))
            before = joy

    def _ask(
        self, joy: probing.Joy, settle_s: float, often: int = 1, longest_s: float = ANSWER_S
    ) -> tuple[float, list[Any]]:
        """Return (when a Joy was sent, what came then). often: how many Twists are waited for."""
        before = self._count()
        sent_s = self._stage.call("send", JOY, self._task.joy(joy))
        self._wait(lambda: self._count() - before >= often, longest_s if often == 1 else SETTLE_S)
        if settle_s:
            self._pause(settle_s)
        return sent_s, self._heard(before)

    def _one_by_one(self, joys: Sequence[probing.Joy], settle_s: float) -> None:
        begun, answered, unanswered = self._count(), len(self.samples), 0
        for joy in joys:
            sent_s, heard = self._ask(joy, settle_s)
            self.asked += 1
            self.waits.append(heard[0][0] - sent_s if heard else ANSWER_S)
            if heard:
                self.samples.append((joy[0], heard[-1][2] if settle_s else heard[0][2]))
            else:
                self.missing += 1
                unanswered += 1
            if unanswered == 3 or self.program.ended or self.naps:
                break
        answered = len(self.samples) - answered
        # Also those that came between an answer and the next Joy.
        self.unasked += self._count() - begun - answered
        if unanswered == 3 and not self.program.ended and not self.naps:
            # The rest without much patience, to see how many of all are answered.
            for joy in joys[answered + unanswered :]:
                self._ask(joy, 0.0, longest_s=SAME_S)
        self.came = self._count() - begun

    def _stream(self, beside: str | None = None) -> None:
        stage, count = self._stage, int(RATE * STREAM_S)
        before = self._count()
        joys = [self._task.joy(joy) for joy in probing.rising_joys(count)]
        stage.call("stream", JOY, joys, RATE, False)
        stage.wait(lambda: len(stage.call("sent", JOY)) >= count, STREAM_S + 3)
        stage.wait(lambda: self._count() - before >= count, 0.3)
        sent, heard = stage.call("sent", JOY), self._heard(before)
        self.sent, self.answered = len(sent), len(heard)
        rule = rule_of(LINEAR, self.samples)
        self.delays = probing.delays(sent, heard, rule.factor if rule else None)
        moving = [any(twist) for _, _, twist in heard]
        # All of these Joys move the robot, once the first does.
        self.strays = moving[moving.index(True) :].count(False) if any(moving) else 0
        if beside:
            echoed, sign = stage.call("heard", beside), self._task.signs[RIGHT[LINEAR]]
            self.possible = len(echoed)
            self.unavoidable_s = statistics.median(probing.delays(sent, echoed, sign) or [0.0])

    @property
    def evidence(self) -> Evidence:
        return Evidence(self.samples, self.first_samples, self.at_rest, self._task.factors)

    def judge_probes(self) -> tuple[str, str]:
        """Return what is wrong with the answers to the probes, and what to do; empty if nothing is."""
        about = self._task.factors, self._task.needs_button
        return probing.judge_probes(self.samples, self.answers, *about)

    @property
    def complaint(self) -> str:
        """What is odd about the answers to the numbered Joys; empty if nothing is."""
        return judge(self.evidence)[0]

    @property
    def silence(self) -> tuple[str, str]:
        """Return (what is seen, what to do) for the first probe that was not answered."""
        joy, before = self.unanswered
        return probing.silence(joy, before, self.answers[-1][1] if self.answers else (1.0,))

    @property
    def delay_s(self) -> float | None:
        return statistics.median(self.delays) if self.delays else None

    @property
    def rate(self) -> str:
        late = f", {1000 * self.delay_s:.1f} ms late" if self.delay_s is not None else ""
        return f"{self.answered} Twists for {self.sent} Joys{late}"

    @property
    def is_prompt(self) -> bool:
        """Return whether enough Joys were answered, and soon, as far as the machine allows."""
        if self.answered < self.enough * min(self.sent, self.possible or self.sent):
            return False
        return self.delay_s is None or self.delay_s < SOON_S + (self.unavoidable_s or 0.0)

    @property
    def naps(self) -> bool:
        """Return whether its callback sleeps, and so long that each Joy waits for the one before."""
        is_slow = len(self.waits) > 2 and statistics.median(self.waits[:5]) > NAP_S
        return bool(self.sleep_lines) and is_slow

    @property
    def all_shown(self) -> bool:
        return self.shown >= min(5, max(1, self.asked))

    @property
    def shows_numbers(self) -> bool:
        """Return whether it prints lines with as many numbers as a Joy has axes."""
        return any(len(probing.NUMBER.findall(line)) >= 6 for line in self.output.splitlines())

    @property
    def trouble(self) -> bool:
        return "Traceback (most recent call last)" in self.output

    def _displayed(self) -> int:
        """Return how many of the Joys were displayed, all six axes in a line."""
        joys = [*map(self._task.joy, self.joys)]
        return len(probing.displayed(joys, COLOUR.sub("", self.program.output)))


def drive(session: Session, script: str, wants_twist: bool = True) -> Drive:
    """Return the Drive of a script; made once."""
    return session.run(("drive", script, wants_twist), lambda: Drive(session, script, wants_twist))
