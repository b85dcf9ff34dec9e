"""The types of recorded messages, also of packages that are not installed here."""

from __future__ import annotations

import re
from contextlib import contextmanager, suppress
from functools import lru_cache
from typing import Any, Iterator, Mapping, NamedTuple

import rosbag
import rospy
from genpy.dynamic import generate_dynamic

from node_kit.message_types import message_class

# A field, a rule between two types, or the name of the next type.
_LINE = re.compile(r"[A-Za-z][\w/]*(\[\d*\])?\s+[A-Za-z]\w*|={80}|MSG: \w+/\w+", re.ASCII)
_TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.ASCII)


class Connection(NamedTuple):
    """What a recording says about a node that published a topic."""

    topic: str
    type: str
    md5sum: str
    definition: str
    header: Mapping[str, Any]

    @property
    def is_latched(self) -> bool:
        return self.header.get("latching") in ("1", b"1")

    @property
    def kind(self) -> Any:
        """The class that decodes its messages, or None."""
        return _kind(self.type, self.md5sum, self.definition)


@contextmanager
def connections(bag: rosbag.Bag) -> Iterator[list[Connection]]:
    """Yield the connections of a bag, whose messages can meanwhile be read as bytes.

    rosbag would make the classes with genpy, which runs what a definition has in place of a
    constant's name. One thread reads recordings, as rosbag keeps the classes of all of them.
    """
    listed: list[Connection] = []
    for _ in bag.read_messages(connection_filter=lambda *about: listed.append(Connection(*about))):
        pass  # The filter returns None for each connection, so nothing is read.
    classes = rosbag.bag._message_types  # noqa: SLF001  it offers no other way
    kept = dict(classes)
    classes.update({about.md5sum: rospy.AnyMsg for about in listed})
    try:
        yield listed
    finally:
        classes.clear()
        classes.update(kept)


@lru_cache(maxsize=200)
def _kind(type_name: str, md5sum: str, definition: str) -> Any:
    installed = message_class(type_name)
    if installed and installed._md5sum == md5sum:
        return installed
    with suppress(Exception):  # genmsg and Python raise many kinds
        if _TYPE.fullmatch(type_name):
            return generate_dynamic(type_name, fields_alone(definition))[type_name]
    return None


def fields_alone(definition: str) -> str:
    """Return a definition without constants and comments, which decode nothing."""
    lines = (line.partition("#")[0].strip() for line in definition.splitlines())
    return "\n".join(filter(_LINE.fullmatch, lines))
