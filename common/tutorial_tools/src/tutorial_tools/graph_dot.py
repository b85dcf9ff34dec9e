"""A graph of nodes and topics in DOT, the language of graphviz."""

from __future__ import annotations

import json
import re
from typing import Any

# Every node is connected to /rosout, so it would clutter the graph.
DEBUG_NODES = {"/rosout"}
DEBUG_TOPICS = {"/rosout", "/rosout_agg", "/statistics"}
# A line of a name in the picture: up to 16 letters that end before / or _, or one longer part.
LINE = re.compile("(.{1,16}(?![^/_])|.[^/_]*)")
STYLE = """\
  rankdir=LR newrank=true  // from left to right, whatever the machine
  nodesep=0.2 ranksep=0.15  // inches, as the margins
  graph [fontname="Arial" fontsize=16 style=filled color="#e4ecf5"]
  node [fontname="Arial" fontsize=16 margin="0.03,0.03" width=0.5 style=filled fillcolor=white]
  edge [arrowsize=0.7]
"""


def quoted(text: str) -> str:
    """Return a text quoted for graphviz, whose rules are those of JSON."""
    return json.dumps(text, ensure_ascii=False)


def drawn(kind: str, name: str, shape: str) -> str:
    """Return the line of a node or a topic. A long name is broken before / and _."""
    label = "\n".join(LINE.findall(name))
    return f"{quoted(f'{kind} {name}')} [label={quoted(label)} shape={shape}]"


def dot_text(state: Any, machines: dict[str, str], everything: bool = False) -> str:
    """Return the graph in DOT, always the same text for the same graph.

    state: publishers, subscribers and services as the master's getSystemState() gives them, each a
    list of [topic, [node, ...]]. machines: {node: machine that it runs on}. everything: also show
    /rosout, and topics without a publisher or a subscriber.
    """
    hidden = set() if everything else DEBUG_NODES
    publishers, subscribers = (
        {topic: sorted(set(nodes) - hidden) for topic, nodes in part} for part in state[:2]
    )
    nodes = set().union(*publishers.values(), *subscribers.values())
    topics = set(publishers) & set(subscribers) - DEBUG_TOPICS
    if everything:
        topics = {*publishers, *subscribers}

    inside: dict[str, list[str]] = {machines.get(node, ""): [] for node in nodes}  # its lines
    inside[""] = []  # topics between machines, and nodes that have just exited
    arrows = []
    for node in sorted(nodes):
        inside[machines.get(node, "")].append(drawn("node", node, "ellipse"))
    for topic in sorted(topics):
        senders, receivers = publishers.get(topic, []), subscribers.get(topic, [])
        where = {machines.get(node, "") for node in (*senders, *receivers)}
        inside[where.pop() if len(where) == 1 else ""].append(drawn("topic", topic, "box"))
        this = quoted(f"topic {topic}")
        arrows += [f"{quoted(f'node {node}')} -> {this}" for node in senders]
        arrows += [f"{this} -> {quoted(f'node {node}')}" for node in receivers]

    lines = inside.pop("")
    for machine, own in sorted(inside.items()):
        if len(inside) == 1:
            lines += own
        else:
            framed = [f"  {line}" for line in (f"label={quoted(machine)}", *own)]
            lines += [f"subgraph {quoted(f'cluster {machine}')} {{", *framed, "}"]
    return "digraph ros {\n" + STYLE + "".join(f"  {line}\n" for line in lines + arrows) + "}\n"
