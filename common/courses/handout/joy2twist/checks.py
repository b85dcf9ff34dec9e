"""C13 to C18, C34: both versions of joy2twist.py."""

from __future__ import annotations

from tutorial_check import Note, Script, Submission, check, check_file, find_script

from ..driving import behaviour
from ..driving.main_script import check_manifest, main_script
from ..driving.record import drive
from ..task import NAME, PACKAGE
from .record import loaded


@check("C13", "joy2twist.py can be run", "4.3", needs="C12", look="rosrun {n.package} joy2twist.py",
       timeless=True)  # fmt: skip
def is_runnable(submission: Submission) -> Note | str:
    main = main_script(submission)
    for script in dict.fromkeys((find_script(submission, PACKAGE, NAME), main)):
        check_file(submission, PACKAGE, script)
        check_manifest(submission, script)
    return Script(submission, PACKAGE, main).unusual_node_name() or main


@check("C14", "it displays every Joy", "4.3", needs=is_runnable,
       look="rosrun {n.package} joy2twist.py; rostopic echo {n.joy}")  # fmt: skip
def displays(submission: Submission) -> Note | None:
    return behaviour.displays(submission)


@check("C15", "{n.joy} in, {n.cmd_vel} out", "4.3", needs=is_runnable, look="rosnode info NODE")
def topics(submission: Submission) -> Note | str:
    return behaviour.topics(submission)


@check("C16", "{n.sticks[1]} drives forwards, {n.sticks[0]} turns", "4.3", needs=topics,
       look="rostopic echo {n.cmd_vel}")  # fmt: skip
def mapping(submission: Submission) -> Note | None:
    return behaviour.mapping(submission)


@check("C17", "it keeps up with the joystick", "4.3", needs=mapping, look="rostopic hz {n.cmd_vel}")
def rate(submission: Submission) -> Note | str | None:
    return behaviour.rate(submission)


@check("C34", "Ctrl-C ends it", "4.3", needs=mapping, look="Ctrl-C in its terminal")
def ctrl_c(submission: Submission) -> Note | str:
    run = submission.recording(drive, main_script(submission))
    end = run.ending
    note = Script(submission, PACKAGE, run.script).check_end(end.taken_s, end.last_words)
    return note or f"{end.taken_s:.1f} s"


@check("C18", "it starts while the joystick sends", "4.3", needs=mapping,
       look="rosbag play --loop joy.bag; rosrun {n.package} joy2twist.py")  # fmt: skip
def under_load(submission: Submission) -> Note | None:
    """Start it while 200 Joys arrive each second; at worst a Note."""
    script = main_script(submission)
    facts = Script(submission, PACKAGE, script).facts
    made = map(facts.first, ("Subscriber", "Publisher"))
    first, second = (call.line if call else 0 for call in made)
    spinner = facts.first("AsyncSpinner")  # the callbacks of other programs in C++ wait for spin
    if not facts.is_python and not (spinner and first < second and spinner.line < second):
        return None
    if not 0 < first < second and not submission.recording(loaded, script).failed:
        return None
    seen = "the subscriber comes before the publisher: for a Joy that comes at once there is no pub"
    where, hint = facts.place(script, first or 1), "first the Publisher, then the Subscriber"
    return Note(f"{seen} (the handout has it so)" if facts.is_python else seen, where, hint)
