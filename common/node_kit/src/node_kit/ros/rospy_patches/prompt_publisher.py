"""Publishes from the caller's thread, and never waits for a subscriber.

rospy offers only one of the two: with queue_size=None, the publishing thread sends, and waits for
any subscriber that does not read; with a queue, one thread for each subscriber sends, which takes
longer. Here rospy finds and greets the subscribers, and NewestOnly sends.
"""

from __future__ import annotations

import io
import struct
from typing import Any, Callable, Dict

import rospy
from geometry_msgs.msg import Twist
from rospy.msg import serialize_message

from node_kit.io.newest_only import NewestOnly
from node_kit.ros.rospy_patches.connections import header_of
from node_kit.rules.arming import ZERO, Velocity

Peers = Dict[Any, NewestOnly]  # by rospy's connection


class PromptPublisher(rospy.SubscribeListener):
    """Publishes messages of any type; a subscriber that is behind gets only the newest."""

    def __init__(
        self, name: str, message_class: type, headers: dict[str, str] | None = None
    ) -> None:
        """Take the name of the topic, relative, so that it can be remapped. Never latched.

        headers: fields for the header of the connection, in addition to those of ROS.
        """
        super().__init__()
        self._peers: Peers = {}
        self._sequence = 0
        self._buffer = io.BytesIO()
        self._publisher = rospy.Publisher(
            name, message_class, queue_size=1, latch=False, headers=headers
        )
        self._publisher.impl.set_queue_size(
            None
        )  # no threads; set afterwards, this causes no warning
        self._publisher.impl.add_subscriber_listener(self)
        self._update_peers()  # nodes that subscribed before the listener was added

    @property
    def name(self) -> str:
        """The resolved name of the topic."""
        return self._publisher.resolved_name

    @property
    def listeners(self) -> int:
        """The number of connected subscribers."""
        return len(self._peers)

    @property
    def names(self) -> set[str]:
        """The names of the connected nodes."""
        return {connection.endpoint_id for connection in self._peers}

    def publish(self, message: Any) -> None:
        """Send a message; call this from one thread at a time."""
        self._sequence += 1
        if self._peers:
            self._buffer.seek(0)
            self._buffer.truncate()
            serialize_message(self._buffer, self._sequence, message)
            self.send(self._buffer.getvalue())

    def send(self, data: bytes) -> None:
        """Send the bytes of a message, which begin with its length."""
        for connection, peer in self._peers.items():
            try:
                peer.write(data)
            except OSError:
                connection.close()  # rospy then removes it and calls peer_unsubscribe()

    def end(self) -> None:
        """Close all connections and unregister."""
        self._publisher.unregister()

    def peer_subscribe(self, *_: object) -> None:  # called by rospy, as is the next
        self._update_peers()

    def peer_unsubscribe(self, *_: object) -> None:
        self._update_peers()

    def _update_peers(self) -> None:
        # A new dict, because send() may be iterating over the old one.
        self._peers = {
            connection: self._peers.get(connection) or self._peer(connection)
            for connection in self._publisher.impl.connections
            if connection.socket  # not yet closed
        }

    def _peer(self, connection: Any) -> NewestOnly:
        return NewestOnly(connection.socket)


# A field in the header of connections through which a person drives, hold-to-run style.
_HOLD_TO_RUN = "hold_to_run"


def is_hold_to_run(message: Any) -> bool:
    """Return whether a velocity came from a VelocityPublisher with hold_to_run."""
    return header_of(message).get(_HOLD_TO_RUN) == "1"


# A Twist on the wire, little-endian: the number of bytes that follow (uint32), then linear x, y, z
# and angular x, y, z (float64). Packed here, as rospy takes several times as long.
_TWIST = struct.Struct("<I6d")
_TWIST_BYTES = _TWIST.size - 4
_STOP = _TWIST.pack(_TWIST_BYTES, *ZERO)
# Enough for a few velocities. More would only keep old ones for a subscriber that does not read.
_BUFFER_BYTES = 8192
UNTIL_RELEASED = (
    "It gets nothing more until it can be reached and the dead-man button and the sticks are "
    "released."
)


class VelocityPublisher(PromptPublisher):
    """Publishes geometry_msgs/Twist; a robot that was lost stays stopped when it is back.

    A subscriber gets no velocity until everything is released if its network was cut, or if it
    connects during a motion, as a restarted robot does.
    """

    def __init__(self, name: str, warn: Callable[[str], object], hold_to_run: bool = False) -> None:
        """Take warn(line), called when a subscriber is held or in use again; it must not block.

        hold_to_run: declare to a multiplexer that a person drives, who can release the stick, and
        that successive velocities of a motion are at most SILENCE_S apart.
        """
        self._warn = warn
        self._holds_new = False  # a new subscriber does not join the current motion
        super().__init__(name, Twist, {_HOLD_TO_RUN: "1"} if hold_to_run else None)

    def publish(
        self, velocity: Velocity | None, released: bool = False, hold_new: bool = False
    ) -> None:
        """Send a velocity: linear x, y, z [m/s] and angular x, y, z [rad/s], frame of the base.

        None sends nothing. released: everything was released, so lost subscribers are driven again.
        hold_new: hold subscribers that connect from now on, if this is a motion.
        """
        if released:
            self._free()
        if velocity is not None:
            self._holds_new = hold_new and velocity != ZERO
            self.send(_TWIST.pack(_TWIST_BYTES, *velocity))

    def _free(self) -> None:
        for connection, peer in self._peers.items():
            if peer.held:
                try:
                    peer.free()
                except OSError:
                    connection.close()

    def _peer(self, connection: Any) -> NewestOnly:
        name = connection.endpoint_id
        held = self._holds_new

        def report(is_cut: bool) -> None:
            if is_cut:
                self._warn(f"The network to {name} is cut: it gets a last stop. {UNTIL_RELEASED}")
            else:
                self._warn(f"{name} is back: it can be driven again.")

        if held:
            self._warn(f"{name} has come in the middle of a motion. {UNTIL_RELEASED}")
        return NewestOnly(connection.socket, _STOP, report, _BUFFER_BYTES, held)
