"""Registers the services of a node before it loads rospy; they answer afterwards.

`rosservice call` in the same launch file looks up a service once, as soon as it has loaded rospy.
A Python node that registers its services only then is too late.
"""

from __future__ import annotations

import atexit
import os
import signal
import socket
import sys
from dataclasses import dataclass
from typing import Any, Sequence

import rosgraph
from rosgraph import network
from rosgraph.names import get_ros_namespace, load_mappings, ns_join, resolve_name

from node_kit.ros.graph.ros_api import call
from node_kit.rules.answer import Answer

MOST_WAITING = 128  # callers


@dataclass(frozen=True)
class Announcement:
    """A node and its services, by name. listener: where callers wait. place: keeps node_port."""

    node: str
    services: Sequence[str]
    listener: socket.socket
    place: socket.socket

    @property
    def node_port(self) -> int:
        """The port for rospy.init_node(), which the master knows already."""
        return int(self.place.getsockname()[1])

    @property
    def address(self) -> str:
        """The address of the services on the master."""
        return f"rosrpc://{network.get_host_name()}:{self.listener.getsockname()[1]}"

    def register(self) -> None:
        """Register the services, and withdraw them if the start fails."""
        atexit.register(self.withdraw)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._end)  # the node's own handlers replace it
        uri = network.create_local_xmlrpc_uri(self.node_port)
        for service in self.services:
            self._call_master("registerService", service, self.address, uri)

    def withdraw(self) -> None:
        """Unregister the services, unless the node itself has registered them since."""
        for service in self.services:
            self._call_master("unregisterService", service, self.address)

    def keep(self) -> None:
        """Leave the services to the node, which has registered them now."""
        atexit.unregister(self.withdraw)
        self.place.close()

    def _call_master(self, *request: str) -> None:
        call(rosgraph.get_master_uri(), *request, caller=self.node)

    def _end(self, number: int, _frame: Any) -> None:
        self.withdraw()
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)


def announce(name: str, services: Sequence[str]) -> Announcement | None:
    """Register services of a node that is about to start, the most urgent first.

    Return None, and register nothing, if there is no master or if the node or one of the services
    is registered. name: the default of the node, unless __name:= is given.
    """
    node, given = full_name(name), load_mappings(sys.argv)
    remapped = {
        resolve_name(source, node): resolve_name(target, node)
        for source, target in given.items()
        if not source.startswith("__")
    }
    names = [resolve_name(service, node, remapped) for service in services]
    answer, state = call(rosgraph.get_master_uri(), "getSystemState", caller=node)
    if answer is not Answer.WELL:
        return None
    nodes = {user for column in state for _, users in column for user in users}
    if node in nodes or not {service for service, _ in state[2]}.isdisjoint(names):
        return None
    announcement = Announcement(node, names, _bound(), _bound())
    announcement.listener.listen(MOST_WAITING)
    announcement.register()
    return announcement


def full_name(name: str) -> str:
    """Return the name of this node with its namespace."""
    return str(ns_join(get_ros_namespace(), load_mappings(sys.argv).get("__name", name)))


def _bound() -> socket.socket:
    """Return a socket that reserves a port, which a server of rospy may take."""
    bound = socket.socket(socket.AF_INET6 if network.use_ipv6() else socket.AF_INET)
    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    bound.bind((network.get_bind_address(), 0))
    return bound
