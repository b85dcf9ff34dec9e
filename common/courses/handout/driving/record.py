"""Section 4.3: a recorder that sends Joys to a program."""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass, replace
from typing import Any, Callable, Sequence

from tutorial_check import GRACE_S, START_S, RosSession, Workspace

from ..task import CMD_VEL, JOY, NEUTRAL, PACKAGE, Joy
from . import joys as sent_joys
from .evidence import FIELDS, LINEAR, RIGHT, rule_of
from .joy2twist_run import Connections, Ending, Joy2TwistRun, NumberedJoys, Stream
from .joys import COUNT

RATE, STREAM_S = 50.0, 2.5
RATED = frozenset(["4.3", "6.2"])  # the exercises that check the rate
ANSWER_S = 1.0  # then a Twist counts as missing
SETTLE_S = 0.15  # after a Twist, for more of them
QUIET_S = 0.25  # without a Joy, or longer for a slow program, to reveal a clock
REST_S = 0.5  # for a Twist at rest; not every program sends one
SAME_S = 0.06  # Twists this close answer the same Joy


@dataclass(frozen=True)
class KnownPackage:
    """Whether rospack finds a package."""

    is_known: bool


def drive(
    workspace: Workspace, script: str, wants_twist: bool = True, text: str = ""
) -> Joy2TwistRun:
    """Start a program and send it Joys. text: replaces the program's."""
    if text:
        script = workspace.sibling(PACKAGE, script, text)
    with workspace.ros_session() as ros:
        return _Conversation(workspace, ros, script).drive(wants_twist)


def known_package(workspace: Workspace, package: str) -> KnownPackage:
    program = workspace.runner.start(["rospack", "find", package], workspace.environment)
    workspace.runner.wait(lambda: program.ended, 10.0)
    return KnownPackage(not program.process.returncode)


def rest(ros: RosSession, *topics: str, joys: str = JOY) -> None:
    """Send Joys at rest until a Twist comes, or for a while: some programs drive only after it."""
    ros.peer.stream(joys, [NEUTRAL], 20.0, True)
    ros.wait(lambda: any(ros.peer.count(topic) for topic in topics), REST_S)
    ros.peer.end_stream(joys)


class _Conversation:
    """Sends Joys to a program, and chooses the next ones by its answers."""

    def __init__(self, workspace: Workspace, ros: RosSession, script: str) -> None:
        self._workspace, self._ros, self._task = workspace, ros, workspace.task
        facts = workspace.facts_of(PACKAGE, script)
        sleeps = tuple(facts.called_back.get("sleep", [])) if facts else ()
        # A queue of one drops messages, so the newest value is not late.
        drops = facts and facts.keeps_newest and not sleeps
        self._run = Joy2TwistRun(
            script,
            sleep_lines=sleeps,
            enough=0.5 if drops else 0.95,
            factors={FIELDS[index]: factor for index, factor in self._task.factors.items()},
            needs_button=self._task.needs_button,
        )
        ros.peer.advertise(JOY, "Joy")
        ros.peer.listen(CMD_VEL, "Twist")
        self._program = ros.start(PACKAGE, script)

    @property
    def _seen(self) -> NumberedJoys:
        return self._run.numbered

    def _note(self, **changes: Any) -> None:
        self._run = replace(self._run, numbered=replace(self._seen, **changes))

    def drive(self, wants_twist: bool) -> Joy2TwistRun:
        ros, program = self._ros, self._program
        ros.wait_for_start(lambda: ros.peer.listeners(JOY) or program.ended)
        connected = bool(ros.peer.listeners(JOY)) and not program.ended
        if connected and wants_twist:
            self._wait(1.5, lambda: ros.peer.publishers(CMD_VEL))
        publishers, subscribers = ros.peer.state()
        if connected:
            self._converse(wants_twist)
        ended_early = program.ended
        late, _ = ros.peer.state() if ros.master_lives else ({}, {})
        output, master_alive = program.output, ros.master_lives
        types, warnings = ros.peer.types(), tuple(ros.peer.warnings())
        # Wait for its end only if an exercise checks it.
        grace_s = GRACE_S if "4.3" in self._workspace.order.exercises else 0.5
        taken_s = self._workspace.runner.end(program, grace_s)
        topics = {**publishers, **late}
        return replace(
            self._run,
            program=program.ran,
            connections=Connections(connected, topics, subscribers, types, warnings, master_alive),
            ending=Ending(ended_early, output, taken_s, program.output[len(output) :]),
        )

    def _wait(self, longest_s: float, condition: Callable[[], Any] = lambda: False) -> None:
        self._ros.wait(lambda: self._program.ended or condition(), longest_s)

    def _count(self) -> int:
        return int(self._ros.peer.count(CMD_VEL))

    def _received(self, since: int) -> list[Any]:
        return list(self._ros.peer.received(CMD_VEL, since))

    def _converse(self, wants_twist: bool) -> None:
        ros, joys = self._ros, sent_joys.numbered_joys()
        ros.peer.send(JOY, NEUTRAL)
        if wants_twist:
            ros.wait(self._count, 0.5)
            self._ask_numbered(joys)
        else:
            for joy in joys:
                ros.peer.send(JOY, self._task.joy(joy))
            self._note(sent=COUNT)
        sent = [*map(self._task.joy, joys)]

        def displayed() -> int:
            """Return how many Joys were displayed, with all six axes in a line."""
            return len(sent_joys.displayed(sent, self._program.output))

        self._wait(0.7, lambda: displayed() >= min(5, self._seen.sent))
        self._note(displayed=displayed())
        probes, is_rated = self._run.probes, RATED.intersection(self._workspace.order.exercises)
        goes = probes.answers and not probes.unanswered and self._run.replies().is_right
        if goes and is_rated and not self._program.ended:
            for beside_ours in (False, True):
                stream = _stream(self._workspace, ros, self._run, beside_ours)
                self._run = replace(self._run, stream=stream)
                if self._run.is_prompt or self._program.ended:
                    break

    def _ask_numbered(self, joys: Sequence[Joy]) -> None:
        self._one_by_one(joys, 0.0)
        seen = self._seen
        doubtful = seen.extra > 2 or (seen.samples and not self._run.evidence().is_right)
        if doubtful and not self._run.naps:
            self._ask_again(joys)
        if len(self._seen.samples) > COUNT / 2 and not self._run.naps:
            self._keep_quiet()
            seen = self._seen
            if seen.has_clock and not seen.repeats and not seen.twists:
                self._ask_again(joys)  # zeros from a watchdog, or between all answers
            if not self._seen.repeats and self._run.evidence().is_right:
                self._probe(joys)

    def _ask_again(self, joys: Sequence[Joy]) -> None:
        """Repeat the Joys slowly: it has a clock, publishes several Twists, or is only slow."""
        is_plain = self._seen.extra <= 2
        low = [] if self._seen.missing else sent_joys.low_joys()
        first = self._seen.samples
        self._note(samples=(), missing=0)
        self._wait(SETTLE_S)  # late Twists belong to the first pass
        before = self._count()
        self._one_by_one([*joys, *low], SETTLE_S)
        twists = tuple(twist for _, _, twist in self._received(before))
        if len(self._seen.samples) < len(first):
            again, first = first, self._seen.samples
            self._note(samples=again)
        # If a Joy gets several Twists, it is unknown which is the answer.
        self._note(twists=twists, first_samples=first if is_plain else ())
        received = self._ask(sent_joys.AT_REST, SETTLE_S)[1]
        self._note(at_rest=received[-1][2] if received else None)
        self._ask(joys[-1], SETTLE_S)  # so that the last Joy moves the robot

    def _keep_quiet(self) -> None:
        """Note whether Twists come without a Joy, after one that moves the robot."""
        begun_s, before = time.monotonic(), self._count()
        usual_s = statistics.median(self._seen.waits)
        self._wait(max(QUIET_S, 2.5 * min(ANSWER_S, usual_s)))
        extra = self._received(before)
        has_clock = len(extra) > 1
        late = [twist for when, _, twist in extra if when > begun_s + SAME_S]
        self._note(has_clock=has_clock, repeats=has_clock and any(map(any, late)))

    def _probe(self, joys: Sequence[Joy]) -> None:
        """Send the probes, each until it is answered; stop at one that is not in two tries."""
        seen = self._seen
        before, settle_s = joys[-1], SETTLE_S if seen.twists else 0.0
        # The number of Twists for a Joy is now known, so there is no need to wait for more.
        times = max(1, round(len(seen.twists) / len(seen.samples)))
        plan = [(joy, settle_s, 1) for joy in sent_joys.probes(joys)]
        plan += [(joy, 0.0, times) for joy in sent_joys.small_and_button_probes()]
        for joy, wait_s, often in plan:
            _, received = self._ask(joy, wait_s, often)
            if not received and not self._program.ended:
                self._ask(before, wait_s, often)
                _, received = self._ask(joy, wait_s, often)
            if not received:
                self._note_probes(unanswered=(joy, before))
                return
            answer = joy, received[-1 if settle_s else 0][2]
            self._note_probes(answers=(*self._run.probes.answers, answer))
            before = joy

    def _note_probes(self, **changes: Any) -> None:
        self._run = replace(self._run, probes=replace(self._run.probes, **changes))

    def _ask(
        self, joy: Joy, settle_s: float, often: int = 1, longest_s: float = ANSWER_S
    ) -> tuple[float, list[Any]]:
        """Send a Joy; return (time sent, Twists received). often: number of Twists to wait for."""
        before = self._count()
        sent_s = self._ros.peer.send(JOY, self._task.joy(joy))
        self._wait(longest_s if often == 1 else SETTLE_S, lambda: self._count() - before >= often)
        if settle_s:
            self._wait(settle_s)
        return sent_s, self._received(before)

    def _one_by_one(self, joys: Sequence[Joy], settle_s: float) -> None:
        before, answered, unanswered = self._count(), 0, 0
        for joy in joys:
            sent_s, received = self._ask(joy, settle_s)
            seen, wait_s = self._seen, received[0][0] - sent_s if received else ANSWER_S
            self._note(sent=seen.sent + 1, waits=(*seen.waits, wait_s))
            if received:
                sample = joy[0], received[-1][2] if settle_s else received[0][2]
                self._note(samples=(*seen.samples, sample))
                answered += 1
            else:
                self._note(missing=seen.missing + 1)
                unanswered += 1
            if unanswered == 3 or self._program.ended or self._run.naps:
                break
        # This includes Twists between an answer and the next Joy.
        self._note(extra=self._seen.extra + self._count() - before - answered)
        if unanswered == 3 and not self._program.ended and not self._run.naps:
            # Send the rest quickly, to count how many of all are answered.
            for joy in joys[answered + unanswered :]:
                self._ask(joy, 0.0, longest_s=SAME_S)
        self._note(came=self._count() - before)


def _stream(workspace: Workspace, ros: RosSession, run: Joy2TwistRun, beside_ours: bool) -> Stream:
    """Send Joys at RATE. beside_ours: the checker's own joy2twist answers them, too."""
    task, count = workspace.task, int(RATE * STREAM_S)
    if beside_ours:
        known = ros.peer.listeners(JOY)
        echo, answers = ros.echo(task.axes[RIGHT[LINEAR]])
        ros.peer.listen(answers, "Twist")
        ros.wait(lambda: echo.ready() and ros.peer.listeners(JOY) > known, START_S)
    before = ros.peer.count(CMD_VEL)
    joys = [task.joy(joy) for joy in sent_joys.rising_joys(count)]
    ros.peer.stream(JOY, joys, RATE, False)
    ros.wait(lambda: len(ros.peer.sent(JOY)) >= count, STREAM_S + 3)
    ros.wait(lambda: ros.peer.count(CMD_VEL) - before >= count, 0.3)
    sent, received = ros.peer.sent(JOY), ros.peer.received(CMD_VEL, before)
    rule = rule_of(LINEAR, run.numbered.samples)
    delays = sent_joys.delays(sent, received, rule.factor if rule else None)
    strays = sent_joys.strays([any(twist) for _, _, twist in received])
    stream = Stream(len(sent), len(received), strays, tuple(delays))
    if not beside_ours:
        return stream
    echoed, sign = ros.peer.received(answers), task.signs[RIGHT[LINEAR]]
    ours = statistics.median(sent_joys.delays(sent, echoed, sign) or [0.0])
    return replace(stream, possible=len(echoed), unavoidable_s=ours)
