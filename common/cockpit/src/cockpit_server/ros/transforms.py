"""tf for the tabs that need it: the newest transforms, and who publishes them."""

from __future__ import annotations

import threading
from math import hypot, isfinite
from typing import Hashable, Protocol, Sequence

import genpy
import rospy
from geometry_msgs.msg import Transform, TransformStamped
from tf2_msgs.msg import TFMessage

from cockpit_server.graph import TF, TF_STATIC, GraphWatcher
from cockpit_server.messages import ReceivedMessage, Subscriptions, decoded

try:
    import tf2_py
except ImportError:  # It belongs to [more] of etc/packages, which a machine may lack.
    tf2_py = None

KEPT_S = 10.0  # how far back lookups reach: tf2's default
MOST_FRAMES, LONGEST_NAME = 2_000, 200  # in all; characters
LONGEST_MESSAGE = 1_000_000  # bytes
UNIT, UNIT_TOLERANCE = 1.0, 1e-3  # length of a rotation's quaternion; tf2 refuses 1e-3 and more
MISSING = "Install python3-tf2 (./tutorial setup does), and start the cockpit again."


class TfListener(Protocol):
    """What Transforms calls in rospy's threads, one call at a time."""

    def on_transform(
        self, stamped: TransformStamped, message: ReceivedMessage, refusal: str, now: float
    ) -> None:
        """Take a transform. refusal: why tf2 refuses it, or ""; now: of ROS's clock [s]."""

    def on_clear(self) -> None:
        """Forget all transforms: nobody needs them any more, or the time has gone back."""


class Transforms:
    """A buffer of tf2, which is filled while an owner needs it and empty otherwise."""

    def __init__(self, subscriptions: Subscriptions, graphs: GraphWatcher) -> None:
        self._subscriptions, self._graphs = subscriptions, graphs
        self._owners: set[Hashable] = set()
        self._lock = threading.Lock()
        self._buffer = tf2_py and tf2_py.BufferCore(genpy.Duration.from_sec(KEPT_S))
        self._stamps: dict[str, genpy.Time] = {}  # child frame -> its newest stamp
        self._now = 0.0  # [s] It goes back when a recording starts again.
        self._is_filled = False
        self.listeners: Sequence[TfListener] = ()

    def set_needed(self, owner: Hashable, is_needed: bool) -> None:
        """Subscribe to tf while an owner needs it; called twenty times a second by each."""
        (self._owners.add if is_needed else self._owners.discard)(owner)
        published = self._graphs.graph.published if self._owners else ()
        handlers = {topic: self._on_tf for topic in (TF, TF_STATIC) if topic in published}
        self._subscriptions.set_subscriptions(self, handlers, every=True)
        if not self._owners and self._is_filled:
            self._clear()

    def lookup(
        self, target: str, source: str, stamp: genpy.Time | None = None
    ) -> tuple[Transform | None, str]:
        """Return (the transform of points in source to target, "") or (None, why there is none).

        stamp: at that time, or the newest if the buffer does not reach it; None: the newest.
        """
        if self._buffer is None:
            return None, MISSING
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
            self._now, self._is_filled = now, True
            for stamped in transforms.transforms:
                self._add(stamped, message)

    def _add(self, stamped: TransformStamped, message: ReceivedMessage) -> None:
        for names in (stamped, stamped.header):  # as tf2 does for names of tf
            field = "child_frame_id" if names is stamped else "frame_id"
            setattr(names, field, getattr(names, field).lstrip("/"))
        refusal = refusal_of(stamped)
        if not refusal and not self._keep(stamped, message):
            return
        for listener in self.listeners:
            listener.on_transform(stamped, message, refusal, self._now)

    def _keep(self, stamped: TransformStamped, message: ReceivedMessage) -> bool:
        """Add a valid transform to the buffer; return False if it has too many frames."""
        child, stamp = stamped.child_frame_id, stamped.header.stamp
        if child not in self._stamps and len(self._stamps) >= MOST_FRAMES:
            return False
        # tf2 prints a warning for each repeated or old transform.
        last = self._stamps.get(child)
        self._stamps[child] = stamp if last is None else max(stamp, last)
        if self._buffer is None:
            return True
        if message.topic == TF_STATIC:
            self._buffer.set_transform_static(stamped, message.sender)
        elif last is None or stamp > last:
            self._buffer.set_transform(stamped, message.sender)
        return True

    def _clear(self) -> None:
        if self._buffer is not None:
            self._buffer.clear()
        self._stamps.clear()
        self._is_filled = False
        for listener in self.listeners:
            listener.on_clear()


def refusal_of(stamped: TransformStamped) -> str:
    """Return why tf2 refuses a transform, or ""; tf2 itself prints an error for each."""
    parent, child = stamped.header.frame_id, stamped.child_frame_id
    place, turn = stamped.transform.translation, stamped.transform.rotation
    length = hypot(turn.x, turn.y, turn.z, turn.w)
    if not parent or not child:
        return f"its {'child_frame_id' if parent else 'header.frame_id'} is empty"
    if parent == child:
        return "it is its own parent"
    if max(len(parent), len(child)) > LONGEST_NAME:
        return f"a name has more than {LONGEST_NAME} characters"
    if not all(map(isfinite, (place.x, place.y, place.z, length))):
        return "a number is infinite or NaN"
    if abs(length - UNIT) >= UNIT_TOLERANCE:
        return f"the length of its quaternion is {length:.3g}, not 1"
    return ""
