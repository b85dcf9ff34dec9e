"""C5 to C10: talker and listener."""

from __future__ import annotations

import statistics
from typing import Iterable, Mapping

from tutorial_check.course import check
from tutorial_check.handout.changed_programs import flipped_anonymous
from tutorial_check.handout.s3.record import (
    KIND,
    LISTEN_S,
    OF_ALL,
    PACKAGE,
    STRINGS,
    TOPIC,
    Pair,
    Talk,
    second,
    talk,
)
from tutorial_check.isolation.program import Ran
from tutorial_check.judge.causes import with_import
from tutorial_check.judge.rows import Row, demand
from tutorial_check.judge.scripts import (
    check_end,
    check_file,
    crash,
    find_script,
    odd_node,
    with_end,
)
from tutorial_check.model import Note, Wrong, master_gone
from tutorial_check.record.session import Session

LISTENS = "every text sent on /chatter, displayed once"
GOES_ON = "it goes on until Ctrl-C"
LOOP = "while not rospy.is_shutdown(): ..., rate.sleep() within it"
RATE_TOLERANCE = 0.2  # part of the expected rate
FEW = 3  # messages: too few for a rate


def other_topic(topics: Iterable[str], asked_for: str, types: Mapping[str, str], kind: str) -> str:
    """Return another topic than the one asked for, with its type if that is another; or empty."""
    topic = min(set(topics) - {asked_for, *OF_ALL}, default="")
    return topic if types.get(topic, kind) == kind else f"{topic}, of type {types[topic]}"


class Half:
    """One of the two programs in a Talk: facts of the rows below."""

    def __init__(self, session: Session, talk: Talk, script: str, program: Ran) -> None:
        """Raise Wrong if the master has gone."""
        if not talk.master_alive:
            raise master_gone()
        self.session, self.talk, self.script, self.program = session, talk, script, program
        self.facts = session.scripts(PACKAGE)[script]
        self.has_failed = "Traceback" in program.output or program.spins
        # rospy says whose types differ.
        self.refused = [line for line in talk.warnings if "datatype" in line]

    def crash(self, expected: str, hint: str = "") -> Wrong:
        wrong = crash(self.session, PACKAGE, self.program, expected, hint)
        return with_end(wrong, self.facts, self.script)


class Talker(Half):
    """The talker, as it was recorded."""

    def __init__(self, session: Session) -> None:
        talk = _talk(session)
        super().__init__(session, talk, scripts(session)[0], talk.talker)
        line = "rospy.Publisher('chatter', String, queue_size=10)"
        made = self.facts.first("Publisher")
        self.place = f"{self.script}:{made.line if made else 1}"
        kind = talk.published.get(TOPIC, KIND)
        self.carried = kind if kind != KIND or (self.refused and TOPIC in talk.published) else ""
        self.sent_on = other_topic(talk.published, TOPIC, talk.published, KIND)
        ends = talk.talker_ended and not self.has_failed
        self.end = ", and it ends by itself" if ends else ""
        self.todo = with_import(line, "String", self.facts) + (f"; and {LOOP}" if ends else "")

    def silent(self) -> Wrong:
        loops = ", and does it loop: while not rospy.is_shutdown()" if self.facts.has_main else ""
        return self.crash(talks(self.session), f"does the last line call talker(){loops}?")


class Listener(Half):
    """The listener, as it was recorded."""

    def __init__(self, session: Session) -> None:
        talk = _talk(session)
        super().__init__(session, talk, scripts(session)[1], talk.listener)
        line = "rospy.Subscriber('chatter', String, callback)"
        self.todo = with_import(line, "String", self.facts)
        asked = self.facts.first("Subscriber")
        self.place = f"{self.script}:{asked.line}" if asked else self.script
        heard_on = other_topic(talk.subscribers, TOPIC, talk.types, KIND)
        self.heard_on = TOPIC not in talk.subscribers and heard_on
        # The type that it asks for, where that is no String.
        kind = asked.words[1].rpartition(".")[2] if asked and len(asked.words) > 1 else "String"
        other = any("chatter" in line for line in self.refused) and "another type of message"
        self.wanted = kind if kind != "String" else other
        # With or without colours or a separator.
        lines = self.program.output.splitlines()
        self.times = [sum(text in line for line in lines) for text in STRINGS]

    @property
    def found(self) -> int:
        return sum(map(bool, self.times))

    @property
    def second_line(self) -> str:
        """Where a text is displayed for the second time."""
        subscribers = [call.line for call in self.facts.calls.get("Subscriber", [])]
        called = self.facts.called_back
        shown = sorted(called.get("print", []) + called.get("loginfo", []))
        lines = (each[1] for each in (subscribers, shown) if len(each) > 1)
        return next((f"{self.script}:{line}" for line in lines), self.script)


SILENT_TALKER = (
    Row(lambda h: h.has_failed, lambda h: h.silent()),
    Row(lambda h: h.carried, "/chatter carries {found}{f.end}", "{f.todo}", "{f.place}", sure=True),
    Row(lambda h: h.sent_on, "it publishes on {found}{f.end}", "{f.todo}", "{f.place}"),
    Row(lambda h: h.talk.talker_ended, lambda h: h.silent()),
    Row(lambda h: True, "not one message", "is publish(...) called within the loop?", "{f.script}"),
)  # fmt: skip
DEAF_LISTENER = (
    Row(lambda h: h.has_failed, lambda h: crash(h.session, PACKAGE, h.program, LISTENS)),
    Row(lambda h: h.heard_on, "it subscribes to {found}", "the topic is called chatter",
        "{f.place}", sure=True),
    Row(lambda h: TOPIC not in h.talk.subscribers, "it subscribes to nothing",
        "{f.todo}, before rospy.spin()", "{f.place}"),
    Row(lambda h: not h.found and h.facts.without_callback, "its Subscriber has no callback",
        "{f.todo}", "{f.script}:{found.line}", sure=True),
    Row(lambda h: h.wanted, "it wants {found} on /chatter", "{f.todo}", "{f.place}"),
    Row(lambda h: len(h.times), "{f.found} of {found} displayed",
        "does callback(data) display data.data, with rospy.loginfo?", "{f.place}"),
)  # fmt: skip


def talks(session: Session) -> str:
    """Return what is expected of the talker."""
    often = "as often as rate says" if "rate" in session.task.values else "about 10 times a second"
    return f"std_msgs/String on /chatter, {often}"


def scripts(session: Session) -> list[str]:
    return [find_script(session, PACKAGE, name) for name in ("talker.py", "listener.py")]


def _talk(session: Session) -> Talk:
    return session.recording(talk, *scripts(session))


@check("C5", "talker.py and listener.py can be run", "3.1", "C2",
       look="rosrun beginner_tutorials talker.py", timeless=True)  # fmt: skip
def files(session: Session) -> Note | str:
    for script in scripts(session):
        check_file(session, PACKAGE, script)
    notes = (odd_node(session, PACKAGE, script) for script in scripts(session))
    return next(filter(None, notes), ", ".join(scripts(session)))


@check("C6", "the talker talks", "3.1", "C5", look="rostopic hz /chatter")
def talker(session: Session) -> Note | str:
    half = Talker(session)
    seen, facts = half.talk, half.facts
    if not seen.received:
        demand(SILENT_TALKER, half, talks(session))
    if seen.talker_ended:
        raise crash(session, PACKAGE, half.program, GOES_ON, LOOP)
    times = [when for when, caller, _ in seen.received if caller == seen.received[0][1]]
    wanted = session.task.values.get("rate")
    if len(times) < FEW and not wanted:
        return Note(f"{len(times)} messages in {LISTEN_S + 2:.0f} s: slower than 1 Hz")
    steps = [b - a for a, b in zip(times, times[1:])] or [LISTEN_S]
    rate = 1 / max(1e-6, statistics.median(steps))
    # Where we come late for some, they come at once; but not more of them than were sent.
    if min(rate, (len(times) - 1) / max(1e-6, times[-1] - times[0])) > 150:
        words = f"{f'{rate:.0f}' if rate < 1000 else 'thousands of'} messages a second"
        where = f"{half.script}:{facts.loops[0]}" if facts.loops else half.script
        raise Wrong(
            talks(session), words, where, "rate.sleep() is missing within the loop", sure=True
        )
    if wanted and not abs(rate / wanted - 1) < RATE_TOLERANCE:
        call = facts.first("Rate")
        where = f"{half.script}:{call.line}" if call else half.script
        raise Wrong(talks(session), f"{rate:.1f} times a second", where, f"rospy.Rate({wanted})")
    texts = {value for _, _, value in seen.received}
    if len(texts) == 1:
        return Note(f"always the same text, {texts.pop()!r}; the handout's has the time in it")
    is_as_asked = wanted or 8 <= rate <= 12
    return f"{rate:.1f} Hz" if is_as_asked else Note(f"{rate:.1f} Hz, the handout's is 10")


@check("C7", "the listener displays what it receives", "3.1", "C5",
       look="rosrun beginner_tutorials listener.py")  # fmt: skip
def listener(session: Session) -> Note | None:
    half = Listener(session)
    if half.talk.listener_ended:
        raise half.crash(GOES_ON)
    if half.found < len(STRINGS):
        demand(DEAF_LISTENER, half, LISTENS)
    if min(half.times) < 2:
        return None
    hint = "one Subscriber, and one rospy.loginfo in its callback, are enough"
    return Note(f"each text is displayed {min(half.times)} times", half.second_line, hint)


@check("C8", "talker and listener are connected", "3.1", "C6 C7",
       look="rosnode info /rosout; rqt_graph")  # fmt: skip
def graph(session: Session) -> str:
    seen = _talk(session)
    if not seen.publishers.get(TOPIC) or not seen.subscribers.get(TOPIC):
        complaint, hint = "no such way in the graph", "one name for the topic, in both"
        raise Wrong("talker -> /chatter -> listener", complaint, hint=hint)
    return f"{seen.publishers[TOPIC][0]} -> /chatter -> {seen.subscribers[TOPIC][0]}"


def _pair(session: Session) -> Pair:
    """Return the two talkers; if a second recording came to none, C6 or C7 says why."""
    pair = _talk(session).pair
    if not pair:
        talker(session)
        listener(session)
        raise Wrong("a second talker publishes, or ends the first", "neither", scripts(session)[0])
    return pair


@check("C9", "anonymous names", "3.1", "C6 C7 C10", look="rosnode list, with two talkers")
def anonymous(session: Session) -> Note | str:
    """Look at two talkers as submitted, and with anonymous the other way round in a copy."""
    pair, script = _pair(session), scripts(session)[0]
    call = session.scripts(PACKAGE)[script].first("init_node")
    where = f"{script}:{call.line}" if call else script
    given = call.names.get("anonymous", "False") if call else ""
    if given == "True" and pair.first_ended:
        raise Wrong("two talkers side by side", "the second one ended the first", where)
    if given == "False" and pair.both and not pair.first_ended:
        raise Wrong("the second talker of one name ends the first", "both go on", where)
    if not pair.both and not pair.first_ended:
        raise Wrong("a second talker publishes, or ends the first", "neither", script)
    flipped = None
    if given in ("True", "False"):
        flipped = flipped_anonymous(session.text(PACKAGE, script), given == "False")
    if not flipped:
        return Note("anonymous cannot be changed by the checker here; try both yourself")
    other = session.recording(second, script, flipped)
    if not other.talks:
        expected = "the talker runs with anonymous the other way round"
        raise crash(session, PACKAGE, other.first, expected)
    if other.first_ended == (given == "False"):
        then = "the second ends the first" if given == "True" else "both live"
        hint = "is anonymous given to rospy.init_node?"
        raise Wrong(f"with anonymous={given == 'False'} {then}", "it was not so", where, hint)
    return "as submitted, and the other way round"


@check("C10", "Ctrl-C ends both", "3.1", "C6 C7", look="Ctrl-C in their terminals")
def ctrl_c(session: Session) -> Note | str:
    pair = _pair(session)
    programs = pair.second, _talk(session).listener
    for script, program, taken_s in zip(scripts(session), programs, pair.taken_s):
        note = check_end(session, PACKAGE, script, taken_s, program.output)
        if note:
            return note
    return ", ".join(f"{n} {s:.1f} s" for n, s in zip(("talker.py", "listener.py"), pair.taken_s))
