"""Judge the transforms on /tf and /tf_static."""

from __future__ import annotations

from collections.abc import Iterator

from tutorial_tools.doctor.facts import Facts, Finding, ok, some, unknown, wrong

TOPICS = ("/tf", "/tf_static")
OLD_S = 1.0  # a look-up at the present time rarely waits longer


def transforms(facts: Facts) -> Iterator[Finding]:
    """Judge whether every frame has one publisher and fresh stamps, and the tree is connected."""
    senders: dict[str, set[str]] = {}
    for node, _, child, _ in facts.transforms:
        senders.setdefault(child, set()).add(node)
    findings = []
    for nodes in sorted({tuple(sorted(nodes)) for nodes in senders.values() if len(nodes) > 1}):
        frames = [child for child, these in senders.items() if these == set(nodes)]
        apart = len({node.rsplit("/", 1)[0] for node in nodes}) > 1
        todo = "two robots need frames of their own: give each group a tf_prefix"
        seen = f"{some(nodes)} send {some(frames)} at once"
        findings.append(wrong("transforms", seen, todo if apart else "end all of them but one"))
    old = {edge.node for edge in facts.transforms if edge.late_s > OLD_S}
    if old and not facts.use_sim_time:
        todo = "for a recording: rosparam set use_sim_time true, restart the nodes, "
        todo += "rosbag play --clock FILE; else compare the clocks"
        findings.append(wrong("transforms", f"{some(old)} sends stamps of the past", todo))
    # Each robot of a classroom has its own tree, whose frames begin with the robot's name.
    roots = {edge.parent for edge in facts.transforms if "/" not in edge.parent} - set(senders)
    if len(roots) > 1:
        seen = f"pieces that nothing joins: below {some(roots)}"
        todo = "start what sends the transform between them; rosrun tf view_frames draws the tree"
        findings.append(unknown("transforms", seen, todo))
    yield from findings
    if senders and not findings:
        yield ok("transforms", f"{len(senders)} frames, each from one node")
