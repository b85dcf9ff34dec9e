"""C11: a recording of the joystick."""

from __future__ import annotations

from tutorial_check import Note, Submission, Wrong, check

from ..driving.bag_checks import COPY_BAG, NO_JOY, check_recording
from ..task import PACKAGE


@check("C11", "a recording of /joy", "4.2", look="rosbag info joy.bag")
def recording(submission: Submission) -> Note | str | None:
    """Take the first bag that can be played to joy2twist; other bags do not matter."""
    ours = submission.package(PACKAGE).folder if submission.has(PACKAGE) else None
    bags = submission.source.rglob("*.bag") if ours or submission.has("beginner_tutorials") else []
    bags = sorted(bags, key=lambda path: (path.name != "joy.bag", path))
    if not bags:
        seen = "no bag in the workspace; look at /joy with rosbag play and rostopic echo /joy"
        return Note(seen, hint=f"the recording: {COPY_BAG}", empty=True)
    damaged: list[Wrong] = []
    others: list[Wrong] = []
    for path in bags:
        name = str(path.relative_to(submission.source))
        try:
            return f"{name}: {', '.join(check_recording(submission, name))}"
        except Wrong as wrong:
            meant = path.name == "joy.bag" or ours in path.parents
            (damaged if meant and wrong.expected != NO_JOY else others).append(wrong)
    if damaged:
        raise damaged[0]
    return Note(f"no recording of /joy; {others[0].seen}", others[0].where, others[0].hint, True)
