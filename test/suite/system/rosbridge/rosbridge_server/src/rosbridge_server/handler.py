"""What a client sends is published; a service may check who it is."""

import rospy
import std_msgs.msg
from rosauth.srv import Authentication
from rosbridge_msgs.msg import Clients as ClientsMessage
from tornado.websocket import WebSocketHandler


class Clients(WebSocketHandler):
    """The connection of a client; counts all clients."""

    count = 0

    def open(self):
        if rospy.get_param("~authenticate"):
            rospy.ServiceProxy("authenticate", Authentication)()
        self._text = rospy.Publisher("from_client", std_msgs.msg.String, queue_size=1, latch=True)
        counts = rospy.Publisher("client_count", ClientsMessage, queue_size=1, latch=True)
        Clients.count += 1
        counts.publish(count=Clients.count)

    def on_message(self, message):
        self._text.publish(message)
