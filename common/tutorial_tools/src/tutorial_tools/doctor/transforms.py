"""Judge the transforms on /tf and /tf_static (pure, but for the bytes)."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from genpy import DeserializationError
from tf2_msgs.msg import TFMessage

from tutorial_tools.doctor.facts import Facts, Finding, Transform, ok, some, unknown, wrong

TOPICS = ("/tf", "/tf_static")
MESSAGES = 30  # of each node and topic: a robot sends several frames by turns
OLD_S = 1.0  # what is looked up "now" waits no longer


def of_messages(node: str, topic: str, messages: list[tuple[float, bytes]]) -> list[Transform]:
    """Return the transforms of a node's messages: for each frame the one that was fastest."""
    newest: dict[str, Transform] = {}
    for at_s, data in messages:
        with contextlib.suppress(DeserializationError):
            for each in TFMessage().deserialize(data).transforms:
                # Those of /tf_static hold at any time.
                late_s = 0.0 if topic == "/tf_static" else at_s - each.header.stamp.to_sec()
                parent, child = each.header.frame_id.strip("/"), each.child_frame_id.strip("/")
                if child not in newest or late_s < newest[child].late_s:
                    newest[child] = Transform(node, parent, child, late_s)
    return list(newest.values())


def transforms(facts: Facts) -> Iterator[Finding]:
    """Judge whether every frame has one publisher, fresh stamps, and a way to the others."""
    senders: dict[str, set[str]] = {}
    for node, _, child, _ in facts.transforms:
        senders.setdefault(child, set()).add(node)
    found = []
    for nodes in sorted({tuple(sorted(nodes)) for nodes in senders.values() if len(nodes) > 1}):
        frames = [child for child, these in senders.items() if these == set(nodes)]
        todo = "end all of them but one"
        if len({node.rsplit("/", 1)[0] for node in nodes}) > 1:
            todo = "two robots need frames of their own: give each group a tf_prefix"
        found.append(wrong("transforms", f"{some(nodes)} send {some(frames)} at once", todo))
    old = {each.node for each in facts.transforms if each.late_s > OLD_S}
    if old and not facts.use_sim_time:
        todo = "for a recording: rosparam set use_sim_time true, restart the nodes, "
        todo += "rosbag play --clock FILE; else compare the clocks"
        found.append(wrong("transforms", f"{some(old)} sends stamps of the past", todo))
    roots = {each.parent for each in facts.transforms} - set(senders)
    # Each robot of a class has a tree, whose frames begin with its name.
    trees = [root for root in roots if "/" not in root]
    if len(trees) > 1:
        todo = "start what sends the transform between them; rosrun tf view_frames draws the tree"
        found.append(unknown("transforms", f"pieces that nothing joins: below {some(trees)}", todo))
    yield from found
    if senders and not found:
        yield ok("transforms", f"{len(senders)} frames, each from one node")
