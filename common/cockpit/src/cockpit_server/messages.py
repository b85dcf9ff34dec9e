"""Messages of any type: how they arrive and are decoded."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Callable, Hashable, Mapping, NamedTuple, Protocol

import numpy as np


class ReceivedMessage(NamedTuple):
    """A message that is not decoded yet."""

    topic: str
    data: bytes
    sender: str  # name of its node, "" if unknown
    arrived: float  # [s] of the monotonic clock


Handler = Callable[[ReceivedMessage], None]


class Subscriptions(Protocol):
    """The topics that the cockpit is subscribed to: see ros/feeds.py."""

    def set_subscriptions(
        self, owner: Hashable, handlers: Mapping[str, Handler], every: bool
    ) -> None: ...


def decoded(kind: Any, data: bytes, longest: float = float("inf"), as_arrays: bool = False) -> Any:
    """Return a message of a class from at most so many bytes; None if malformed.

    as_arrays: its lists of numbers are arrays of numpy, which is fast for a map or a scan.
    """
    with suppress(Exception):  # A message class may raise anything for malformed bytes.
        if len(data) <= longest:
            return kind().deserialize_numpy(data, np) if as_arrays else kind().deserialize(data)
    return None
