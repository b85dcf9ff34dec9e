"""Diagnoses of what a Joy-to-Twist program displays and answers, and when."""

from __future__ import annotations

import re
import statistics

from tutorial_check import Note, SourceFacts, Wrong, first_of

from ..task import AXES
from .connection_diagnoses import crashed, ended_early, hidden_crash
from .joy2twist_node import Joy2TwistNode
from .joys import COUNT, ROUNDED
from .probe_diagnoses import SILENCES

MOST_STRAY_ZEROS = 2  # in a row of Joys
MOVING = ("linear.x", "angular.z")
FLOAT = "an int has no decimals, a float or double has"
IN_CALLBACK = "publish only in the callback, once for every Joy; end with {}"


def callback_sleeps(node: Joy2TwistNode) -> Wrong | None:
    if not node.run.naps:
        return None
    wait_s = statistics.median(node.run.numbered.waits)
    seen = f"{wait_s:.1f} s from one Twist to the next: the callback sleeps"
    hint = "no sleep in the callback: it is called once for every message"
    return Wrong("", seen, node.at(node.run.sleep_lines), hint)


def displayed_by_another_file(node: Joy2TwistNode) -> Note | None:
    script = node.first_version
    return Note(f"displayed by {script}, no longer by {node.script}") if script else None


def some_displayed(node: Joy2TwistNode) -> Note | None:
    count = node.run.numbered.displayed
    return Note(f"{count} of {COUNT} were displayed") if count else None


def throttled(node: Joy2TwistNode) -> Note | None:
    names = [name for name in node.source.calls if name.endswith("_throttle")]
    if not names or not node.run.displays_numbers:
        return None
    seen = "it displays a Joy now and then; the handout's displays every one"
    info = node.source.idioms.info
    hint = f"{info} in place of {info}{'_throttle' if node.source.is_python else '_THROTTLE'}"
    return Note(seen, node.at_call(names[0]), hint)


DISPLAYED = (crashed, displayed_by_another_file, some_displayed, callback_sleeps, throttled)


def rounded_too_far(node: Joy2TwistNode) -> Wrong | None:
    if node.values_displayed(10 * ROUNDED) != AXES:
        return None
    seen = "the six values have fewer than two decimals"
    return Wrong("", seen, node.display, "%.2f for each value")


def some_values_left_out(node: Joy2TwistNode) -> Wrong | None:
    count = node.values_displayed()
    hint = f"all six: {node.source.idioms.show_axes}"
    seen = f"a line has {count} of the six values of a message"
    return Wrong("", seen, node.display, hint) if count else None


def logs_at_debug(node: Joy2TwistNode) -> Note | None:
    is_debug = {"logdebug", "Publisher"} <= {*node.source.calls}
    return Note("it logs at level debug, which is not displayed") if is_debug else None


def nothing_displayed(node: Joy2TwistNode) -> Wrong:
    idioms = node.source.idioms
    hint = f"display {idioms.axes} in the callback, with {idioms.info}(...)"
    return Wrong("", "not one value of a message was found in its output", node.script, hint)


NOT_DISPLAYED = (
    hidden_crash, rounded_too_far, some_values_left_out, logs_at_debug, nothing_displayed
)  # fmt: skip


def few_answers(node: Joy2TwistNode) -> Wrong:
    seen, where = node.run.numbered, node.at_call("publish")
    if not node.source.first("publish"):
        where = node.callback
    count = max(seen.came, len(seen.samples))
    if count:
        hint = "publish in the callback, for every message"
        return Wrong("", f"{count} Twists for {COUNT} Joys", where, hint)
    hint = f"is {node.source.idioms.publish} called in the callback, for every message?"
    return Wrong("", "no Twist came for any Joy", where, hint)


ANSWERED = (crashed, ended_early, hidden_crash, few_answers)


def zeros_between_answers(node: Joy2TwistNode) -> Wrong | None:
    numbered = node.run.numbered
    # An answer against the rule may be such a zero.
    is_mixed = numbered.has_clock and len({any(twist) for twist in numbered.twists}) == 2
    if node.run.stream.stray_zeros <= MOST_STRAY_ZEROS and not (is_mixed and node.is_odd):
        return None
    seen = "zeros come between the answers: the robot jerks"
    return Wrong("", seen, node.loop, IN_CALLBACK.format(node.source.idioms.spin))


def twists_without_joys(node: Joy2TwistNode) -> Wrong | None:
    if not node.run.numbered.repeats:
        return None
    seen = "Twists come from a clock of its own: without a joystick the robot drives on"
    return Wrong("", seen, node.loop, IN_CALLBACK.format(node.source.idioms.spin))


def second_twist_is_zero(node: Joy2TwistNode) -> Wrong | None:
    moves = any(any(twist) for _, twist in node.run.numbered.samples)
    if node.repeated != (2, True) or moves:
        return None
    seen = "two Twists for one Joy, and the second is zero: the robot jerks"
    hint = "publish once, at the end of the callback: delete this second publish"
    return Wrong("", seen, node.second_publish, hint)


def several_differ(node: Joy2TwistNode) -> Wrong | None:
    count, differ = node.repeated
    seen = f"{count} Twists for each Joy, and they differ: the robot jerks"
    hint = "publish once, at the end of the callback"
    return Wrong("", seen, node.second_publish, hint) if differ else None


ONCE = (zeros_between_answers, twists_without_joys, second_twist_is_zero, several_differ)


def unanswered(node: Joy2TwistNode) -> Wrong | None:
    silence = node.run.silence(node.submission.task)
    if not silence or node.is_odd:
        return None
    wrong = crashed(node) or first_of(SILENCES, silence)
    if wrong and not node.run.has_traceback:
        wrong.where = node.at_call("publish")
    return wrong


def another_rule(node: Joy2TwistNode) -> Wrong | None:
    verdict, numbered = node.rule_verdict, node.run.numbered
    if not isinstance(verdict, Wrong):
        return None
    sure = not (numbered.missing or numbered.extra)
    whole = whole_numbers(node.source, verdict.seen)
    if whole:
        return Wrong("", verdict.seen, node.at([whole[0]]), whole[1], sure)
    line, takes_buttons = _setting_line(node.source, verdict.seen)
    if not line and _is_set_late(node.source):
        verdict.hint = "first put the values into the message, then publish it"
    where = node.at([line]) if line else node.at_call("publish")
    axes = node.source.idioms.axes
    stick = f"the stick is {axes}, not {axes.replace('axes', 'buttons')}"
    hint = stick if takes_buttons else verdict.hint
    if "whole numbers" in verdict.seen and not node.source.is_python:
        hint = FLOAT
    return Wrong("", verdict.seen, where, hint, sure)


def whole_numbers(source: SourceFacts, seen: str) -> tuple[int, str] | None:
    """Return (line, hint) for an int of C++ that explains what was seen, or None."""
    division, axis = source.oddities.whole_division, source.oddities.whole_axis
    if division and re.search(r"(every Twist|always) ", seen):
        line, text = division
        dividend, _, divisor = text.partition(" / ")
        hint = f"{text} is {int(dividend) // int(divisor)} in C++: {dividend}.0 / {divisor}"
        return line, hint
    if axis and "whole numbers only" in seen:
        line, name = axis
        return line, f"{name}: {FLOAT}"
    return None


def _setting_line(source: SourceFacts, seen: str) -> tuple[int, bool]:
    """Return (line that sets the named field, or 0; whether it takes a button)."""
    field = re.search(r"(linear|angular)\.[xyz]", seen)
    if not source.is_python:
        return _assigned(source.attributes, field[0] if field else "")
    name = re.escape(field[0]) if field else r"(?:linear\.x|angular\.z)"
    for number, line in source.text.items():
        takes_buttons = re.search(name + r"\s*=.*\bbuttons\b(?!.*\baxes\b)", line)
        if takes_buttons or (field and re.search(name + r"\s*[-+*/]?=", line)):
            return number, bool(takes_buttons)
    return 0, False


def _is_set_late(source: SourceFacts) -> bool:
    """Return whether all fields of a Twist are set below the only publish."""
    attributes = source.attributes.items()
    fields = [line for name, (line, _) in attributes if name.endswith(MOVING)]
    published = source.lines("publish")
    return len(published) == 1 and bool(fields) and published[0] < min(fields)


def _assigned(attributes: dict[str, tuple[int, str]], field: str) -> tuple[int, bool]:
    """Return the same from {"twist.linear.x": (line, value)}. field: "" for any."""
    names = (field,) if field else MOVING
    for name, (line, value) in sorted(attributes.items(), key=lambda named: named[1]):
        takes_buttons = "buttons" in value and "axes" not in value
        if name.endswith(names) and (field or takes_buttons):
            return line, takes_buttons
    return 0, False


def right_but_crashed(node: Joy2TwistNode) -> Note | None:
    wrong = crashed(node)
    return Note(f"right, but also: {wrong.seen}", wrong.where, wrong.hint) if wrong else None


def the_same_again(node: Joy2TwistNode) -> Note | None:
    count, hint = node.repeated[0], "one is enough: publish once"
    return Note(f"{count} Twists for each Joy", node.second_publish, hint) if count > 1 else None


def another_scale(node: Joy2TwistNode) -> Note | None:
    return node.rule_verdict if isinstance(node.rule_verdict, Note) else None


def latched(node: Joy2TwistNode) -> Note | None:
    calls = node.source.calls.get("Publisher", [])
    if not any(call.names.get("latch") == "True" for call in calls):
        return None
    word = node.source.idioms.latched
    return Note(f"{word}: a late subscriber gets an old velocity", hint="leave latch out")


RIGHT_RULE = (unanswered, another_rule, right_but_crashed, the_same_again, another_scale, latched)


def rate_of(node: Joy2TwistNode) -> str:
    stream = node.run.stream
    late = f", {1000 * stream.delay_s:.1f} ms late" if stream.delay_s is not None else ""
    return f"{stream.answered} Twists for {stream.sent} Joys{late}"


def spins_in_callback(node: Joy2TwistNode) -> Wrong | None:
    """Find a ros::spin() in the callback; with roscpp that works for some thousand Joys."""
    lines = node.source.called_back.get("spin", [])
    lines = [line for line in lines if "ros::spin(" in node.source.text.get(line, "")]
    if not lines:
        return None
    seen = "each Joy starts another ros::spin() in the callback of the last, until it crashes"
    return Wrong("", seen, node.at(lines), "ros::spin() once, at the end of main", sure=True)


def too_slow(node: Joy2TwistNode) -> Wrong:
    if not node.run.sleep_lines:
        return Wrong("", rate_of(node), node.script, "what in the callback takes so long?")
    hint = "no sleep and no Rate in the callback: it is called for each message"
    return Wrong("", rate_of(node), node.at(node.run.sleep_lines), hint)


RATE = (crashed, too_slow)
