"""The command rqt_bag in place of rqt's: lists a bag, draws its joystick, says how to play it."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from pathlib import Path
from typing import Dict, NoReturn, Tuple

import rosgraph

from gamepad.errors import BagError
from gamepad.ros.bags import opened
from tutorial_tools.joystick_chart import Sample, curves, svg
from tutorial_tools.ros.cockpit_page import address

JOY = "sensor_msgs/Joy"

Topics = Dict[str, Tuple[str, int]]  # name: (type, messages)


def fail(line: str) -> NoReturn:
    sys.exit(f"rqt_bag: {line}")


def read(path: Path) -> tuple[float, Topics, list[Sample]]:
    """Return (duration [s], topics, the recorded Joys of the first such topic)."""
    with opened(path) as bag:
        info = bag.get_type_and_topic_info().topics
        topics = {name: (topic.msg_type, topic.message_count) for name, topic in info.items()}
        joys = [name for name in sorted(topics) if topics[name][0] == JOY][:1]
        messages = bag.read_messages(topics=joys) if joys else ()
        recorded = [(stamp.to_sec(), joy.axes, joy.buttons) for _, joy, stamp in messages]
        return bag.get_end_time() - bag.get_start_time(), topics, recorded


def main() -> None:
    """Print what is in the bag, draw its joystick, and print how to publish it."""
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
