"""C20: a joystick drives the program."""

from __future__ import annotations

from tutorial_check import Note, Script, Submission, Wrong, check, crash

from ..driving.main_script import main_script
from ..task import PACKAGE
from .record import stick


@check("C20", "a joystick drives it", "4.5", needs="C16", look="rostopic echo /joy/{n.axes[1]}")
def joystick(submission: Submission) -> Note | str | None:
    script = main_script(submission)
    seen = submission.recording(stick, script)
    if not seen.drives:
        expected = "the stick pushed forwards moves the robot: linear.x > 0"
        raise crash(submission, PACKAGE, seen.program, expected)
    if seen.v < 0:
        expected = "the stick pushed forwards moves the robot forwards"
        raise Wrong(expected, "linear.x < 0", script)
    if seen.survives_eight_axes:
        return "switch at D and at X"
    facts = Script(submission, PACKAGE, script).facts
    words = "with the switch at X (eight axes) it fails"
    words += "; the handout's does, too" if facts.is_python else ""
    return Note(words, script, f"as many as there are: {facts.idioms.show_all_axes}")
