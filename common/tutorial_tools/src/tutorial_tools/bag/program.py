"""The command rqt_bag, as far as there is no rqt: what is in a bag, a picture, how to play it."""

import argparse
import os
import shlex
import sys
from pathlib import Path

import rosbag
import rosgraph

from node_kit.questions import address
from tutorial_tools.bag.picture import curves, svg

JOY = "sensor_msgs/Joy"


def fail(line):
    sys.exit(f"rqt_bag: {line}")


def read(path):
    """(duration [s], {topic: (type, messages)}, the recorded Joys of the first such topic)."""
    try:
        with rosbag.Bag(str(path)) as bag:
            info = bag.get_type_and_topic_info().topics
            topics = {name: (one.msg_type, one.message_count) for name, one in info.items()}
            duration = bag.get_end_time() - bag.get_start_time()
            joys = [name for name in sorted(topics) if topics[name][0] == JOY]
            recorded = [
                (stamp.to_sec(), message.axes, message.buttons)
                for _, message, stamp in bag.read_messages(topics=joys[:1])
                if joys
            ]
    except FileNotFoundError:
        fail(f'{path}: no such file. For ours: cp "$(rospack find gamepad)/bag/joy.bag" .')
    except OSError as error:
        fail(f"{path}: cannot be read: {error.strerror}")
    except rosbag.ROSBagUnindexedException:
        fail(f"{path}: cut short; mend it with: rosbag reindex {path}")
    except Exception as error:  # rosbag lets struct.error and more through from a damaged file
        fail(f"{path}: not a bag that can be read: {error}")
    return duration, topics, recorded


def main():
    """Tell what is in the bag, draw it, and say how to publish it."""
    parser = argparse.ArgumentParser(
        prog="rqt_bag",
        description="Debian has no rqt for ROS 1. This draws a recorded joystick, and says how to "
        "play the bag.",
    )
    parser.add_argument("bag", nargs="?", help="the recording, such as joy.bag")
    options = parser.parse_args()
    if not options.bag:
        fail("which bag? For example: rqt_bag joy.bag")
    path = Path(options.bag)
    duration, topics, recorded = read(path)
    for name, (kind, count) in sorted(topics.items()):
        print(f"{name}  {kind}  {count} messages in {duration:.1f} s")
    if recorded:
        picture = path.with_suffix(".svg").name
        try:
            Path(picture).write_text(svg(path.name, curves(recorded)), encoding="utf-8")
        except OSError as error:
            fail(f"cannot write {picture}: {os.strerror(error.errno)}")
        print(f"drawn in {picture}, which a browser shows")
    page = address(rosgraph.get_master_uri())
    if page:
        print(f"scrub and publish it in a browser, if the cockpit started here: {page}#Bag")
    print(f"publish it (Ctrl-C ends it): rosbag play --loop {shlex.quote(str(path))}")
