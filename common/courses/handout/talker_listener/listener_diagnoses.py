"""Diagnoses of what a listener displays."""

from __future__ import annotations

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
from .record import KIND, STRINGS, TOPIC, Talk

LISTENS = "every text sent on /chatter, displayed once"


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
    line, text = listen.script.facts.lapses.text_as_object or (0, "")
    if not line:
        return None
    seen, hint = f"%s displays something else than {text}", f"{text}.c_str()"
    return Wrong(LISTENS, seen, listen.script.at_line(line), hint, sure=True)


def only_debug(listen: Listened) -> Wrong | None:
    called = listen.script.facts.called_back
    if any(listen.times) or "logdebug" not in called or "loginfo" in called:
        return None
    where = listen.script.at_line(*called["logdebug"][:1])
    hint = f"{listen.script.facts.idioms.info} is displayed"
    return Wrong(LISTENS, "the level debug, which is not displayed", where, hint, sure=True)


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
    hint = f"does the callback display {idioms.text}, with {idioms.info}?"
    seen = f"{sum(map(bool, listen.times))} of {len(STRINGS)} displayed"
    return first_of(diagnoses, listen) or Wrong(LISTENS, seen, listen.subscriber, hint)


def displayed_late(listen: Listened) -> Note | None:
    line = listen.script.facts.lapses.unended_line
    seen = "what ends no line is displayed when the program ends, or later"
    return Note(seen, listen.script.at_line(line), "... << std::endl;") if line else None


def spins_inside(listen: Listened) -> Note | None:
    """Find a spin in a callback, which roscpp allows: the callbacks run inside of each other."""
    lines = listen.script.facts.called_back.get("spin", [])
    if not lines:
        return None
    spin, where = listen.script.facts.idioms.spin, listen.script.at_line(lines[0])
    seen = f"{spin} in the callback, which then ends only with the node"
    return Note(seen, where, f"{spin} belongs into main, once")


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


DISPLAYED = (twice_displayed, displayed_late, spins_inside)
