"""tf for the tabs that need it: the newest transforms, and who publishes them."""

from __future__ import annotations

import threading
from math import hypot, isfinite
from typing import Callable, Hashable, Sequence

import genpy
import rospy
import tf2_py
from geometry_msgs.msg import Transform, TransformStamped
from tf2_msgs.msg import TFMessage

from cockpit_server.graph import GraphWatcher
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded

TF, TF_STATIC = "/tf", "/tf_static"
KEPT_S = 10.0  # how far back lookups reach: tf2's default
MOST_FRAMES, LONGEST_NAME = 2_000, 200  # in all; characters
LONGEST_MESSAGE = 1_000_000  # bytes
UNIT, UNIT_TOLERANCE = 1.0, 1e-3  # length of a rotation's quaternion; tf2 refuses 1e-3 and more
Listener = Callable[[TransformStamped, ReceivedMessage], None]


class Transforms:
    """A buffer of tf2, which is filled while an owner needs it and empty otherwise.

    Messages arrive in rospy's threads. listeners: called there with each valid transform.
    """

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._owners: set[Hashable] = set()
        self._lock = threading.Lock()
        self._buffer = tf2_py.BufferCore(genpy.Duration.from_sec(KEPT_S))
        self._stamps: dict[str, genpy.Time] = {}  # child frame -> its newest stamp
        self._now = 0.0  # of ROS's clock, which goes back when a recording starts again [s]
        self.listeners: Sequence[Listener] = ()

    def set_needed(self, owner: Hashable, is_needed: bool) -> None:
        """Subscribe to tf while an owner needs it; called twenty times a second by each."""
        (self._owners.add if is_needed else self._owners.discard)(owner)
        published = self._graphs.graph.published if self._owners else ()
        handlers = {topic: self._on_tf for topic in (TF, TF_STATIC) if topic in published}
        self._subscriptions.set_subscriptions(self, handlers, every=True)
        if not self._owners and self._stamps:
            self._clear()

    def lookup(
        self, target: str, source: str, stamp: genpy.Time | None = None
    ) -> tuple[Transform | None, str]:
        """Return (the transform of points in source to target, "") or (None, why there is none).

        stamp: at that time, or the newest if the buffer does not reach it; None: the newest.
        """
        times = (stamp, genpy.Time(0)) if stamp else (genpy.Time(0),)
        why = ""
        for time in times:
            try:
                names = target.lstrip("/"), source.lstrip("/")
                return self._buffer.lookup_transform_core(*names, time).transform, ""
            except tf2_py.TransformException as error:
                why = why or str(error).strip()
        return None, why

    def _on_tf(self, message: ReceivedMessage) -> None:
        transforms = decoded(TFMessage, message.data, LONGEST_MESSAGE) or TFMessage()
        with self._lock:
            now = rospy.get_time()
            if now < self._now:
                self._clear()
            self._now = now
            for stamped in transforms.transforms:
                self._add(stamped, message)

    def _add(self, stamped: TransformStamped, message: ReceivedMessage) -> None:
        for names in (stamped, stamped.header):  # as tf2 does for names of tf
            field = "child_frame_id" if names is stamped else "frame_id"
            setattr(names, field, getattr(names, field).lstrip("/"))
        if not is_valid(stamped):
            return
        child, stamp = stamped.child_frame_id, stamped.header.stamp
        if child not in self._stamps and len(self._stamps) >= MOST_FRAMES:
            return
        # tf2 prints a warning for each repeated or old transform.
        last = self._stamps.get(child)
        if message.topic == TF_STATIC:
            self._buffer.set_transform_static(stamped, message.sender)
        elif last is None or stamp > last:
            self._buffer.set_transform(stamped, message.sender)
        self._stamps[child] = stamp if last is None else max(stamp, last)
        for listener in self.listeners:
            listener(stamped, message)

    def _clear(self) -> None:
        self._buffer.clear()
        self._stamps.clear()


def is_valid(stamped: TransformStamped) -> bool:
    """Return whether tf2 accepts a transform; it prints an error for each other one."""
    parent, child = stamped.header.frame_id, stamped.child_frame_id
    place, turn = stamped.transform.translation, stamped.transform.rotation
    length = hypot(turn.x, turn.y, turn.z, turn.w)
    numbers = (place.x, place.y, place.z, length)
    return (
        bool(parent and child)
        and parent != child
        and max(len(parent), len(child)) <= LONGEST_NAME
        and all(map(isfinite, numbers))
        and abs(length - UNIT) < UNIT_TOLERANCE
    )
