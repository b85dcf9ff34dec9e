"""C5 to C10: talker and listener."""

from __future__ import annotations

import statistics

from tutorial_check import (
    MASTER_GONE,
    CutShort,
    Note,
    PythonFacts,
    Submission,
    Wrong,
    check,
    check_end,
    check_file,
    crash,
    ended,
    find_script,
    flipped_anonymous,
    odd_node,
    with_import,
    wrong_of,
)

from ..task import other_topic
from . import record
from .record import KIND, PACKAGE, STRINGS, TOPIC, Pair, Talk

LISTENS = "every text sent on /chatter, displayed once"
GOES_ON = "it goes on until Ctrl-C"
LOOP = "while not rospy.is_shutdown(): ..., rate.sleep() within it"
RATE_TOLERANCE = 0.2  # part of the expected rate
FEW = 3  # messages: too few for a rate


def scripts(submission: Submission) -> list[str]:
    return [find_script(submission, PACKAGE, name) for name in ("talker.py", "listener.py")]


def _talk(submission: Submission) -> Talk:
    seen = submission.recording(record.talk, *scripts(submission))
    if not seen.master_alive:
        raise wrong_of(CutShort(MASTER_GONE))
    return seen


@check("C5", "talker.py and listener.py can be run", "3.1", needs="C2",
       look="rosrun beginner_tutorials talker.py", timeless=True)  # fmt: skip
def files(submission: Submission) -> Note | str:
    for script in scripts(submission):
        check_file(submission, PACKAGE, script)
    notes = (odd_node(submission, PACKAGE, script) for script in scripts(submission))
    return next(filter(None, notes), ", ".join(scripts(submission)))


@check("C6", "the talker talks", "3.1", needs=files, look="rostopic hz /chatter")
def talker(submission: Submission) -> Note | str:
    seen, script = _talk(submission), scripts(submission)[0]
    facts, wanted = submission.scripts(PACKAGE)[script], submission.task.values.get("rate")
    often = "about 10 times a second" if wanted is None else "as often as rate says"
    expected = f"std_msgs/String on /chatter, {often}"
    if not seen.received:
        raise _silent(submission, seen, script, facts, expected)
    if seen.talker_ended:
        raise crash(submission, PACKAGE, seen.talker, GOES_ON, LOOP)
    times = [when for when, caller, _ in seen.received if caller == seen.received[0][1]]
    if len(times) < FEW and not wanted:
        return Note(f"{len(times)} messages in {record.LISTEN_S + 2:.0f} s: slower than 1 Hz")
    steps = [b - a for a, b in zip(times, times[1:])] or [record.LISTEN_S]
    rate = 1 / max(1e-6, statistics.median(steps))
    # Where we come late for some, they come at once; but not more of them than were sent.
    if min(rate, (len(times) - 1) / max(1e-6, times[-1] - times[0])) > 150:
        words = f"{f'{rate:.0f}' if rate < 1000 else 'thousands of'} messages a second"
        where = f"{script}:{facts.loops[0]}" if facts.loops else script
        raise Wrong(expected, words, where, "rate.sleep() is missing within the loop", sure=True)
    if wanted and not abs(rate / wanted - 1) < RATE_TOLERANCE:
        call = facts.first("Rate")
        where = f"{script}:{call.line}" if call else script
        raise Wrong(expected, f"{rate:.1f} times a second", where, f"rospy.Rate({wanted})")
    texts = {value for _, _, value in seen.received}
    if len(texts) == 1:
        return Note(f"always the same text, {texts.pop()!r}; the handout's has the time in it")
    is_as_asked = wanted or 8 <= rate <= 12
    return f"{rate:.1f} Hz" if is_as_asked else Note(f"{rate:.1f} Hz, the handout's is 10")


def _silent(
    submission: Submission, seen: Talk, script: str, facts: PythonFacts, expected: str
) -> Wrong:
    ends = seen.talker_ended
    loops = ", and does it loop: while not rospy.is_shutdown()" if facts.has_main else ""
    hint = f"does the last line call talker(){loops}?"
    wrong = ended(crash(submission, PACKAGE, seen.talker, expected, hint), facts, script)
    if "Traceback" in seen.talker.output or seen.talker.spins:
        return wrong
    hint = with_import("rospy.Publisher('chatter', String, queue_size=10)", "String", facts)
    hint += f"; and {LOOP}" if ends else ""
    so = ", and it ends by itself" if ends else ""
    made = facts.first("Publisher")
    where = f"{script}:{made.line if made else 1}"
    kind, refused = seen.published.get(TOPIC, ""), any("datatype" in w for w in seen.warnings)
    if kind and (kind != KIND or refused):
        return Wrong(expected, f"/chatter carries {kind}{so}", where, hint, sure=True)
    sent_on = other_topic(seen.published, TOPIC, seen.published, KIND)
    if sent_on:
        return Wrong(expected, f"it publishes on {sent_on}{so}", where, hint)
    hint = "is publish(...) called within the loop?"
    return wrong if ends else Wrong(expected, "not one message", script, hint)


@check("C7", "the listener displays what it receives", "3.1", needs=files,
       look="rosrun beginner_tutorials listener.py")  # fmt: skip
def listener(submission: Submission) -> Note | None:
    seen, script = _talk(submission), scripts(submission)[1]
    facts = submission.scripts(PACKAGE)[script]
    if seen.listener_ended:
        raise ended(crash(submission, PACKAGE, seen.listener, GOES_ON), facts, script)
    lines = seen.listener.output.splitlines()  # with or without colours or a separator
    times = [sum(text in line for line in lines) for text in STRINGS]
    if not all(times):
        raise _deaf(submission, seen, script, facts, sum(map(bool, times)))
    if min(times) < 2:
        return None
    subscribers = [call.line for call in facts.calls.get("Subscriber", [])]
    called = facts.called_back
    shown = sorted(called.get("print", []) + called.get("loginfo", []))
    second = next((each[1] for each in (subscribers, shown) if len(each) > 1), 0)
    where = f"{script}:{second}" if second else script
    hint = "one Subscriber, and one rospy.loginfo in its callback, are enough"
    return Note(f"each text is displayed {min(times)} times", where, hint)


def _deaf(
    submission: Submission, seen: Talk, script: str, facts: PythonFacts, displayed: int
) -> Wrong:
    if "Traceback" in seen.listener.output or seen.listener.spins:
        return crash(submission, PACKAGE, seen.listener, LISTENS)
    hint = with_import("rospy.Subscriber('chatter', String, callback)", "String", facts)
    asked, lacking = facts.first("Subscriber"), facts.without_callback
    where = f"{script}:{asked.line}" if asked else script
    heard_on = other_topic(seen.subscribers, TOPIC, seen.types, KIND)
    if TOPIC not in seen.subscribers and heard_on:
        words, hint = f"it subscribes to {heard_on}", "the topic is called chatter"
        return Wrong(LISTENS, words, where, hint, sure=True)
    if TOPIC not in seen.subscribers:
        return Wrong(LISTENS, "it subscribes to nothing", where, f"{hint}, before rospy.spin()")
    if not displayed and lacking:
        words = "its Subscriber has no callback"
        return Wrong(LISTENS, words, f"{script}:{lacking.line}", hint, sure=True)
    # The type that it asks for; rospy says whose types differ.
    kind = asked.words[1].rpartition(".")[2] if asked and len(asked.words) > 1 else "String"
    refused = any("datatype" in line and "chatter" in line for line in seen.warnings)
    if kind != "String" or refused:
        kind = "another type of message" if kind == "String" else kind
        return Wrong(LISTENS, f"it wants {kind} on /chatter", where, hint)
    hint = "does callback(data) display data.data, with rospy.loginfo?"
    return Wrong(LISTENS, f"{displayed} of {len(STRINGS)} displayed", where, hint)


@check("C8", "talker and listener are connected", "3.1", needs=(talker, listener),
       look="rosnode info /rosout; rqt_graph")  # fmt: skip
def graph(submission: Submission) -> str:
    seen = _talk(submission)
    if not seen.publishers.get(TOPIC) or not seen.subscribers.get(TOPIC):
        complaint, hint = "no such way in the graph", "one name for the topic, in both"
        raise Wrong("talker -> /chatter -> listener", complaint, hint=hint)
    return f"{seen.publishers[TOPIC][0]} -> /chatter -> {seen.subscribers[TOPIC][0]}"


def _pair(submission: Submission) -> Pair:
    """Return the two talkers; if a second recording came to none, C6 or C7 says why."""
    pair = _talk(submission).pair
    if not pair:
        talker(submission)
        listener(submission)
        raise Wrong(
            "a second talker publishes, or ends the first", "neither", scripts(submission)[0]
        )
    return pair


@check("C9", "anonymous names", "3.1", needs=(talker, listener, "C10"),
       look="rosnode list, with two talkers")  # fmt: skip
def anonymous(submission: Submission) -> Note | str:
    """Look at two talkers as submitted, and with anonymous the other way round in a copy."""
    pair, script = _pair(submission), scripts(submission)[0]
    call = submission.scripts(PACKAGE)[script].first("init_node")
    where = f"{script}:{call.line}" if call else script
    given = call.names.get("anonymous", "False") if call else ""
    if given == "True" and pair.first_ended:
        raise Wrong("two talkers side by side", "the second one ended the first", where)
    if given == "False" and pair.both and not pair.first_ended:
        raise Wrong("the second talker of one name ends the first", "both go on", where)
    if not pair.both and not pair.first_ended:
        raise Wrong("a second talker publishes, or ends the first", "neither", script)
    text, is_plain = submission.text(PACKAGE, script), given in ("True", "False")
    flipped = flipped_anonymous(text, given == "False") if is_plain else None
    if not flipped:
        return Note("anonymous cannot be changed by the checker here; try both yourself")
    other = submission.recording(record.second, script, flipped)
    if not other.talks:
        expected = "the talker runs with anonymous the other way round"
        raise crash(submission, PACKAGE, other.first, expected)
    if other.first_ended == (given == "False"):
        then = "the second ends the first" if given == "True" else "both live"
        hint = "is anonymous given to rospy.init_node?"
        raise Wrong(f"with anonymous={given == 'False'} {then}", "it was not so", where, hint)
    return "as submitted, and the other way round"


@check("C10", "Ctrl-C ends both", "3.1", needs=(talker, listener), look="Ctrl-C in their terminals")
def ctrl_c(submission: Submission) -> Note | str:
    pair = _pair(submission)
    programs = pair.second, _talk(submission).listener
    for script, program, taken_s in zip(scripts(submission), programs, pair.taken_s):
        note = check_end(submission, PACKAGE, script, taken_s, program.output)
        if note:
            return note
    return ", ".join(f"{n} {s:.1f} s" for n, s in zip(("talker.py", "listener.py"), pair.taken_s))
