#!/usr/bin/env python
"""Start a server of WebSockets, as the program of this name does."""

import rospy
from rosbridge_server import Clients
from tornado.ioloop import IOLoop
from tornado.web import Application

rospy.init_node("rosbridge_websocket", disable_signals=True)
address, port = rospy.get_param("~address"), rospy.get_param("~port")
Application([("/", Clients)]).listen(port, address)
rospy.loginfo("server started at ws://%s:%s", address, port)
IOLoop.current().start()
