"""Questions to a master or a node that always end in time (rospy's own may wait for ever)."""

import os
import socket
import threading
import xmlrpc.client
from enum import Enum

TIMEOUT_S = 2.0  # for each question; on one network an answer takes milliseconds


class Answer(Enum):
    """What comes back from a master or a node."""

    WELL = "answers"
    MALFORMED = "is not of the form http://HOST:PORT"
    UNKNOWN_NAME = "has a name that cannot be looked up here"
    REFUSED = "is not there, nothing listens on its port"
    SILENT = "does not answer"
    STRANGE = "is something else, and not of ROS"


class _Transport(xmlrpc.client.Transport):
    def __init__(self, timeout_s):
        super().__init__()
        self._timeout_s = timeout_s

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._timeout_s
        return connection


def call(uri, method, *arguments, caller=None, timeout_s=TIMEOUT_S):
    """Ask a master or a node, as `caller` or as nobody; return (Answer, value or None)."""
    answer = [(Answer.SILENT, None)]

    def ask():
        answer[0] = _call(uri, method, arguments, caller or f"/question_{os.getpid()}", timeout_s)

    # Not only a timeout of the socket: another kind of server may send and send, and a look-up of a
    # name has none.
    thread = threading.Thread(target=ask, daemon=True)
    thread.start()
    thread.join(2 * timeout_s)
    return answer[0]


def _call(uri, method, arguments, caller, timeout_s):
    try:
        with xmlrpc.client.ServerProxy(uri, transport=_Transport(timeout_s)) as server:
            code, _, value = getattr(server, method)(caller, *arguments)
    except ConnectionRefusedError:
        return Answer.REFUSED, None
    except socket.gaierror:
        return Answer.UNKNOWN_NAME, None
    except ConnectionError:
        return Answer.STRANGE, None
    except OSError:  # a timeout, or no way to that host
        return Answer.SILENT, None
    except Exception:  # whatever that program said, ROS does not say so
        return Answer.STRANGE, None
    return (Answer.WELL, value) if code == 1 else (Answer.STRANGE, value)
