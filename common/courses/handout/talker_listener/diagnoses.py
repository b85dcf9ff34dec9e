"""Diagnoses of a talker's messages, of a silent talker, and of names."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from functools import cached_property
from typing import Sequence

from tutorial_check import (
    Note,
    Ran,
    Script,
    Wrong,
    first_of,
    has_failed,
    with_import,
)

from ..task import other_topic
from .record import KIND, LISTEN_S, TOPIC, Talk

GOES_ON = "it runs until Ctrl-C"
RATE_TOLERANCE = 0.2  # share of the expected rate
FEW = 3  # fewer messages give no rate
TORRENT_HZ = 150


@dataclass(frozen=True)
class Talked:
    """A talker's run and its text."""

    seen: Talk
    script: Script
    wanted: float | None  # the rate that the task names

    @property
    def expected(self) -> str:
        often = "about 10 times a second" if self.wanted is None else "as often as rate says"
        return f"std_msgs/String on /chatter, {often}"

    @cached_property
    def times(self) -> list[float]:
        """When the messages of the first talker arrived."""
        received = self.seen.received
        return [when for when, caller, _ in received if caller == received[0][1]]

    @cached_property
    def rate(self) -> float:
        steps = [later - time for time, later in zip(self.times, self.times[1:])] or [LISTEN_S]
        return 1 / max(1e-6, statistics.median(steps))

    @property
    def end(self) -> str:
        return ", and it ends by itself" if self.seen.talker_ended else ""

    @property
    def hint(self) -> str:
        """How to make it publish."""
        facts = self.script.facts
        line = with_import(facts.idioms.publisher("chatter", "String"), "String", facts)
        return f"{line}; and {facts.idioms.in_loop}" if self.end else line

    @property
    def publisher(self) -> str:
        facts = self.script.facts
        return self.script.at_line(*facts.lines("Publisher")[:1] or [int(facts.is_python)])

    def crash(self) -> Wrong:
        facts = self.script.facts
        loop = f"does it loop: {facts.idioms.loop.rstrip(':')}"
        hint = f"does the last line call talker(){f', and {loop}' if facts.has_main else ''}?"
        hint = hint if facts.is_python else f"{loop}?"
        return self.script.end(self.seen.talker, self.expected, hint)


def few_messages(talk: Talked) -> Note | None:
    if len(talk.times) >= FEW or talk.wanted:
        return None
    return Note(f"{len(talk.times)} messages in {LISTEN_S + 2:.0f} s: slower than 1 Hz")


def made_again(talk: Talked) -> Wrong | None:
    """Find a Publisher that is made in the loop: until listeners have connected, it is gone."""
    line = talk.script.facts.lapses.repeated_publisher
    if not line or len(talk.times) >= FEW:
        return None
    seen = "few messages arrive: advertise in the loop makes a new Publisher at each turn"
    hint = f"above the loop: {talk.hint}"
    return Wrong(talk.expected, seen, talk.script.at_line(line), hint, sure=True)


def spins_in_loop(talk: Talked) -> Wrong | None:
    line, spin = talk.script.facts.lapses.looped_spin, talk.script.facts.idioms.spin
    if not line or len(talk.times) >= FEW:
        return None
    seen, where = f"{spin} in the loop returns only when the node ends", talk.script.at_line(line)
    return Wrong(talk.expected, seen, where, "ros::spinOnce(), which returns at once", sure=True)


def no_sleep(talk: Talked) -> Wrong | None:
    """Find a flood of messages; delayed ones arrive in bursts, so use the mean rate as well."""
    mean_rate = (len(talk.times) - 1) / max(1e-6, talk.times[-1] - talk.times[0])
    if min(talk.rate, mean_rate) <= TORRENT_HZ:
        return None
    often = f"{talk.rate:.0f}" if talk.rate < 1000 else "thousands of"
    where = talk.script.at_line(*talk.script.facts.loops[:1])
    hint = "rate.sleep() is missing within the loop"
    return Wrong(talk.expected, f"{often} messages a second", where, hint, sure=True)


def unwanted_rate(talk: Talked) -> Wrong | None:
    if not talk.wanted or abs(talk.rate / talk.wanted - 1) < RATE_TOLERANCE:
        return None
    hint = talk.script.facts.idioms.rate.format(hz=talk.wanted)
    where = talk.script.at_call("Rate")
    return Wrong(talk.expected, f"{talk.rate:.1f} times a second", where, hint)


def same_text(talk: Talked) -> Note | None:
    texts = {value for _, _, value in talk.seen.received}
    note = f"always the same text, {min(texts)!r}; the handout's has the time in it"
    return Note(note) if len(texts) == 1 else None


def other_rate(talk: Talked) -> Note | None:
    is_usual = talk.wanted or 8 <= talk.rate <= 12
    return None if is_usual else Note(f"{talk.rate:.1f} Hz, the handout's is 10")


def crashed_silently(talk: Talked) -> Wrong | None:
    ran = talk.seen.talker
    return talk.crash() if has_failed(ran) or ran.spins else None


def other_type(talk: Talked) -> Wrong | None:
    kind = talk.seen.published.get(TOPIC, "")
    if not kind or (kind == KIND and not any("datatype" in line for line in talk.seen.warnings)):
        return None
    seen = f"/chatter carries {kind}{talk.end}"
    return Wrong(talk.expected, seen, talk.publisher, talk.hint, sure=True)


def sent_elsewhere(talk: Talked) -> Wrong | None:
    topic = other_topic(talk.seen.published, TOPIC, talk.seen.published, KIND)
    if not topic:
        return None
    seen = f"it publishes on {topic}{talk.end}"
    private = talk.script.private("Publisher", talk.expected, seen)
    return private or Wrong(talk.expected, seen, talk.publisher, talk.hint)


def never_loops(talk: Talked) -> Wrong | None:
    line, spin = talk.script.facts.lapses.late_loop, talk.script.facts.idioms.spin
    if not line:
        return None
    seen = f"not one message: {spin} comes before the loop, and returns only when the node ends"
    hint = f"a talker needs no {spin}"
    return Wrong(talk.expected, seen, talk.script.at_line(line), hint, sure=True)


def ended_silently(talk: Talked) -> Wrong | None:
    return talk.crash() if talk.end else None


def silent(talk: Talked) -> Wrong:
    """Return the Wrong for a talker without a message."""
    diagnoses = (
        crashed_silently, other_type, sent_elsewhere, never_loops, spins_in_loop, made_again,
        ended_silently,
    )  # fmt: skip
    facts = talk.script.facts
    hint = "is publish(...) called within the loop?"
    where = talk.script.at_line(*[] if "publish" in facts.calls else facts.loops[:1])
    no_message = Wrong(talk.expected, "not one message", where, hint)
    return first_of(diagnoses, talk) or no_message


def same_name(ran: Ran, programs: Sequence[Script]) -> Wrong | None:
    """Find a program that the other one has ended, because it has the same node's name."""
    if "new node registered with same name" not in ran.output:
        return None
    calls = [(script, script.facts.first("init_node")) for script in programs]
    named = [(script, call.words[0]) for script, call in calls if call and call.words]
    odd = next((script for script, name in named if name not in script.name), programs[-1])
    seen = "talker and listener have the same name: the node that starts later ends the other"
    hint = f"{odd.facts.idioms.init} gives each node a name of its own"
    return Wrong("two nodes side by side", seen, odd.at_call("init_node"), hint, sure=True)


RATE_DIAGNOSES = (
    made_again, spins_in_loop, few_messages, no_sleep, unwanted_rate, same_text, other_rate,
)  # fmt: skip
