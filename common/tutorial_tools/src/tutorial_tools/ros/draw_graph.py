"""Draw the running nodes and their topics, as rqt_graph does."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, NoReturn
from urllib.parse import urlsplit

import rosgraph

from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer
from tutorial_tools.graph_dot import dot_text

ENDINGS = (".png", ".svg", ".pdf", ".dot")


def ask_master() -> tuple[Any, dict[str, str]]:
    """Return (state, machines) for dot_text()."""
    uri = rosgraph.get_master_uri()
    answer, state = call(uri, "getSystemState")
    if answer is not Answer.WELL:
        fail(f"no ROS master at {uri}; start one with: roscore")
    nodes = {node for part in state for _, nodes in part for node in nodes}
    answers = {node: call(uri, "lookupNode", node) for node in nodes}
    # Without those that have exited meanwhile.
    return state, {node: urlsplit(own).hostname for node, (_, own) in answers.items() if own}


def picture(text: str, kind: str) -> bytes:
    """Return the bytes of the picture that dot draws, of a kind such as png."""
    dot = ["dot", f"-T{kind}"]
    try:
        done = subprocess.run(dot, input=text.encode(), capture_output=True, check=False)
    except FileNotFoundError:
        fail("dot is missing: sudo apt install graphviz, or choose a FILE that ends in .dot")
    if done.returncode != 0:
        fail(f"dot cannot draw this: {' '.join(done.stderr.decode(errors='replace').split())}")
    return done.stdout


def fail(text: str) -> NoReturn:
    sys.exit(f"draw_graph: {text}")


def main(arguments: list[str] | None = None) -> None:
    """Draw the graph into a file. arguments: None means the command line's."""
    parser = argparse.ArgumentParser(description="Draws the running nodes and their topics.")
    kinds = f"what to write, {', '.join(ENDINGS)}; graph.png by default"
    parser.add_argument("file", nargs="?", default="graph.png", metavar="FILE", help=kinds)
    everything = "also show /rosout, and topics without a publisher or a subscriber"
    parser.add_argument("--all", action="store_true", help=everything)
    options = parser.parse_args(rosgraph.myargv()[1:] if arguments is None else arguments)
    file = Path(options.file)
    kind = file.suffix.lower()
    if kind not in ENDINGS:
        fail(f"{file} must end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}")
    state, machines = ask_master()
    text = dot_text(state, machines, options.all)
    if '"node ' not in text:
        fail(f"nothing runs on {rosgraph.get_master_uri()} to be drawn; start a node first")
    data = text.encode() if kind == ".dot" else picture(text, kind[1:])
    try:
        file.write_bytes(data)
    except OSError as error:
        fail(f"cannot write {file}: {os.strerror(error.errno or 0)}")
    print(f"draw_graph: wrote {file.absolute()}")
