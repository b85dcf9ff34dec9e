"""Curves of a recording as an SVG picture, which every browser shows (pure)."""

from __future__ import annotations

from html import escape
from typing import List, Sequence, Tuple

WIDTH, ROW = 900, 90  # [pixel] of the picture, and of one curve
LEFT = 130  # [pixel] for the names
COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#e377c2")

# time [s], axes, buttons
Sample = Tuple[float, Sequence[float], Sequence[int]]
Curve = Tuple[str, List[Tuple[float, float]]]  # name, [(time [s], value)]


def curves(recorded: list[Sample]) -> list[Curve]:
    """[(name, [(time [s], value)])] of the axes that move and the buttons that are pressed.

    recorded: [(time [s], axes, buttons)] in the order of time. Nothing moves: all axes.
    """
    start = recorded[0][0]
    found = []
    times = [entry[0] - start for entry in recorded]
    axes, buttons = [entry[1] for entry in recorded], [entry[2] for entry in recorded]
    for kind, rows in (("axes", axes), ("buttons", buttons)):
        for number, values in enumerate(zip(*rows)):
            found.append((f"{kind}[{number}]", list(zip(times, map(float, values)))))
    moving = [(name, values) for name, values in found if len({v for _, v in values}) > 1]
    return moving or [entry for entry in found if entry[0].startswith("axes")]


def svg(title: str, lines: list[Curve]) -> str:
    """The picture: one row for each curve, time from left to right, -1 to 1 from bottom to top."""
    duration = max((values[-1][0] for _, values in lines), default=0.0) or 1.0
    height = ROW * len(lines) + 60
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
        'font-family="sans-serif" font-size="14">',
        f'<rect width="{WIDTH}" height="{height}" fill="white"/>',
        f'<text x="10" y="24">{escape(title)}</text>',
    ]
    for row, (name, values) in enumerate(lines):
        middle = 40 + ROW * row + ROW / 2
        points = " ".join(
            f"{LEFT + (WIDTH - LEFT - 10) * time / duration:.1f},{middle - value * ROW * 0.42:.1f}"
            for time, value in values
        )
        parts.append(f'<text x="10" y="{middle + 5}">{escape(name)}</text>')
        parts.append(
            f'<line x1="{LEFT}" x2="{WIDTH - 10}" y1="{middle}" y2="{middle}" stroke="#ccc"/>'
        )
        colour = COLOURS[row % len(COLOURS)]
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}"/>')
    for share in range(5):
        x = LEFT + (WIDTH - LEFT - 10) * share / 4
        parts.append(f'<text x="{x:.0f}" y="{height - 5}">{duration * share / 4:.0f} s</text>')
    return "\n".join([*parts, "</svg>", ""])
