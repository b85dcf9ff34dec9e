"""C33: a program that cannot go on says why."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from tutorial_check.course import check
from tutorial_check.exercises.changed_programs import without_name
from tutorial_check.exercises.classes import program
from tutorial_check.exercises.driving import JOY
from tutorial_check.exercises.joystick_task import PACKAGE
from tutorial_check.model import Note, Wrong
from tutorial_check.tracebacks import last_lines

if TYPE_CHECKING:
    from tutorial_check.session import Session


ALONE_S = 1.5  # without a joystick
NAMES_IT = re.compile(r"not defined|NameError")  # what the lack of the import leads to
TELLS = re.compile(r"Traceback|Error\b|Exception|not defined|exceeded|\[(?:ERROR|FATAL|WARN)\]")


@check(
    "C33",
    "its errors are seen",
    "6.2",
    "C30",
    look="rosrun joy2twist THE_CLASS, without a joystick",
)
def errors_are_seen(session: Session) -> Note | str | None:
    """Start it without a joystick; and a copy that lacks the import of Joy."""
    script, path, _ = program(session)
    broken_text = without_name(session.text(PACKAGE, script), "Joy")
    with session.stage() as stage:
        alone = stage.start(PACKAGE, script)
        broken = None
        if broken_text:
            copy = session.memo(
                ("broken", script), lambda: session.sibling(PACKAGE, script, broken_text)
            )
            broken = stage.start(PACKAGE, copy, "__name:=broken")
        stage.wait_for_start(lambda: alone.ended or JOY in stage.call("state")[1])
        stage.wait(lambda: alone.ended, ALONE_S)
        stage.wait_for_start(lambda: broken is None or broken.ended)
        has_ended, broken_ended = alone.ended, broken is not None and broken.ended
    excepts = session.scripts(PACKAGE)[path].broad_excepts
    where = f"{path}:{excepts[0]}" if excepts else path
    if has_ended and not TELLS.search(alone.output):
        said = last_lines(alone.output) or "nothing"
        seen = f"nobody publishes on /joy, and it ends; it printed: {said}"
        hint = "a Subscriber waits by itself, for as long as it takes;"
        hint += " what an except catches, it should show"
        expected = "without a joystick it waits for one, or says what it misses"
        raise Wrong(expected, seen, where, hint)
    hides = bool(excepts)
    if broken and broken_ended:
        hides = not NAMES_IT.search(broken.output)
    if hides:
        return Note(
            "except: hides every mistake, a misspelt name as well as Ctrl-C",
            where,
            "except rospy.ROSInterruptException:",
        )
    if has_ended:
        return Note(f"without a joystick it ends: {last_lines(alone.output, 1)}", where)
    return None
