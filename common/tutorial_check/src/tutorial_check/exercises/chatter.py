"""C5 to C10: talker and listener."""

import statistics

from tutorial_check.causes import with_import
from tutorial_check.changed_programs import flipped_anonymous
from tutorial_check.exercises.files import check_end, check_file, crash, find_script, odd_node
from tutorial_check.exercises.silent_end import sunken_main
from tutorial_check.exercises.talking import LISTEN_S, PACKAGE, TOPIC, scripts, talk_of
from tutorial_check.model import Note, Wrong, master_gone

PUBLISHER_LINE = "rospy.Publisher('chatter', String, queue_size=10)"
SUBSCRIBER_LINE = "rospy.Subscriber('chatter', String, callback)"


def files(session):
    """C5."""
    for script in scripts(session):
        check_file(session, PACKAGE, script)
    notes = [odd_node(session, PACKAGE, script) for script in scripts(session)]
    return next(filter(None, notes), ", ".join(scripts(session)))


def _facts(session, script):
    return session.scripts(PACKAGE)[script]


def _check_master(talk):
    if not talk.master_alive:
        raise master_gone()


def _is_meant(call, topic):
    """Whether the first topic of that kind in the program is this one; call may be None."""
    return call is not None and call.words[:1] in ([topic], [topic.lstrip("/")])


def talker(session):
    """C6."""
    talk = talk_of(session)
    _check_master(talk)
    script, _ = scripts(session)
    expected = "std_msgs/String on /chatter, about 10 times a second"
    program = talk.talkers[0]
    facts = _facts(session, script)
    if not talk.heard:
        made = facts.first("Publisher")
        if talk.talker_ended or "Traceback" in program.output or program.spins:
            place, hint = sunken_main(facts, script)
            if not facts.has_main:
                hint = "does the last line call talker()?"
            wrong = crash(
                session,
                PACKAGE,
                program,
                expected,
                hint
                or "does the last line call talker(), and does it loop: while not rospy.is_shutdown()?",
            )
            wrong.where = wrong.where or place
            raise wrong
        topics = sorted(topic for topic in talk.publishers if topic not in (TOPIC, "/rosout"))
        if (
            TOPIC in talk.publishers
            and talk.types.get(TOPIC, "std_msgs/String") != "std_msgs/String"
        ) or any("datatype" in line for line in talk.warnings):
            raise Wrong(
                expected,
                f"/chatter carries {talk.types.get(TOPIC)}",
                where=f"{script}:{made.line if made else 1}",
                hint=with_import(PUBLISHER_LINE, "String", facts),
                sure=TOPIC in talk.publishers,
            )
        if topics:
            raise Wrong(
                expected,
                f"it publishes on {topics[0]}",
                where=f"{script}:{made.line if made else 1}",
                hint="the topic is called chatter",
                sure=_is_meant(made, topics[0]),
            )
        raise Wrong(
            expected,
            "not one message",
            where=script,
            hint="is publish(...) called within the loop?",
        )
    texts = {value for _, _, value in talk.heard}
    if talk.talker_ended:
        raise crash(
            session,
            PACKAGE,
            program,
            "it goes on until Ctrl-C",
            "while not rospy.is_shutdown(): ..., rate.sleep() within it",
        )
    times = [when for when, caller, _ in talk.heard if caller == talk.heard[0][1]]
    if len(times) < 3:
        return Note(f"{len(times)} messages in {LISTEN_S + 2:.0f} s: slower than 1 Hz")
    rate = 1 / max(1e-6, statistics.median(b - a for a, b in zip(times, times[1:])))
    # Where we come late for some, they come at once; but not more of them than were sent.
    if min(rate, (len(times) - 1) / max(1e-6, times[-1] - times[0])) > 150:
        told = f"{rate:.0f}" if rate < 1000 else "thousands of"
        raise Wrong(
            expected,
            f"{told} messages a second",
            where=f"{script}:{facts.loops[0]}" if facts.loops else script,
            hint="rate.sleep() is missing within the loop",
            sure=True,
        )
    if len(texts) == 1:
        return Note(f"always the same text, {texts.pop()!r}; the handout's has the time in it")
    if not 8 <= rate <= 12:
        return Note(f"{rate:.1f} Hz, the handout's is 10")
    return f"{rate:.1f} Hz"


def listener(session):
    """C7."""
    talk = talk_of(session)
    _check_master(talk)
    _, script = scripts(session)
    program = talk.listener
    facts = _facts(session, script)
    expected = "every text sent on /chatter, displayed once"
    if talk.listener_ended:
        has_spin = "spin" in facts.calls
        bare = [line for line, text in facts.bare_names if text.endswith("spin")]
        place, hint = sunken_main(facts, script)
        hint = hint or (
            "rospy.spin() at the end of listener() keeps it alive"
            if not has_spin
            else "does the last line call listener()?"
        )
        wrong = crash(session, PACKAGE, program, "it goes on until Ctrl-C", hint)
        wrong.where = wrong.where or place
        if bare and not wrong.where:
            wrong.where, wrong.hint = f"{script}:{bare[0]}", "rospy.spin needs its (): rospy.spin()"
        raise wrong
    # Coloured or not, with or without a separator: the text itself is looked for.
    found = [text for text in talk.strings if text in program.output]
    if len(found) == len(talk.strings):
        return _repeated(talk, facts, script)
    if "Traceback" in program.output or program.spins:
        raise crash(session, PACKAGE, program, expected)
    call = facts.first("Subscriber")
    where = f"{script}:{call.line}" if call else script
    if TOPIC not in talk.subscribers:
        others = sorted(set(talk.subscribers) - {"/rosout"})
        raise Wrong(
            expected,
            f"it subscribes to {others[0] if others else 'nothing'}",
            where=where,
            hint="the topic is called chatter"
            if others
            else f"{SUBSCRIBER_LINE}, before rospy.spin()",
            sure=bool(others) and _is_meant(call, others[0]),
        )
    if facts.deaf and not found:
        raise Wrong(
            expected,
            "its Subscriber has no callback",
            where=f"{script}:{facts.deaf.line}",
            hint=SUBSCRIBER_LINE,
            sure=True,
        )
    kind = call.words[1].rpartition(".")[2] if call and len(call.words) > 1 else "String"
    refused = any("datatype" in line and "chatter" in line for line in talk.warnings)
    if kind != "String" or refused:
        seen = f"it wants {kind if kind != 'String' else 'another type of message'} on /chatter"
        raise Wrong(expected, seen, where=where, hint=with_import(SUBSCRIBER_LINE, "String", facts))
    raise Wrong(
        expected,
        f"{len(found)} of {len(talk.strings)} displayed",
        where=where,
        hint="does callback(data) display data.data, with rospy.loginfo?",
    )


def _repeated(talk, facts, script):
    """A Note if every text is displayed several times; else None."""
    lines = talk.listener.output.splitlines()
    times = min(sum(text in line for line in lines) for text in talk.strings)
    if times < 2:
        return None
    shown = sorted(
        line for name in ("print", "loginfo") for line in facts.called_back.get(name, [])
    )
    subscribers = [call.line for call in facts.calls.get("Subscriber", [])]
    line = next((each[1] for each in (subscribers, shown) if len(each) > 1), 0)
    return Note(
        f"each text is displayed {times} times",
        f"{script}:{line}" if line else script,
        "one Subscriber, and one rospy.loginfo in its callback, are enough",
    )


def graph(session):
    """C8."""
    talk = talk_of(session)
    if not talk.publishers.get(TOPIC) or not talk.subscribers.get(TOPIC):
        raise Wrong(
            "talker -> /chatter -> listener",
            "no such way in the graph",
            hint="one name for the topic, in both",
        )
    return f"{talk.publishers[TOPIC][0]} -> /chatter -> {talk.subscribers[TOPIC][0]}"


def _whole_talk(session):
    """The Talk; if it came to no second talker, as may be in a second look, C6 or C7 says why."""
    talk = talk_of(session)
    if not talk.taken:
        talker(session)
        listener(session)
    return talk


def anonymous(session):
    """C9: as submitted, and with anonymous the other way round in a copy."""
    script, _ = scripts(session)
    talk = _whole_talk(session)
    call = _facts(session, script).first("init_node")
    is_anonymous = bool(call) and call.names.get("anonymous") == "True"
    knows = bool(call) and call.names.get("anonymous", "False") in ("True", "False")
    if is_anonymous and talk.first_ended:
        raise Wrong(
            "two talkers side by side",
            "the second one ended the first",
            where=f"{script}:{call.line}",
        )
    if knows and not is_anonymous and talk.both and not talk.first_ended:
        raise Wrong(
            "the second talker of one name ends the first",
            "both go on",
            where=f"{script}:{call.line}",
        )
    if not talk.both and not talk.first_ended:
        raise Wrong("a second talker speaks, or ends the first", "neither", where=script)
    flipped = flipped_anonymous(session.text(PACKAGE, script), not is_anonymous) if knows else None
    if not flipped:
        return Note("anonymous cannot be changed by the checker here; try both yourself")
    ended = _second_ends_first(session, session.sibling(PACKAGE, script, flipped))
    if ended == (not is_anonymous):
        raise Wrong(
            f"with anonymous={not is_anonymous} "
            + ("both live" if not is_anonymous else "the second ends the first"),
            "it was not so",
            where=f"{script}:{call.line}",
            hint="is anonymous given to rospy.init_node?",
        )
    return "as submitted, and the other way round"


def _second_ends_first(session, script):
    with session.stage() as stage:
        stage.call("listen", TOPIC, "String")
        first = stage.start(PACKAGE, script)
        talks = stage.wait_for_start(lambda: stage.call("count", TOPIC) or first.ended)
        if first.ended or not talks:
            raise crash(
                session, PACKAGE, first, "the talker runs with anonymous the other way round"
            )
        caller = stage.call("heard", TOPIC)[0][1]
        second = stage.start(PACKAGE, script)

        def settled():
            callers = {who for _, who, _ in stage.call("heard", TOPIC)}
            return first.ended or second.ended or callers - {caller}

        stage.wait_for_start(settled)
        return first.ended


def ctrl_c(session):
    """C10."""
    talk = _whole_talk(session)
    for name, program in (("talker.py", talk.talkers[-1]), ("listener.py", talk.listener)):
        script = find_script(session, PACKAGE, name)
        note = check_end(session, PACKAGE, script, talk.taken[name], program.output)
        if note:
            return note
    return ", ".join(f"{name} {taken:.1f} s" for name, taken in talk.taken.items())
