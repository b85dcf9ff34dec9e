"""C11, C19, C20: a recording, the simulated robot, the joystick."""

from __future__ import annotations

import shlex

from tutorial_check import Note, Submission, Wrong, check, crash

from ..driving.evidence import ANGULAR, LINEAR
from ..joy2twist.checks import main_script
from ..task import PACKAGE
from .record import agree, bag, follow, stick

COPY_BAG = 'cp "$(rospack find gamepad)/bag/joy.bag" .'

NO_JOY = "sensor_msgs/Joy on /joy"


@check("C11", "a recording of /joy", "4.2", look="rosbag info joy.bag")
def recording(submission: Submission) -> Note | str | None:
    """Take the first of the recordings that can be played to joy2twist; there may be others."""
    ours = submission.package(PACKAGE).folder if submission.has(PACKAGE) else None
    bags = submission.source.rglob("*.bag") if ours or submission.has("beginner_tutorials") else []
    bags = sorted(bags, key=lambda each: (each.name != "joy.bag", each))
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


def check_recording(submission: Submission, name: str) -> tuple[str, ...]:
    """Return the topics of a recording fit for joy2twist. name: within src. Raises Wrong."""
    found = submission.recording(bag, name)
    if found.error:
        hint = f"copy it again: {COPY_BAG[:-1]}{shlex.quote(str(submission.source / name))}"
        raise Wrong("a recording that rosbag can read", found.error, name, hint)
    if found.axes is None:
        seen = f"topics: {', '.join(found.topics) or 'none'}"
        hint = f"rosbag record /joy; or copy ours: {COPY_BAG}"
        raise Wrong(NO_JOY, seen, name, hint)
    if found.axes < 2:
        raise Wrong("at least two axes", f"{found.axes}", name)
    return found.topics


@check("C19", "the simulated robot follows", "4.4", "C16",
       look="rostopic echo /odom/pose/pose/position")  # fmt: skip
def simulated(submission: Submission) -> Note | str | None:
    script = main_script(submission)
    drive = submission.recording(follow, script)
    if not drive.ready:
        raise crash(submission, PACKAGE, drive.program, "the node runs beside the simulated robot")
    if len(drive.publishers) != 1:
        seen = f"{len(drive.publishers)}: {', '.join(drive.publishers)}"
        hint = "end the older version: rosnode list"
        raise Wrong(f"one node publishes on {submission.task.names.cmd_vel}", seen, hint=hint)
    if drive.told_v is None or drive.told_w is None:
        raise Wrong("Twists that the robot obeys", "none came")
    seen = f"{drive.v:.2f} m/s, then {drive.w:.2f} rad/s"
    if not agree(drive.v, drive.told_v, LINEAR) or not agree(drive.w, drive.told_w, ANGULAR):
        expected = f"forwards with {drive.told_v:.2f} m/s,"
        expected += f" then turning left with {drive.told_w:.2f} rad/s"
        rules = submission.task.answers.rules
        hint = f"linear.x = {rules[1]}, angular.z = {rules[0]}, for every Joy"
        raise Wrong(expected, seen, script, hint)
    return seen


@check("C20", "a joystick drives it", "4.5", "C16", look="rostopic echo /joy/{n.axes[1]}")
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
    words = "with the switch at X (eight axes) it fails; the handout's does, too"
    hint = 'as many as there are: ", ".join("%.2f" % axis for axis in data.axes)'
    return Note(words, script, hint)
