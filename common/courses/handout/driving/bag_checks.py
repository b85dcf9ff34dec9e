"""Check that a bag of Joys can be played to joy2twist."""

from __future__ import annotations

import shlex

from tutorial_check import Submission, Wrong

from .bag import bag

COPY_BAG = 'cp "$(rospack find gamepad)/bag/joy.bag" .'
NO_JOY = "sensor_msgs/Joy on /joy"


def check_recording(submission: Submission, name: str) -> tuple[str, ...]:
    """Return the topics of a bag that suits joy2twist. name: within src. Raises Wrong."""
    recording = submission.recording(bag, name)
    if recording.error:
        hint = f"copy it again: {COPY_BAG[:-1]}{shlex.quote(str(submission.source / name))}"
        raise Wrong("a recording that rosbag can read", recording.error, name, hint)
    if recording.axes is None:
        seen = f"topics: {', '.join(recording.topics) or 'none'}"
        hint = f"rosbag record /joy; or copy ours: {COPY_BAG}"
        raise Wrong(NO_JOY, seen, name, hint)
    if recording.axes < 2:
        raise Wrong("at least two axes", f"{recording.axes}", name)
    return recording.topics
