"""Why a program in C++ that compiles does not do what it says."""

from __future__ import annotations

from typing import NamedTuple

from tutorial_check.submission.source_facts import SourceFacts

SIZES = {"axes": 6, "buttons": 12}  # the handout's gamepad has so many
CALLS_BACK = ("spin", "spinOnce", "AsyncSpinner", "callAvailable", "callOne")
OUT_OF_RANGE = ("this->size()", "out_of_range")


class Cause(NamedTuple):
    """What is wrong in a line, and what to write in its place."""

    line: int
    seen: str
    hint: str


def unsubscribed(facts: SourceFacts) -> Cause | None:
    """Return why a program that calls subscribe() has no subscription, or None."""
    lost, declared = facts.oddities.lost_subscriber, facts.oddities.function_declared
    if lost and not lost.name:
        hint = "ros::Subscriber sub = ..., for as long as the node runs"
        return Cause(lost.line, "the Subscriber that subscribe() returns is not kept", hint)
    if lost:
        seen = f"{lost.name} ends with {lost.ends_with}, and the subscription with it"
        hint = "make it a variable of main, a member of the class, or a global variable"
        if lost.hides:
            hint = f"write `{lost.name} = ...` without a type: the member of that name is meant"
        return Cause(lost.line, seen, hint)
    if declared:
        line, text = declared
        hint = f"without (): {text.replace('()', '')}"
        return Cause(line, f"`{text}` declares a function, and makes no object", hint)
    for node in (node for node in facts.classes if node.is_node and not node.instantiated):
        hint = f"in main, before {facts.idioms.spin}: {node.name} node;"
        return Cause(node.line, f"no {node.name} is ever made", hint)
    late, spin = facts.lapses.late_subscriber, facts.idioms.spin
    seen = f"{spin} comes before it, and returns only when the node ends"
    return Cause(late, seen, f"put it above {spin}") if late else None


def never_calls_back(facts: SourceFacts) -> Cause | None:
    """Return why no callback of a program that runs is ever called, or None."""
    if facts.is_python or not facts.calls or any(name in facts.calls for name in CALLS_BACK):
        return None
    seen = "the callback is never called: the loop has no ros::spinOnce()"
    return Cause(next(iter(facts.loops), 0), seen, facts.idioms.in_loop)


def cause_of_abort(error: str, facts: SourceFacts) -> tuple[int, str]:
    """Return (line or 0, hint) for the error or signal with which a program has ended."""
    if "invalid Publisher" in error:
        return _invalid_publisher(facts)
    if "Trying to publish message of type" in error:
        line = next(iter(facts.lines("Publisher")), 0)
        return line, "advertise<TYPE> names the type of what is published"
    if any(words in error for words in OUT_OF_RANGE):
        return _beyond(facts)
    if facts.oddities.unset_pointer and ("px != 0" in error or "SIGSEGV" in error):
        line, name = facts.oddities.unset_pointer
        return line, f"{name} is a pointer, and points to nothing here: if ({name}) ..."
    return 0, ""


def _invalid_publisher(facts: SourceFacts) -> tuple[int, str]:
    maker, hidden = facts.first("Publisher"), facts.oddities.hidden_publisher
    if hidden:
        line, name = hidden
        hint = f"`ros::Publisher {name}` is a second {name}, of this function alone, and the other"
        return line, f"{hint} stays empty: {name} = ... without a type"
    unmade, subscriber = facts.oddities.unmade_publisher, facts.first("Subscriber")
    if unmade:
        return unmade[0], f"no advertise makes {unmade[1]}"
    if maker and subscriber and subscriber.line < maker.line:
        return subscriber.line, f"put it below line {maker.line}: first advertise, then subscribe"
    return next(iter(facts.lines("publish")), 0), ""


def _beyond(facts: SourceFacts) -> tuple[int, str]:
    for line, array, number in facts.oddities.indices:
        size = SIZES[array]
        if number >= size:
            return line, f"{array}[{number}] does not exist: a Joy has {size}, 0 to {size - 1}"
    return 0, ""
