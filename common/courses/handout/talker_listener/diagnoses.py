"""Diagnoses of a talker's messages, of a silent talker, and of a listener's output."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from functools import cached_property

from tutorial_check import (
    Note,
    Script,
    Wrong,
    first_of,
    has_failed,
    never_calls_back,
    unsubscribed,
    with_import,
)

from ..task import other_topic
from .record import KIND, LISTEN_S, STRINGS, TOPIC, Talk

LISTENS = "every text sent on /chatter, displayed once"
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
    line = talk.script.facts.oddities.repeated_publisher
    if not line:
        return None
    seen = f"{len(talk.times)} messages: advertise in the loop makes a new Publisher at each turn"
    hint = f"above the loop: {talk.hint}"
    return Wrong(talk.expected, seen, talk.script.at_line(line), hint, sure=True)


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
    line, spin = talk.script.facts.oddities.late_loop, talk.script.facts.idioms.spin
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
        crashed_silently, other_type, sent_elsewhere, never_loops, made_again, ended_silently,
    )  # fmt: skip
    facts = talk.script.facts
    hint = "is publish(...) called within the loop?"
    where = talk.script.at_line(*[] if "publish" in facts.calls else facts.loops[:1])
    no_message = Wrong(talk.expected, "not one message", where, hint)
    return first_of(diagnoses, talk) or no_message


@dataclass(frozen=True)
class Listened:
    """A listener's run and its text."""

    seen: Talk
    script: Script

    @cached_property
    def times(self) -> list[int]:
        """How many times each text was displayed."""
        lines = self.seen.listener.output.splitlines()
        return [sum(text in line for line in lines) for text in STRINGS]

    @property
    def hint(self) -> str:
        """How to make it subscribe."""
        line = self.script.facts.idioms.subscriber("chatter", "String")
        return with_import(line, "String", self.script.facts)

    @property
    def subscriber(self) -> str:
        return self.script.at_call("Subscriber")


def crashed_deaf(listen: Listened) -> Wrong | None:
    ran = listen.seen.listener
    return listen.script.crash(ran, LISTENS) if has_failed(ran) or ran.spins else None


def subscribed_elsewhere(listen: Listened) -> Wrong | None:
    topic = other_topic(listen.seen.subscribers, TOPIC, listen.seen.types, KIND)
    if TOPIC in listen.seen.subscribers or not topic:
        return None
    seen, hint = f"it subscribes to {topic}", "the topic is called chatter"
    private = listen.script.private("Subscriber", LISTENS, seen)
    return private or Wrong(LISTENS, seen, listen.subscriber, hint, sure=True)


def subscription_has_ended(listen: Listened) -> Wrong | None:
    cause = None if TOPIC in listen.seen.subscribers else unsubscribed(listen.script.facts)
    if not cause:
        return None
    seen = f"it subscribes to nothing: {cause.seen}"
    return Wrong(LISTENS, seen, listen.script.at_line(cause.line), cause.hint, sure=True)


def not_subscribed(listen: Listened) -> Wrong | None:
    if TOPIC in listen.seen.subscribers:
        return None
    hint = f"{listen.hint}, before {listen.script.facts.idioms.spin}"
    return Wrong(LISTENS, "it subscribes to nothing", listen.subscriber, hint)


def no_callback(listen: Listened) -> Wrong | None:
    lacking = listen.script.facts.without_callback
    if any(listen.times) or not lacking:
        return None
    where = listen.script.at_line(lacking.line)
    return Wrong(LISTENS, "its Subscriber has no callback", where, listen.hint, sure=True)


def never_called(listen: Listened) -> Wrong | None:
    cause = None if any(listen.times) else never_calls_back(listen.script.facts)
    where = listen.script.at_line(cause.line) if cause else ""
    return Wrong(LISTENS, cause.seen, where, cause.hint, sure=True) if cause else None


def no_text(listen: Listened) -> Wrong | None:
    """Find a std::string where ROS_INFO needs the characters in it."""
    line, text = listen.script.facts.oddities.text_as_object or (0, "")
    if not line:
        return None
    seen, hint = f"%s displays something else than {text}", f"{text}.c_str()"
    return Wrong(LISTENS, seen, listen.script.at_line(line), hint, sure=True)


def only_debug(listen: Listened) -> Wrong | None:
    called = listen.script.facts.called_back
    if any(listen.times) or "logdebug" not in called or "loginfo" in called:
        return None
    info, where = listen.script.facts.idioms.info, listen.script.at_line(*called["logdebug"][:1])
    return Wrong(LISTENS, "the level debug, which is not displayed", where, info, sure=True)


def wants_other_type(listen: Listened) -> Wrong | None:
    """Compare the type that it subscribes to; rospy warns of types that differ."""
    call = listen.script.facts.first("Subscriber")
    kind = call.words[1].rpartition(".")[2] if call and len(call.words) > 1 else "String"
    refused = any("datatype" in line and "chatter" in line for line in listen.seen.warnings)
    if kind == "String" and not refused:
        return None
    kind = "another type of message" if kind == "String" else kind
    idioms = listen.script.facts.idioms
    hint = with_import(idioms.typed_subscriber("chatter", "String"), "String", listen.script.facts)
    return Wrong(LISTENS, f"it wants {kind} on /chatter", listen.subscriber, hint)


def receives_nothing(listen: Listened) -> Wrong:
    """Return the Wrong for a listener that does not display all texts."""
    diagnoses = (
        crashed_deaf, subscribed_elsewhere, subscription_has_ended, not_subscribed, no_callback,
        wants_other_type, never_called, no_text, only_debug,
    )  # fmt: skip
    idioms = listen.script.facts.idioms
    hint = f"does callback(data) display {idioms.text}, with {idioms.info}?"
    seen = f"{sum(map(bool, listen.times))} of {len(STRINGS)} displayed"
    return first_of(diagnoses, listen) or Wrong(LISTENS, seen, listen.subscriber, hint)


def twice_displayed(listen: Listened) -> Note | None:
    if min(listen.times) < 2:
        return None
    called = listen.script.facts.called_back
    displays = sorted(called.get("print", []) + called.get("loginfo", []))
    places = (listen.script.facts.lines("Subscriber"), displays)
    where = listen.script.at_line(next((lines[1] for lines in places if len(lines) > 1), 0))
    info = listen.script.facts.idioms.info
    hint = f"one Subscriber, and one {info} in its callback, are enough"
    return Note(f"each text is displayed {min(listen.times)} times", where, hint)


RATE_DIAGNOSES = (made_again, few_messages, no_sleep, unwanted_rate, same_text, other_rate)
