"""The node: looks at the graph of the master, and starts the SDK's server and the relay."""

from __future__ import annotations

import asyncio
import socket
import ssl
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import foxglove
import rospkg
import rospy
from foxglove.websocket import Capability, StatusLevel
from rosgraph_msgs.msg import Clock

from foxglove_bridge_server.io.relay import serve
from foxglove_bridge_server.messages import serialised
from foxglove_bridge_server.parameters import BridgeParameters, is_allowed
from foxglove_bridge_server.ros.client_topics import ClientTopics
from foxglove_bridge_server.ros.master import ask
from foxglove_bridge_server.ros.master_parameters import MasterParameters
from foxglove_bridge_server.ros.services import Services
from foxglove_bridge_server.ros.topic_channels import ENCODING, TopicChannels
from node_kit.printable import quotable
from node_kit.ros.lifecycle.ending import is_ending
from node_kit.ros.log import Log
from node_kit.rules.answer import Answer

LONGEST_LOOK_S = 1.0  # between two looks at the master
BACKLOG = 256  # messages that the SDK keeps for a client; then it drops the oldest
SWITCH_S = 0.0005  # how long a thread may keep the others waiting
CLOCK, PACKAGE = "/clock", "package://"


class Bridge:
    """Shows a master to clients of Foxglove's protocol.

    Subscribes: what clients subscribe to; the velocities on which they publish; /clock where
        /use_sim_time is true
    Publishes: what clients publish
    Parameters: parameters.BridgeParameters, as a table in README.md
    """

    def __init__(
        self, parameters: BridgeParameters, listener: socket.socket, tls: ssl.SSLContext | None
    ) -> None:
        self._parameters, self._socket, self._tls = parameters, listener, tls
        self._log = Log()
        self._state: list[Any] | None = None  # of the master, as its getSystemState returns it
        self._master_pid, self._has_lost_master = ask("getPid")[1], False
        is_simulated = bool(rospy.get_param("/use_sim_time", False))
        words = {*parameters.capabilities, *(["time"] if is_simulated else [])}
        self._client_topics = ClientTopics(parameters.client_topic_whitelist, self._warn)
        self._values = MasterParameters(parameters.param_whitelist, self._warn)
        context = foxglove.Context()
        self._topics = TopicChannels(context, CLOCK if is_simulated else "")
        self._server = foxglove.start_server(
            name="foxglove_bridge",
            port=0,
            capabilities=[getattr(Capability, _sdk_name(w)) for w in words - {"assets"}],
            server_listener=_listener(self._topics, self._client_topics, self._values, self),
            supported_encodings=[ENCODING],
            asset_handler=self._asset if "assets" in words else None,
            context=context,
            message_backlog_size=BACKLOG,
        )
        self._services = Services(self._server, self._warn) if "services" in words else None
        self._has_graph = "connectionGraph" in words
        if is_simulated:  # rospy itself subscribes to it, too, and makes one connection
            rospy.Subscriber(CLOCK, Clock, self._on_clock)

    def run(self) -> None:
        """Serve until the node is shut down."""
        sys.setswitchinterval(SWITCH_S)
        for line in self._parameters.ignored():
            self._log.warn(line)
        self._look()
        limit = self._parameters.send_buffer_limit
        relay = serve(self._socket, self._server.port, limit, self._tls)
        for work in (self._watch, lambda: asyncio.run(relay)):
            threading.Thread(target=work, daemon=True).start()
        host, port = self._socket.getsockname()[:2]
        if host in ("0.0.0.0", "::"):
            self._log.warn("everyone in the network can connect, publish and call services")
            host = socket.gethostname()
        host = f"[{host}]" if ":" in host else host
        self._log.info(f"foxglove_bridge: ws{'s' if self._tls else ''}://{host}:{port}")
        rospy.on_shutdown(self._client_topics.end)
        self._client_topics.run()
        self._server.stop()
        if self._has_lost_master:
            sys.exit("foxglove_bridge: the ROS master has exited")

    def on_connection_graph_subscribe(self) -> None:
        """Leave it to the SDK, which sends the last graph."""

    on_connection_graph_unsubscribe = on_connection_graph_subscribe

    def _warn(self, line: str) -> None:
        """Show a warning here and in all clients: the SDK cannot address one alone."""
        self._log.warn(quotable(line))
        self._server.publish_status(quotable(line), StatusLevel.Warning)

    def _asset(self, uri: str) -> bytes | None:
        package, _, name = uri[len(PACKAGE) :].partition("/")
        is_inside = uri.startswith(PACKAGE) and ".." not in name
        if not is_inside or not is_allowed(uri, self._parameters.asset_uri_allowlist):
            return None
        try:
            return Path(rospkg.RosPack().get_path(package), name).read_bytes()
        except (OSError, rospkg.ResourceNotFound):  # their texts name folders of this machine
            return None

    def _on_clock(self, message: Clock) -> None:
        self._server.broadcast_time(message.clock.to_nsec())
        self._topics.pass_on_clock(serialised(message))

    def _watch(self) -> None:
        period_s = min(self._parameters.max_update_ms / 1000, LONGEST_LOOK_S)
        while True:
            time.sleep(period_s)
            if is_ending():
                return
            answer, pid = ask("getPid")
            if answer is Answer.REFUSED or pid not in (None, self._master_pid):
                self._has_lost_master = True
                rospy.signal_shutdown("the master has gone")
                return
            self._look()
            changes = self._values.changes()
            if changes:
                self._server.publish_parameter_values(changes)

    def _look(self) -> None:
        """Ask the master what there is, and show it."""
        (answer, state), (typed, types) = ask("getSystemState"), ask("getTopicTypes")
        if {answer, typed} != {Answer.WELL}:
            return
        own, patterns = {rospy.get_name()}, self._parameters
        allowed = patterns.topic_whitelist, patterns.topic_whitelist, patterns.service_whitelist
        state = [
            [(name, nodes) for name, nodes in column if is_allowed(name, whitelist)]
            for column, whitelist in zip(state, allowed)
        ]
        published = {topic for topic, _ in state[0]}
        topics = published | {topic for topic, nodes in state[1] if set(nodes) - own}
        kinds = {topic: kind for topic, kind in types if topic in topics and kind != "*"}
        self._topics.show(kinds, published)
        if self._services:
            self._services.show({name for name, _ in state[2]})
        if self._has_graph and state != self._state:
            self._server.publish_connection_graph(_graph_of(state))
        self._state = state


def _listener(*parts: Any) -> SimpleNamespace:
    """Return an object with the methods of all parts that the SDK calls, in its threads."""
    methods = {n: getattr(p, n) for p in parts for n in dir(p) if n.startswith("on_")}
    return SimpleNamespace(**methods)


def _sdk_name(capability: str) -> str:
    """Return the name of a capability; the SDK always has both of those of parameters."""
    return capability[0].upper() + capability[1:].replace("sSubscribe", "s")


def _graph_of(state: Any) -> foxglove.ConnectionGraph:
    graph = foxglove.ConnectionGraph()
    setters = graph.set_published_topic, graph.set_subscribed_topic, graph.set_advertised_service
    for add, column in zip(setters, state):
        for name, nodes in column:
            add(name, nodes)
    return graph
