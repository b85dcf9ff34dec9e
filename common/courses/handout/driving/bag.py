"""A recorder that reads a bag of Joys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Tuple

from tutorial_check import Workspace

from ..task import JOY


@dataclass(frozen=True)
class Bag:
    """The content of a bag."""

    error: str = ""  # why it cannot be read
    topics: Tuple[str, ...] = ()
    axes: Optional[int] = None  # of the first Joy; None: there is no Joy


def bag(workspace: Workspace, path: str) -> Bag:
    """Read a bag. path: within src."""
    import rosbag  # noqa: PLC0415

    try:
        with rosbag.Bag(str(workspace.source / path)) as opened:
            topics = tuple(opened.get_type_and_topic_info().topics)
            _, joy, _ = next(opened.read_messages(topics=[JOY, "joy"]), (None, None, None))
    except (rosbag.ROSBagException, OSError, ValueError, KeyError, EOFError) as error:
        return Bag(str(error) or type(error).__name__)
    return Bag("", topics, None if joy is None else len(getattr(joy, "axes", ())))
