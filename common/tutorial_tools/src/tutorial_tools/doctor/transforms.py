"""Judge the transforms on /tf and /tf_static (pure, but for the bytes)."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from genpy import DeserializationError
from tf2_msgs.msg import TFMessage

from tutorial_tools.doctor.facts import Facts, Finding, Transform, ok, some, unknown, wrong

TOPICS = ("/tf", "/tf_static")
OLD_S = 1.0  # what is looked up "now" waits no longer


def of_messages(came: dict[tuple[str, str], list[tuple[float, bytes]]]) -> list[Transform]:
    """Return the fastest transform to each frame; came: {(node, topic): [(arrival, bytes)]}."""
    found: dict[tuple[str, str], Transform] = {}
    every = [(*key, *one) for key, several in came.items() if key[1] in TOPICS for one in several]
    for node, topic, at_s, data in every:
        with contextlib.suppress(DeserializationError):
            for each in TFMessage().deserialize(data).transforms:
                # Those of /tf_static hold at any time.
                late_s = 0.0 if topic == "/tf_static" else at_s - each.header.stamp.to_sec()
                parent, child = each.header.frame_id.strip("/"), each.child_frame_id.strip("/")
                new = Transform(node, parent, child, late_s)
                found[node, child] = min(found.get((node, child), new), new, key=lambda t: t.late_s)
    return list(found.values())


def transforms(facts: Facts) -> Iterator[Finding]:
    """Judge whether every frame has one publisher, fresh stamps, and a way to the others."""
    senders: dict[str, set[str]] = {}
    for node, _, child, _ in facts.transforms:
        senders.setdefault(child, set()).add(node)
    found = []
    for nodes in sorted({tuple(sorted(nodes)) for nodes in senders.values() if len(nodes) > 1}):
        frames = [child for child, these in senders.items() if these == set(nodes)]
        apart = len({node.rsplit("/", 1)[0] for node in nodes}) > 1
        todo = "two robots need frames of their own: give each group a tf_prefix"
        seen = f"{some(nodes)} send {some(frames)} at once"
        found.append(wrong("transforms", seen, todo if apart else "end all of them but one"))
    old = {each.node for each in facts.transforms if each.late_s > OLD_S}
    if old and not facts.use_sim_time:
        todo = "for a recording: rosparam set use_sim_time true, restart the nodes, "
        todo += "rosbag play --clock FILE; else compare the clocks"
        found.append(wrong("transforms", f"{some(old)} sends stamps of the past", todo))
    # Each robot of a class has a tree, whose frames begin with its name.
    roots = {each.parent for each in facts.transforms if "/" not in each.parent} - set(senders)
    if len(roots) > 1:
        todo = "start what sends the transform between them; rosrun tf view_frames draws the tree"
        found.append(unknown("transforms", f"pieces that nothing joins: below {some(roots)}", todo))
    yield from found
    if senders and not found:
        yield ok("transforms", f"{len(senders)} frames, each from one node")
