"""./tutorial ros2 convert_bag BAG FOLDER: a recording of ROS 1 as one of ROS 2, compared with it.

Run by the Python of ROS 2; only rosbags is needed. Every message is read back and compared, to the
bit, with that of ROS 1: only Header.seq is left out, which ROS 2 lacks.
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
    """Convert a recording; return the number of its messages. Raises what rosbags raises."""
    count = 0
    with Reader1(source) as reader, Writer(target, version=VERSION) as writer:
        made = {
            one.id: writer.add_connection(one.topic, one.msgtype, typestore=STORE)
            for one in reader.connections
        }
        for connection, stamp, data in reader.messages():
            cdr = STORE.ros1_to_cdr(data, connection.msgtype)
            writer.write(made[connection.id], stamp, cdr)
            count += 1
    return count


def first_difference(source: Path, target: Path) -> str:
    """Return the first message that is not the same in both recordings; "" if all are."""
    with Reader1(source) as one, Reader2(target) as other:
        before, after = one.messages(), other.messages()
        for number, (was, now) in enumerate(zip(before, after), 1):
            same = (was[0].topic, was[1]) == (now[0].topic, now[1])
            values = STORE_1.deserialize_ros1(was[2], was[0].msgtype)
            if not same or not _same(values, STORE.deserialize_cdr(now[2], now[0].msgtype)):
                return f"message {number} on {was[0].topic} differs"
        if next(before, None) or next(after, None):
            return "one of them has more messages"
    return ""


def _same(one: Any, other: Any) -> bool:
    """Return whether two values are the same in all that ROS 2 has."""
    if dataclasses.is_dataclass(other):
        names = [field.name for field in dataclasses.fields(other)]
        return all(_same(getattr(one, name), getattr(other, name)) for name in names)
    if hasattr(other, "tobytes"):  # numpy's
        return bool(one.tobytes() == other.tobytes())
    if isinstance(other, list):
        return len(one) == len(other) and all(map(_same, one, other))
    return repr(one) == repr(other)  # a number prints so that it can be read back to the bit


def main() -> None:
    """Convert, compare, and report the result in one line."""
    parser = argparse.ArgumentParser(prog="./tutorial ros2 convert_bag", description=__doc__)
    parser.add_argument("bag", type=Path, metavar="BAG", help="of ROS 1")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the new one; not there yet")
    given = parser.parse_args()
    try:
        count = convert(given.bag, given.folder)
        difference = first_difference(given.bag, given.folder)
    except Exception as error:  # rosbags lets struct.error and more through from a damaged file
        sys.exit(f"convert_bag: {' '.join(str(error).split()) or type(error).__name__}")
    if difference:
        sys.exit(f"convert_bag: {given.folder} is not as {given.bag}: {difference}")
    print(f"{given.folder}: {count} messages, the same as in {given.bag}")


if __name__ == "__main__":
    main()
