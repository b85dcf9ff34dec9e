"""A chart of a recorded joystick, as SVG."""

from __future__ import annotations

from html import escape
from typing import List, Sequence, Tuple

WIDTH, ROW, LEFT = 900, 90, 130  # [pixel] of the chart, of a curve, for the names
COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#e377c2")

Sample = Tuple[float, Sequence[float], Sequence[int]]  # time [s], axes, buttons
Curve = Tuple[str, List[Tuple[float, float]]]  # name, [(time [s], value)]


def curves(recorded: list[Sample]) -> list[Curve]:
    """Return the axes and buttons that change; all axes if nothing does.

    recorded: in order of time.
    """
    times = [entry[0] - recorded[0][0] for entry in recorded]
    lines: list[Curve] = []
    for kind, part in (("axes", 1), ("buttons", 2)):
        for number, values in enumerate(zip(*(entry[part] for entry in recorded))):
            lines.append((f"{kind}[{number}]", list(zip(times, map(float, values)))))
    moving = [(name, values) for name, values in lines if len({v for _, v in values}) > 1]
    return moving or [line for line in lines if line[0].startswith("axes")]


def svg(title: str, lines: list[Curve]) -> str:
    """Return the chart: a row for each curve, time from left to right, -1 to 1 upwards."""
    duration = max((values[-1][0] for _, values in lines), default=0.0) or 1.0
    height, width = ROW * len(lines) + 60, WIDTH - LEFT - 10
    size = f'width="{WIDTH}" height="{height}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="14">',
        f'<rect {size} fill="white"/>',
        f'<text x="10" y="24">{escape(title)}</text>',
    ]
    for row, (name, values) in enumerate(lines):
        middle = 40 + ROW * row + ROW / 2
        points = " ".join(
            f"{LEFT + width * time / duration:.1f},{middle - value * ROW * 0.42:.1f}"
            for time, value in values
        )
        colour = COLOURS[row % len(COLOURS)]
        parts += [
            f'<text x="10" y="{middle + 5}">{escape(name)}</text>',
            f'<path d="M{LEFT} {middle}h{width}" stroke="#ccc"/>',
            f'<polyline points="{points}" fill="none" stroke="{colour}"/>',
        ]
    for share in range(5):
        x = LEFT + width * share / 4
        parts.append(f'<text x="{x:.0f}" y="{height - 5}">{duration * share / 4:.0f} s</text>')
    return "\n".join([*parts, "</svg>", ""])
