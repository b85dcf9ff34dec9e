"""C13 to C18: the program joy2twist.py, first and second version."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from tutorial_check.exercises import check, conversation
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL, PACKAGE, drive
from tutorial_check.exercises.files import check_end, check_file, find_script, odd_node
from tutorial_check.model import Note, Wrong
from tutorial_check.stage import START_S

if TYPE_CHECKING:
    from tutorial_check.session import Session


NAME = "joy2twist.py"
STARTS = 10  # under load, all at once


def main_script(session: Session) -> Any:
    """Return the program that turns Joy into Twist: joy2twist.py, unless that is the first version still."""
    script = find_script(session, PACKAGE, NAME)
    scripts = session.scripts(PACKAGE)
    facts = scripts.get(script)
    if facts is None:
        return script  # no Python, as C13 says
    is_first = "Subscriber" in facts.calls and not {"Publisher", "publish"} & set(facts.calls)
    is_whole = any(name.startswith("sensor_msgs.msg") for name in facts.imports)
    if is_first and is_whole and "geometry_msgs.msg.Twist" not in facts.imports:
        for other, facts in scripts.items():
            if (
                "Publisher" in facts.calls
                and "Subscriber" in facts.calls
                and not facts.is_class_program
            ):
                return other
        for other, facts in scripts.items():
            if "Publisher" in facts.calls and "Subscriber" in facts.calls:
                return other
    return script


@check(
    "C13",
    "joy2twist.py can be run",
    "4.3",
    "C12",
    look="rosrun joy2twist joy2twist.py",
    timeless=True,
)
def file(session: Session) -> Note | str | None:
    """Joy2twist.py can be run."""
    script = find_script(session, PACKAGE, NAME)
    check_file(session, PACKAGE, script)  # before its text is relied on
    check_manifest(session, script)
    main = main_script(session)
    if main != script:
        check_file(session, PACKAGE, main)
        check_manifest(session, main)
    return odd_node(session, PACKAGE, main) or main


def check_manifest(session: Session, script: str) -> None:
    """roslib.load_manifest names a package that exists, or Wrong."""
    facts = session.scripts(PACKAGE).get(script)
    call = facts and facts.first("load_manifest")
    if not call or not call.words or call.words[0] in facts.names:
        return  # PKG = "joy2twist": what is in it shows when the program runs
    if session.package(call.words[0]):
        return
    found = session.box.start(["rospack", "find", call.words[0]], session.environment)
    session.box.wait(lambda: found.ended, 10.0)
    if found.process.returncode:
        raise Wrong(
            "roslib.load_manifest names a package that exists",
            f"ResourceNotFound: {call.words[0]}",
            where=f"{script}:{call.line}",
            hint=f"load_manifest('{PACKAGE}'); or leave the line out: catkin needs it no more",
        )


@check(
    "C14",
    "it displays every Joy",
    "4.3",
    "C13",
    look="rosrun joy2twist joy2twist.py; rostopic echo /joy",
)
def displays(session: Session) -> Note | str | None:
    """Judge whether it displays every Joy."""
    return conversation.check_displays(session, drive(session, main_script(session)))


@check("C15", "/joy in, /cmd_vel out", "4.3", "C13", look="rosnode info NODE")
def topics(session: Session) -> Note | str | None:
    """/joy in, /cmd_vel out."""
    seen = drive(session, main_script(session))
    return conversation.check_topics(session, seen)


@check("C16", "axis 1 drives forwards, axis 0 turns", "4.3", "C15", look="rostopic echo /cmd_vel")
def mapping(session: Session) -> Note | str | None:
    """Axis 1 drives forwards, axis 0 turns."""
    return conversation.check_mapping(session, drive(session, main_script(session)))


@check("C17", "it keeps up with the joystick", "4.3", "C16", look="rostopic hz /cmd_vel")
def rate(session: Session) -> Note | str | None:
    """Judge whether it keeps up with the joystick."""
    return conversation.check_rate(session, drive(session, main_script(session)))


@check("C34", "Ctrl-C ends it", "4.3", "C16", look="Ctrl-C in its terminal")
def ctrl_c(session: Session) -> Note | str | None:
    """Ctrl-C ends it."""
    script = main_script(session)
    seen = drive(session, script)
    return check_end(session, PACKAGE, script, seen.taken_s, seen.last_words) or (
        f"{seen.taken_s:.1f} s"
    )


@check(
    "C18",
    "it starts while the joystick speaks",
    "4.3",
    "C16",
    look="rosbag play --loop joy.bag; rosrun joy2twist joy2twist.py",
)
def under_load(session: Session) -> Note | str | None:
    """Start it while 200 Joys a second come. Never a failure."""
    script = main_script(session)
    facts = session.scripts(PACKAGE)[script]
    lines = [call.line if call else 0 for call in map(facts.first, ("Subscriber", "Publisher"))]
    if 0 < lines[0] < lines[1] or _finds_no_pub(session, script):
        return Note(
            "the subscriber comes before the publisher: a Joy that comes at once finds no pub (the handout has it so)",
            f"{script}:{lines[0] or 1}",
            "first the Publisher, then the Subscriber",
        )
    return None


def _finds_no_pub(session: Session, script: str) -> Any:
    """Whether it happens in one of so many starts."""
    with session.stage() as stage:
        stage.call("advertise", JOY, "Joy")
        stage.call("listen", CMD_VEL, "Twist")
        stage.call("stream", JOY, [NEUTRAL], 200.0, True)
        programs = [
            stage.start(PACKAGE, script, f"__name:=loaded_{number}") for number in range(STARTS)
        ]

        def one_has_failed() -> bool:
            return any("NameError" in each.output for each in programs)

        def all_speak() -> Any:
            return len({caller for _, caller, _ in stage.call("heard", CMD_VEL)}) >= STARTS

        stage.wait(lambda: all_speak() or one_has_failed(), START_S)
        return one_has_failed()
