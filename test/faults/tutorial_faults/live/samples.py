"""What the processes of a soak need, over time, and whether it grows; sample() reads /proc."""

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
    memory, threads = (
        int(re.findall(rf"^{name}:\s+(\d+)", status, re.M)[0]) for name in ("VmRSS", "Threads")
    )
    return Sample(at_s, node, memory, threads, files)


def growth(samples: Sequence[Sample], node: str) -> tuple[int, int, int] | None:
    """Return (memory [kB], threads, files) by which a node has grown after it settled.

    The smallest of the last tenth of the time, as a thread that answers one question is no growth;
    of memory beyond the smallest of the first tenth, of threads and files beyond the largest of the
    first minute. None: unknown.
    """
    its = [one for one in samples if one.node == node]
    before = [one for one in its if one.at_s <= SETTLES_S]
    after = [one for one in its if one.at_s > SETTLES_S]
    if not before or not after:
        return None
    tenth = max(1, len(after) // 10)
    last, first = after[-tenth:], after[:tenth]
    memory = min(one.memory_kb for one in last) - min(one.memory_kb for one in first)
    threads, files = (
        min(getattr(one, name) for one in last) - max(getattr(one, name) for one in before)
        for name in ("threads", "files")
    )
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
