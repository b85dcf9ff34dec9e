#!/usr/bin/python3
"""The least that tornado can do: a WebSocket that sends back what it gets. echo.py PORT."""

import sys

from tornado.ioloop import IOLoop
from tornado.web import Application
from tornado.websocket import WebSocketHandler


class Echo(WebSocketHandler):
    def check_origin(self, origin):
        return True

    def open(self):
        self.set_nodelay(True)

    def on_message(self, message):
        self.write_message(message)


Application([("/ws", Echo)]).listen(int(sys.argv[1]), "127.0.0.1")
IOLoop.current().start()
