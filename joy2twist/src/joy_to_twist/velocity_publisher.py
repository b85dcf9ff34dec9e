"""Publishes velocities from the caller's thread, and never waits for a subscriber."""

import struct

import rospy
from geometry_msgs.msg import Twist
from node_kit.newest_only import NewestOnly

from joy_to_twist.limits import ZERO

# A Twist on the wire, little-endian: the number of bytes that follow (uint32), then linear x, y, z
# and angular x, y, z (float64). Packed here, because rospy's way takes several times as long.
_TWIST = struct.Struct("<I6d")
_TWIST_BYTES = _TWIST.size - 4
_STOP = _TWIST.pack(_TWIST_BYTES, *ZERO)


class VelocityPublisher(rospy.SubscribeListener):
    """A publisher of geometry_msgs/Twist, at once as fast as rospy can and safe from its peers.

    rospy offers one or the other: with queue_size=None it sends from the thread that publishes,
    which then waits for as long as any one subscriber does not read; with a queue it hands every
    message to one thread for each subscriber, which takes longer. Here rospy finds and greets the
    subscribers, but the sending is done by NewestOnly, which never waits.
    """

    def __init__(self, name, warn):
        """name: of the topic; relative, so that it can be remapped. Never latched.

        warn: called with a line when a subscriber cannot be reached, and when it is told again.
        """
        self._warn = warn
        self._peers = {}  # rospy's connection -> NewestOnly
        self._publisher = rospy.Publisher(name, Twist, queue_size=1, latch=False)
        self._publisher.impl.set_queue_size(None)  # no thread for each subscriber
        self._publisher.impl.add_subscriber_listener(self)
        self._update_peers()  # whoever subscribed before the listener was there

    @property
    def name(self):
        """The topic, as it was remapped."""
        return self._publisher.resolved_name

    @property
    def listeners(self):
        """How many subscribers are connected."""
        return len(self._peers)

    def publish(self, velocity):
        """Send a velocity: linear x, y, z [m/s] and angular x, y, z [rad/s], frame of the base."""
        message = _TWIST.pack(_TWIST_BYTES, *velocity)
        stops = velocity == ZERO
        for connection, peer in self._peers.items():
            try:
                peer.write(message, stops)
            except OSError:
                connection.close()  # rospy takes it off its list and calls peer_unsubscribe()

    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        """Called by rospy when a subscriber has connected."""
        self._update_peers()

    def peer_unsubscribe(self, topic_name, num_peers):
        """Called by rospy when a subscriber has left."""
        self._update_peers()

    def _update_peers(self):
        # A new dict, because publish() may be going through the old one.
        self._peers = {
            connection: self._peers.get(connection) or self._peer(connection)
            for connection in self._publisher.impl.connections
            if connection.socket  # not closed meanwhile
        }

    def _peer(self, connection):
        def tell(is_cut):
            self._warn(
                f"The network to {connection.endpoint_id} is cut: it is told to stop, and nothing "
                "else until it can be reached and the dead-man button and the sticks are released."
                if is_cut
                else f"The network to {connection.endpoint_id} is back: it can be driven again."
            )

        return NewestOnly(connection.socket, _STOP, tell)
