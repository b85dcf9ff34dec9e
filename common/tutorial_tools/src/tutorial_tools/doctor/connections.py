"""Judge whether the nodes at both ends of a topic fit together and are connected."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from tutorial_tools.doctor.facts import Facts, Finding, some, wrong

ANY = ("*", "")  # `rostopic echo` asks for any type; and an unknown type.


class Cut(NamedTuple):
    """A pair of nodes that use the same topic and type, and are not connected."""

    topic: str
    sender: str
    receiver: str


def types(facts: Facts) -> Iterator[Finding]:
    """Judge whether all nodes of a topic use the same type, and the same definition of it."""
    for topic in facts.used():
        for sent in _kinds(facts, topic, inwards=False):
            for wanted in _kinds(facts, topic, inwards=True):
                if sent != wanted:
                    senders = some(facts.users(topic, sent, inwards=False))
                    receivers = some(facts.users(topic, wanted, inwards=True))
                    seen = f"{topic}: {sent} comes from {senders}, {wanted} is wanted by"
                    todo = "no message arrives; correct the type in one of the programs, or end it"
                    yield wrong("types", f"{seen} {receivers}", todo)
    for cut in cuts(facts):
        if _is_old(facts, cut):
            kind = facts.kinds(cut.topic, inwards=False)[cut.sender]
            md5s = [md5[:8] for md5 in facts.definitions[cut.topic, cut.sender]]
            seen = f"{cut.topic}: {cut.sender} has another definition of {kind} (md5 {md5s[0]})"
            todo = "build both workspaces again, then restart both nodes"
            seen += f" than this terminal (md5 {md5s[1]}), and does not reach {cut.receiver}"
            yield wrong("types", seen, todo)


def unconnected(facts: Facts) -> Iterator[Finding]:
    """Judge whether all nodes that should be connected are."""
    for cut in cuts(facts):
        if not _is_old(facts, cut):
            kind = facts.kinds(cut.topic, inwards=False)[cut.sender]
            seen = f"{cut.topic}: {cut.sender} and {cut.receiver} know of each other, but are not"
            todo = "fix what the lines above say, or a firewall between them"
            if facts.nodes[cut.sender].here and facts.nodes[cut.receiver].here:
                todo = f"restart both; if that does not help, build again what has {kind}"
            yield wrong("topics", f"{seen} connected", todo)


def cuts(facts: Facts) -> list[Cut]:
    """Return the pairs of nodes that answer and should be connected, but are not."""
    pairs = []
    for topic in facts.used():
        wanted = facts.kinds(topic, inwards=True)
        for sender, sent in sorted(facts.kinds(topic, inwards=False).items()):
            for receiver, kind in sorted(wanted.items()):
                fits = sent == kind or sent in ANY or kind in ANY
                linked = sender in facts.nodes and (topic, receiver) in facts.nodes[sender].links
                if fits and not linked and facts.answers(sender) and facts.answers(receiver):
                    pairs.append(Cut(topic, sender, receiver))
    return pairs


def mismatched(facts: Facts) -> set[str]:
    """Return the topics whose senders and receivers differ in type."""
    ends = (False, True)
    sets = {t: [_kinds(facts, t, inwards) for inwards in ends] for t in facts.used()}
    return {topic for topic, (sent, wanted) in sets.items() if sent and wanted and sent != wanted}


def _kinds(facts: Facts, topic: str, inwards: bool) -> list[str]:
    kinds = set(facts.kinds(topic, inwards).values())
    return sorted(kinds.difference(ANY))


def _is_old(facts: Facts, cut: Cut) -> bool:
    sent, here = facts.definitions.get((cut.topic, cut.sender), ("", ""))
    return bool(sent and here) and sent != here
