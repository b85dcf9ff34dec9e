"""C13 to C18, C34: the program joy2twist.py, first and second version."""

from __future__ import annotations

import re

from tutorial_check.course import check
from tutorial_check.handout.s4_3 import diagnoses
from tutorial_check.handout.s4_3.drive import Drive
from tutorial_check.handout.s4_3.record import JOY, drive, found, loaded
from tutorial_check.handout.task import PACKAGE
from tutorial_check.judge.scripts import check_end, check_file, find_script, odd_node
from tutorial_check.model import Note, Wrong
from tutorial_check.record.session import Session

NAME = "joy2twist.py"
ORDER = ("Subscriber", "Publisher")


def main_script(session: Session) -> str:
    """Return the program that turns Joy into Twist: not joy2twist.py if that is the first version."""
    script, scripts = find_script(session, PACKAGE, NAME), session.scripts(PACKAGE)
    facts = scripts.get(script)
    if facts is None:
        return script  # no Python, as C13 says
    is_first = "Subscriber" in facts.calls and not {"Publisher", "publish"} & set(facts.calls)
    is_whole = any(name.startswith("sensor_msgs.msg") for name in facts.imports)
    if is_first and is_whole and "geometry_msgs.msg.Twist" not in facts.imports:
        both = [p for p, f in scripts.items() if {"Publisher", "Subscriber"} <= set(f.calls)]
        # A class comes last: that is section 6.2.
        return min(both, key=lambda p: any(c.is_node for c in scripts[p].classes), default=script)
    return script


def check_manifest(session: Session, script: str) -> None:
    """Check that roslib.load_manifest names a package that exists. Raises Wrong."""
    facts = session.scripts(PACKAGE).get(script)
    call = facts.first("load_manifest") if facts else None
    if not facts or not call or not call.words or call.words[0] in facts.names:
        return  # PKG = "joy2twist": what is in it shows when the program runs
    if any(each.name == call.words[0] for each in session.packages):
        return
    if not session.recording(found, call.words[0]).found:
        expected = "roslib.load_manifest names a package that exists"
        hint = f"load_manifest('{session.task.named(PACKAGE)}'); or leave the line out: catkin needs it no more"
        seen = f"ResourceNotFound: {call.words[0]}"
        raise Wrong(expected, seen, f"{script}:{call.line}", hint)


def _seen(session: Session) -> Drive:
    return session.recording(drive, main_script(session))


@check("C13", "joy2twist.py can be run", "4.3", "C12", look="rosrun {n.package} joy2twist.py",
       timeless=True)  # fmt: skip
def file(session: Session) -> Note | str:
    script = find_script(session, PACKAGE, NAME)
    check_file(session, PACKAGE, script)  # before its text is relied on
    check_manifest(session, script)
    main = main_script(session)
    if main != script:
        check_file(session, PACKAGE, main)
        check_manifest(session, main)
    return odd_node(session, PACKAGE, main) or main


@check("C14", "it displays every Joy", "4.3", "C13",
       look="rosrun {n.package} joy2twist.py; rostopic echo {n.joy}")  # fmt: skip
def displays(session: Session) -> Note | None:
    return diagnoses.check_displays(session, _seen(session))


@check("C15", "{n.joy} in, {n.cmd_vel} out", "4.3", "C13", look="rosnode info NODE")
def topics(session: Session) -> Note | str:
    seen = _seen(session)
    about = diagnoses.check_topics(session, seen)
    name = session.task.values.get("node")
    node = seen.subscribers.get(session.task.topic(JOY), [""])[0]
    if name and not re.fullmatch(rf"/{name}(_\d+_\d+)?", node):
        call = session.scripts(PACKAGE)[seen.script].first("init_node")
        where = f"{seen.script}:{call.line}" if call else seen.script
        expected, hint = "the name of the node that the task asks for", f"init_node('{name}')"
        raise Wrong(expected, f"it is called {node}", where, hint)
    return about


@check("C16", "{n.sticks[1]} drives forwards, {n.sticks[0]} turns", "4.3", "C15",
       look="rostopic echo {n.cmd_vel}")  # fmt: skip
def mapping(session: Session) -> Note | None:
    return diagnoses.check_mapping(session, _seen(session))


@check("C17", "it keeps up with the joystick", "4.3", "C16", look="rostopic hz {n.cmd_vel}")
def rate(session: Session) -> Note | str | None:
    return diagnoses.check_rate(session, _seen(session))


@check("C34", "Ctrl-C ends it", "4.3", "C16", look="Ctrl-C in its terminal")
def ctrl_c(session: Session) -> Note | str:
    seen = _seen(session)
    note = check_end(session, PACKAGE, seen.script, seen.taken_s, seen.last_words)
    return note or f"{seen.taken_s:.1f} s"


@check("C18", "it starts while the joystick sends", "4.3", "C16",
       look="rosbag play --loop joy.bag; rosrun {n.package} joy2twist.py")  # fmt: skip
def under_load(session: Session) -> Note | None:
    """Start it while 200 Joys a second come. Never a failure."""
    script = main_script(session)
    facts = session.scripts(PACKAGE)[script]
    first, second = (call.line if call else 0 for call in map(facts.first, ORDER))
    if not 0 < first < second and not session.recording(loaded, script).failed:
        return None
    seen = "the subscriber comes before the publisher: a Joy that comes at once finds no pub"
    where, hint = f"{script}:{first or 1}", "first the Publisher, then the Subscriber"
    return Note(f"{seen} (the handout has it so)", where, hint)
