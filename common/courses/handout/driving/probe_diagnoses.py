"""Diagnoses of wrong or missing answers to the probes."""

from __future__ import annotations

from tutorial_check import Wrong, first_of

from ..task import LB
from .evidence import RIGHT
from .field_diagnoses import not_a_number, only_this_joy, rule_verdict
from .replies import ProbeReply, Replies, Silence, other_button

ALWAYS = "publish for every Joy, with no `if` around it"


def one_zero_on_release(silence: Silence) -> Wrong | None:
    if silence.joy[1][LB] or silence.before[1][LB] or any(silence.last):
        return None
    names, answers = silence.task.names, silence.task.answers
    hint = f"without {answers.lb} publish Twist(), all zero, for every Joy, not only for the first"
    return Wrong("", f"only one zero after {names.lb} is released, and then silence", hint=hint)


def silent_at_the_same_joy(silence: Silence) -> Wrong | None:
    if silence.joy != silence.before:
        return None
    return Wrong("", "no Twist for the same Joy again", hint=f"{ALWAYS}: not only for a new one")


def silent_at_a_button(silence: Silence) -> Wrong | None:
    button = other_button(silence.task, silence.joy)
    hint = "silence does not stop the robot: to stop it publish Twist(), all zero, before return"
    seen = f"no Twist for a Joy with {button} pressed: the robot drives on"
    return Wrong("", seen, hint=hint) if button else None


def silent_on_release(silence: Silence) -> Wrong | None:
    if silence.joy[1][LB]:
        return None
    names, lb = silence.task.names, silence.task.answers.lb
    seen = f"no Twist for a Joy with {names.lb} released ({names.button} = 0): the robot drives on"
    hint = f"silence does not stop the robot: with {lb} released publish Twist(), all zero"
    return Wrong("", seen, hint=hint)


def silent_at_rest(silence: Silence) -> Wrong | None:
    if any(silence.joy[0]):
        return None
    seen = "no Twist for a Joy at rest, all axes 0: the robot drives on"
    return Wrong("", seen, hint=f"{ALWAYS}: zero is what stops the robot")


def silent_at_a_still_axis(silence: Silence) -> Wrong | None:
    names = silence.task.names.axes
    still = [names[axis] for axis in RIGHT.values() if not silence.joy[0][axis]]
    return Wrong("", f"no Twist for a Joy with {still[0]} = 0", hint=ALWAYS) if still else None


def silent_at_another_size(_: Silence) -> Wrong:
    return Wrong("", "no Twist for a Joy of another size", hint=ALWAYS)


SILENCES = (
    one_zero_on_release, silent_at_the_same_joy, silent_at_a_button, silent_on_release,
    silent_at_rest, silent_at_a_still_axis, silent_at_another_size,
)  # fmt: skip


def drives_on(reply: ProbeReply) -> Wrong | None:
    if not reply.drives_on:
        return None
    names, other = reply.task.names, other_button(reply.task, reply.joy)
    lb = "" if reply.joy[1][LB] else f" and {names.lb} released"
    when = f"{names.axes[reply.axis]} is {reply.joy[0][reply.axis]:.2f}{lb}"
    when += f" and {other} pressed" if other else ""
    how = "stays" if reply.stays else "is"
    seen = f"{reply.name} {how} {reply.value:.2f} when {when}: the robot drives on"
    hint = f"{reply.name} comes from this Joy alone, zero as well: a new Twist() in the callback,"
    return Wrong("", seen, hint=f"{hint} no += and no `if` around the line")


def speed_kept_after_a_button(reply: ProbeReply) -> Wrong | None:
    if not reply.differs or other_button(reply.task, reply.joy) or not reply.last_button:
        return None
    seen = f"the same Joy gives {reply.name} = {reply.again:.2f} and,"
    seen += f" once {reply.last_button} was pressed, {reply.value:.2f}"
    hint = "a button changes the speed only while it is held: set the factor again in the callback"
    return Wrong("", seen, hint=hint)


def another_reply(reply: ProbeReply) -> Wrong | None:
    if not reply.differs:
        return None
    seen = f"{reply.name} depends on earlier Joys: the same Joy gives"
    seen += f" {reply.again:.2f} and {reply.value:.2f}"
    return Wrong("", seen, hint=only_this_joy(reply.name))


REPLIES = (drives_on, speed_kept_after_a_button, another_reply)


def still_alone(replies: Replies) -> Wrong | None:
    field, task = replies.still_alone, replies.evidence.task
    if field is None:
        return None
    hint = f"{field.name} = {task.answers.rules[field.axis]}, whatever the other axis is"
    seen = f"{field.name} is 0 when {task.names.axes[field.axis]} alone is moved"
    return Wrong("", seen, hint=hint)


def drives_released(replies: Replies) -> Wrong | None:
    task = replies.evidence.task
    hint = f"publish Twist(), all zero, unless {task.answers.lb} is held"
    seen = f"the robot drives with {task.names.lb} released"
    return Wrong("", seen, hint=hint) if replies.drives_released else None


def probe_verdict(replies: Replies) -> Wrong | None:
    """Return the Wrong for the probes, if the answers to the numbered Joys are right."""
    wrong = not_a_number(replies.samples)
    wrong = wrong or (first_of(REPLIES, replies.odd) if replies.odd else None)
    wrong = wrong or first_of((still_alone, drives_released), replies)
    verdict = wrong or rule_verdict(replies.whole)
    return verdict if isinstance(verdict, Wrong) else None
