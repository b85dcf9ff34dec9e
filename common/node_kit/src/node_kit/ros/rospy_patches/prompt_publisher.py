"""Publishes from the caller's thread, and never waits for a subscriber.

rospy offers one or the other: with queue_size=None it sends from the thread that publishes, which
then waits for any subscriber that does not read; with a queue one thread for each subscriber sends,
which takes longer. Here rospy finds and greets the subscribers, and NewestOnly sends.
"""

from __future__ import annotations

import io
import struct
from typing import Any, Callable, Dict

import rospy
from geometry_msgs.msg import Twist
from rospy.msg import serialize_message

from node_kit.ros.rospy_patches.connections import header_of
from node_kit.ros.rospy_patches.newest_only import NewestOnly
from node_kit.rules.arming import ZERO, Velocity

Peers = Dict[Any, NewestOnly]  # by rospy's connection


class PromptPublisher(rospy.SubscribeListener):
    """Publishes messages of any type; a subscriber that is behind gets the newest only."""

    def __init__(
        self, name: str, message_class: type, headers: dict[str, str] | None = None
    ) -> None:
        """Take the name of the topic, relative, so that it can be remapped. Never latched.

        headers: what subscribers find in the header of the connection, besides ROS's own fields.
        """
        super().__init__()
        self._peers: Peers = {}
        self._sequence = 0
        self._buffer = io.BytesIO()
        self._publisher = rospy.Publisher(
            name, message_class, queue_size=1, latch=False, headers=headers
        )
        self._publisher.impl.set_queue_size(None)  # no threads; given late, it brings no warning
        self._publisher.impl.add_subscriber_listener(self)
        self._update_peers()  # those that subscribed before the listener was added

    @property
    def name(self) -> str:
        """The topic, as it was remapped."""
        return self._publisher.resolved_name

    @property
    def listeners(self) -> int:
        """How many subscribers are connected."""
        return len(self._peers)

    @property
    def names(self) -> set[str]:
        """The names of the nodes that are connected."""
        return {connection.endpoint_id for connection in self._peers}

    def publish(self, message: Any) -> None:
        """Send a message; one thread at a time."""
        self._sequence += 1
        if self._peers:
            self._buffer.seek(0)
            self._buffer.truncate()
            serialize_message(self._buffer, self._sequence, message)
            self.send(self._buffer.getvalue())

    def send(self, data: bytes) -> None:
        """Send the bytes of a message with its length before it."""
        for connection, peer in self._peers.items():
            try:
                peer.write(data)
            except OSError:
                connection.close()  # rospy takes it off its list and calls peer_unsubscribe()

    def end(self) -> None:
        """Close all connections and unregister."""
        self._publisher.unregister()

    def peer_subscribe(self, *_: object) -> None:  # rospy calls it, and the next
        self._update_peers()

    def peer_unsubscribe(self, *_: object) -> None:
        self._update_peers()

    def _update_peers(self) -> None:
        # A new dict, because send() may be going through the old one.
        self._peers = {
            connection: self._peers.get(connection) or self._peer(connection)
            for connection in self._publisher.impl.connections
            if connection.socket  # not closed meanwhile
        }

    def _peer(self, connection: Any) -> NewestOnly:
        return NewestOnly(connection.socket)


# A field in the header of connections on which a person's hands drive, hold-to-run style.
_HOLD_TO_RUN = "hold_to_run"


def is_hold_to_run(message: Any) -> bool:
    """Return whether a velocity came from a VelocityPublisher with hold_to_run."""
    return header_of(message).get(_HOLD_TO_RUN) == "1"


# A Twist on the wire, little-endian: the number of bytes that follow (uint32), then linear x, y, z
# and angular x, y, z (float64). Packed here, because rospy's way takes several times as long.
_TWIST = struct.Struct("<I6d")
_TWIST_BYTES = _TWIST.size - 4
_STOP = _TWIST.pack(_TWIST_BYTES, *ZERO)
# Enough for some velocities. More would only keep old ones for a subscriber that does not read.
_BUFFER_BYTES = 8192
UNTIL_RELEASED = (
    "It gets nothing more until it can be reached and the dead-man button and the sticks are "
    "released."
)


class VelocityPublisher(PromptPublisher):
    """Publishes geometry_msgs/Twist; a robot that was lost is not driven on when it is back.

    A subscriber whose network was cut gets no velocity before all is released; nor does one
    that connects in the middle of a motion, such as a robot that was restarted.
    """

    def __init__(self, name: str, warn: Callable[[str], object], hold_to_run: bool = False) -> None:
        """Take warn(line), called when a subscriber is held or free again; it must not wait.

        hold_to_run: tell a multiplexer that a person's hands drive, who can release the stick, and
        that no two velocities of a motion are more than SILENCE_S apart.
        """
        self._warn = warn
        self._holds_new = False  # a new subscriber does not take part in the present motion
        super().__init__(name, Twist, {_HOLD_TO_RUN: "1"} if hold_to_run else None)

    def publish(
        self, velocity: Velocity | None, released: bool = False, hold_new: bool = False
    ) -> None:
        """Send a velocity: linear x, y, z [m/s] and angular x, y, z [rad/s], frame of the base.

        None sends nothing. released: all was seen released, so lost subscribers are driven again.
        hold_new: subscribers that connect from now on are held, if this is a motion.
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
