"""A publisher that sends from the thread that publishes, and does not let a subscriber stall it.

rospy offers one or the other. With a queue_size it wakes a thread for each subscriber and message,
which costs half of this node's processor time. Without one it sends at once, but then waits for as
long as any single subscriber does not read. This is the second, with an end to the waiting: who
has let the buffers of its connection run full is disconnected, and may connect again.
"""

import socket
import struct

import rospy

# How long a send may wait for a full buffer, as a struct timeval: 0 s and 1000 us. Only once for
# each subscriber that stalls, so even some of them do not cost a period of 20 ms.
SEND_TIMEOUT = struct.pack("@ll", 0, 1000)


class PromptPublisher(rospy.SubscribeListener):
    """Publishes as rospy.Publisher does, from the caller's thread, within a millisecond."""

    def __init__(self, topic, message_class):
        """Advertise the topic; nothing is latched."""
        super().__init__()
        self._publisher = rospy.Publisher(topic, message_class, queue_size=1)
        self._publisher.impl.set_queue_size(None)  # no threads; given late, it brings no warning
        self._publisher.impl.add_subscriber_listener(self)
        self.publish = self._publisher.publish
        self._limit_waiting()  # of those who came before the listener

    def peer_subscribe(self, _topic, _publish, _publish_to_peer):
        """Take care of a new connection; rospy calls this."""
        self._limit_waiting()

    def _limit_waiting(self):
        for connection in self._publisher.impl.connections:
            if connection.socket:
                connection.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, SEND_TIMEOUT)
