"""C5 to C10: talker and listener."""

from __future__ import annotations

from tutorial_check import (
    MASTER_GONE,
    CutShort,
    Note,
    Script,
    Submission,
    Wrong,
    check,
    check_file,
    find_script,
    flipped_anonymous,
    in_cpp,
    must_pass,
    wrong_of,
)

from ..task import BEGINNER
from . import record
from .diagnoses import GOES_ON, RATE_DIAGNOSES, Talked, same_name, silent
from .listener_diagnoses import DISPLAYED, Listened, receives_nothing
from .record import TOPIC, Pair, Second, Talk

NO_SECOND = "a second talker publishes, or ends the first"
NO_NAME = "it ignores __name:=, by which roslaunch gives a node its name"


def scripts(submission: Submission) -> list[Script]:
    names = ("talker.py", "listener.py")
    paths = [find_script(submission, BEGINNER, name) for name in names]
    return [Script(submission, BEGINNER, path) for path in paths]


def _talk(submission: Submission) -> Talk:
    seen = submission.recording(record.talk, *(script.where for script in scripts(submission)))
    if not seen.master_alive:
        raise wrong_of(CutShort(MASTER_GONE))
    return seen


def _talk_of_two(submission: Submission) -> Talk:
    """Return the recording. Raises Wrong if one of the nodes has ended the other."""
    seen, programs = _talk(submission), scripts(submission)
    is_ended = seen.talker_ended or seen.listener_ended
    ended = (same_name(ran, programs) for ran in (seen.talker, seen.listener))
    wrong = next(filter(None, ended), None) if is_ended else None
    if wrong:
        raise wrong
    return seen


@check("C5", "talker.py and listener.py can be run", "3.1", needs="C2",
       look="rosrun beginner_tutorials talker.py", timeless=True)  # fmt: skip
def are_runnable(submission: Submission) -> Note | str:
    programs = scripts(submission)
    for script in programs:
        check_file(submission, BEGINNER, script.where)
    notes = (*(script.unusual_node_name() for script in programs), in_cpp(programs))
    return next(filter(None, notes), ", ".join(script.where for script in programs))


@check("C6", "the talker talks", "3.1", needs=are_runnable, look="rostopic hz /chatter")
def talker(submission: Submission) -> Note | str:
    seen, script = _talk_of_two(submission), scripts(submission)[0]
    talked = Talked(seen, script, submission.task.values.get("rate"))
    if not seen.received:
        raise silent(talked)
    if seen.talker_ended:
        raise script.crash(seen.talker, GOES_ON, script.facts.idioms.in_loop)
    return must_pass(RATE_DIAGNOSES, talked) or f"{talked.rate:.1f} Hz"


@check("C7", "the listener displays what it receives", "3.1", needs=are_runnable,
       look="rosrun beginner_tutorials listener.py")  # fmt: skip
def listener(submission: Submission) -> Note | None:
    seen, script = _talk_of_two(submission), scripts(submission)[1]
    if seen.listener_ended:
        raise script.end(seen.listener, GOES_ON)
    listened = Listened(seen, script)
    if not all(listened.times):
        raise receives_nothing(listened)
    return must_pass(DISPLAYED, listened)


@check("C8", "talker and listener are connected", "3.1", needs=(talker, listener),
       look="rosnode info /rosout; rqt_graph")  # fmt: skip
def graph(submission: Submission) -> str:
    seen = _talk(submission)
    if not seen.publishers.get(TOPIC) or not seen.subscribers.get(TOPIC):
        complaint, hint = "no such connection in the graph", "one name for the topic, in both"
        raise Wrong("talker -> /chatter -> listener", complaint, hint=hint)
    return f"{seen.publishers[TOPIC][0]} -> /chatter -> {seen.subscribers[TOPIC][0]}"


def _pair(submission: Submission) -> Pair:
    """Return the recording of two talkers; if a repeated one lacks it, raise as C6 or C7 do."""
    pair = _talk(submission).pair
    if not pair:
        talker(submission)
        listener(submission)
        raise Wrong(NO_SECOND, "neither", scripts(submission)[0].where)
    return pair


@check("C9", "anonymous names", "3.1", needs=(talker, listener, "C10"),
       look="rosnode list, with two talkers")  # fmt: skip
def anonymous(submission: Submission) -> Note | str:
    """Check two talkers as submitted, and copies with the opposite value of anonymous."""
    pair, script = _pair(submission), scripts(submission)[0]
    call, where = script.facts.first("init_node"), script.at_call("init_node")
    given = call.names.get("anonymous", "False") if call else ""
    if given == "True" and pair.first_ended:
        raise Wrong("two talkers side by side", "the second one ended the first", where)
    if given == "False" and pair.both and not pair.first_ended:
        raise Wrong("a second talker of the same name ends the first", "both continue", where)
    if not pair.both and not pair.first_ended:
        raise Wrong(NO_SECOND, "neither", script.where)
    other = _flipped(submission, script, given)
    if not other:
        return Note("anonymous cannot be changed by the checker here; try both yourself")
    if not other.talks:
        raise script.crash(other.first, "the talker runs with anonymous the other way round")
    if other.first_ended == (given == "False"):
        if not script.is_python:
            return Note(NO_NAME, where, "ros::init(argc, argv, ...) reads the command line")
        then = "the second ends the first" if given == "True" else "both continue"
        hint = f"is {script.facts.idioms.init_anonymous}?"
        raise Wrong(f"with anonymous={given == 'False'} {then}", "this did not happen", where, hint)
    return "as submitted, and the other way round"


def _flipped(submission: Submission, script: Script, given: str) -> Second | None:
    """Return the recording of two talkers with the opposite value of anonymous, if it can be made.

    A program in C++ is not changed, which would take another build: two of one __name:= are not
    anonymous, and two of different ones are as good as that.
    """
    if not script.is_python:
        names = ("one", "other") if given == "False" else ("talker", "talker")
        return submission.recording(record.second, script.where, "", *names)
    is_plain = given in ("True", "False")
    flipped = flipped_anonymous(script.text, given == "False") if is_plain else None
    return submission.recording(record.second, script.where, flipped) if flipped else None


@check("C10", "Ctrl-C ends both", "3.1", needs=(talker, listener), look="Ctrl-C in their terminals")
def ctrl_c(submission: Submission) -> Note | str:
    pair = _pair(submission)
    outputs = pair.second.output, _talk(submission).listener.output
    for script, taken_s, output in zip(scripts(submission), pair.taken_s, outputs):
        note = script.check_end(taken_s, output)
        if note:
            return note
    names = (script.name for script in scripts(submission))
    return ", ".join(f"{name} {s:.1f} s" for name, s in zip(names, pair.taken_s))
