"""The command rqt_bag, as far as there is no rqt: what is in a bag, a picture, how to play it."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from html import escape
from pathlib import Path
from typing import Dict, List, NoReturn, Sequence, Tuple

import rosgraph

from gamepad.errors import BagError
from gamepad.ros.bags import opened
from tutorial_tools.ros.cockpit_page import address

WIDTH, ROW, LEFT = 900, 90, 130  # [pixel] of the picture, of one curve, for the names
COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#e377c2")
JOY = "sensor_msgs/Joy"

Sample = Tuple[float, Sequence[float], Sequence[int]]  # time [s], axes, buttons
Curve = Tuple[str, List[Tuple[float, float]]]  # name, [(time [s], value)]
Topics = Dict[str, Tuple[str, int]]  # name: (type, messages)


def curves(recorded: list[Sample]) -> list[Curve]:
    """Return the axes that move and the buttons that are pressed; all axes if nothing moves.

    recorded: in the order of time.
    """
    times = [entry[0] - recorded[0][0] for entry in recorded]
    found: list[Curve] = []
    for kind, part in (("axes", 1), ("buttons", 2)):
        for number, values in enumerate(zip(*(entry[part] for entry in recorded))):
            found.append((f"{kind}[{number}]", list(zip(times, map(float, values)))))
    moving = [(name, values) for name, values in found if len({v for _, v in values}) > 1]
    return moving or [entry for entry in found if entry[0].startswith("axes")]


def svg(title: str, lines: list[Curve]) -> str:
    """Return the picture: a row for each curve, time from left to right, -1 to 1 upwards."""
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


def fail(line: str) -> NoReturn:
    sys.exit(f"rqt_bag: {line}")


def read(path: Path) -> tuple[float, Topics, list[Sample]]:
    """Return (duration [s], topics, the recorded Joys of the first such topic)."""
    with opened(path) as bag:
        info = bag.get_type_and_topic_info().topics
        topics = {name: (one.msg_type, one.message_count) for name, one in info.items()}
        joys = [name for name in sorted(topics) if topics[name][0] == JOY][:1]
        messages = bag.read_messages(topics=joys) if joys else ()
        recorded = [(stamp.to_sec(), joy.axes, joy.buttons) for _, joy, stamp in messages]
        return bag.get_end_time() - bag.get_start_time(), topics, recorded


def main() -> None:
    """Report what is in the bag, draw it, and say how to publish it."""
    text = "Debian has no rqt for ROS 1. This draws a recorded joystick, and shows how to play it."
    parser = argparse.ArgumentParser(prog="rqt_bag", description=text)
    parser.add_argument("bag", nargs="?", help="the recording, such as joy.bag")
    options = parser.parse_args()
    if not options.bag:
        fail("which bag? For example: rqt_bag joy.bag")
    path = Path(options.bag)
    if not path.exists():
        fail(f'{path}: no such file. For ours: cp "$(rospack find gamepad)/bag/joy.bag" .')
    try:
        duration, topics, recorded = read(path)
    except BagError as error:
        fail(str(error))
    for name, (kind, count) in sorted(topics.items()):
        print(f"{name}  {kind}  {count} messages in {duration:.1f} s")
    if recorded:
        picture = path.with_suffix(".svg").name
        try:
            Path(picture).write_text(svg(path.name, curves(recorded)), encoding="utf-8")
        except OSError as error:
            fail(f"cannot write {picture}: {os.strerror(error.errno or 0)}")
        print(f"drawn in {picture}, which a browser shows")
    page = address(rosgraph.get_master_uri())
    if page:
        print(f"scrub and publish it in a browser, if the cockpit started here: {page}#Bag")
    print(f"publish it (Ctrl-C ends it): rosbag play --loop {shlex.quote(str(path))}")
