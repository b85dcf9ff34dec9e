"""./tutorial ros2 convert_bag BAG FOLDER: converts a recording of ROS 1 to ROS 2, and compares.

Runs in the Python of ROS 2, and needs only rosbags. Every message is read back and compared, to the
bit, with that of ROS 1, except Header.seq, which ROS 2 lacks.
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
from pathlib import Path
from typing import Any

from rosbags.rosbag1 import Reader as Reader1
from rosbags.rosbag2 import Reader as Reader2
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore

VERSION = 9  # bag format of ROS 2 Jazzy and later
STORE, STORE_1 = get_typestore(Stores.LATEST), get_typestore(Stores.ROS1_NOETIC)


def convert(source: Path, target: Path) -> int:
    """Convert a recording; return the number of its messages. Raises the errors of rosbags."""
    count = 0
    with Reader1(source) as reader, Writer(target, version=VERSION) as writer:
        targets = {
            source.id: writer.add_connection(source.topic, source.msgtype, typestore=STORE)
            for source in reader.connections
        }
        for connection, stamp, data in reader.messages():
            cdr = STORE.ros1_to_cdr(data, connection.msgtype)
            writer.write(targets[connection.id], stamp, cdr)
            count += 1
    return count


def first_difference(source: Path, target: Path) -> str:
    """Return the first difference between two recordings; "" if there is none."""
    with Reader1(source) as reader1, Reader2(target) as reader2:
        before, after = reader1.messages(), reader2.messages()
        for number, (was, now) in enumerate(zip(before, after), 1):
            same = (was[0].topic, was[1]) == (now[0].topic, now[1])
            values = STORE_1.deserialize_ros1(was[2], was[0].msgtype)
            if not same or not _same(values, STORE.deserialize_cdr(now[2], now[0].msgtype)):
                return f"message {number} on {was[0].topic} differs"
        if next(before, None) or next(after, None):
            return "one of the two has more messages"
    return ""


def _same(value: Any, converted: Any) -> bool:
    """Return whether two values are the same in all fields that ROS 2 has."""
    if dataclasses.is_dataclass(converted):
        names = [field.name for field in dataclasses.fields(converted)]
        return all(_same(getattr(value, name), getattr(converted, name)) for name in names)
    if hasattr(converted, "tobytes"):  # numpy's
        return bool(value.tobytes() == converted.tobytes())
    if isinstance(converted, list):
        return len(value) == len(converted) and all(map(_same, value, converted))
    return repr(value) == repr(converted)  # repr keeps every bit of a number


def main() -> None:
    """Convert, compare, and report the result in one line."""
    parser = argparse.ArgumentParser(prog="./tutorial ros2 convert_bag", description=__doc__)
    parser.add_argument("bag", type=Path, metavar="BAG", help="recording of ROS 1")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the result; must not exist")
    given = parser.parse_args()
    try:
        count = convert(given.bag, given.folder)
        difference = first_difference(given.bag, given.folder)
    except Exception as error:  # a damaged file may raise struct.error and more
        sys.exit(f"convert_bag: {' '.join(str(error).split()) or type(error).__name__}")
    if difference:
        sys.exit(f"convert_bag: {given.folder} differs from {given.bag}: {difference}")
    print(f"{given.folder}: {count} messages, the same as in {given.bag}")


if __name__ == "__main__":
    main()
