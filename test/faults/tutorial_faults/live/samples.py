"""What processes need, over time, and whether it grows; sample() reads /proc."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import NamedTuple, Sequence

SETTLES_S = 60.0  # after which nothing new is opened
MOST_GROWTH_KB = 2048


class Sample(NamedTuple):
    """One process at one time [s] since the start: memory [kB], threads, open files."""

    at_s: float
    node: str
    memory_kb: int
    threads: int
    files: int


def sample(at_s: float, node: str, pid: int) -> Sample | None:
    """Return the Sample of a process, or None if it has exited."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
        files = len(os.listdir(f"/proc/{pid}/fd"))
    except OSError:
        return None
    memory, threads = re.findall(r"^(?:VmRSS|Threads):\s+(\d+)", status, re.M)
    return Sample(at_s, node, int(memory), int(threads), files)


def growth(samples: Sequence[Sample], node: str) -> tuple[int, int, int] | None:
    """Return (memory [kB], threads, files) by which a node has grown; None: unknown.

    From the smallest memory after it settled, and the most threads and files before, to the
    smallest of the last tenth of the time, as a thread that answers one question is no growth.
    """
    its = [one[2:] for one in samples if one.node == node and one.at_s > SETTLES_S]
    before = [one[2:] for one in samples if one.node == node and one.at_s <= SETTLES_S]
    if not before or not its:
        return None
    tenth = max(1, len(its) // 10)
    last = map(min, zip(*its[-tenth:]))
    first = min(its[:tenth])[0], *(max(column) for column in list(zip(*before))[1:])
    memory, threads, files = (new - old for new, old in zip(last, first))
    return memory, threads, files


def complaints(samples: Sequence[Sample]) -> list[str]:
    """Return lines about the nodes that have grown."""
    lines = []
    for node in sorted({one.node for one in samples}):
        grown = growth(samples, node)
        if grown is None:
            lines.append(f"{node}: did not live for longer than {SETTLES_S:.0f} s")
        elif grown[0] > MOST_GROWTH_KB or grown[1] > 0 or grown[2] > 0:
            lines.append(f"{node}: grew by {grown[0]} kB, {grown[1]} threads, {grown[2]} files")
    return lines
