"""The node: looks at the graph of the master, and starts the SDK's server and the relay."""

from __future__ import annotations

import socket
import ssl
import sys
import threading
import time
from io import BytesIO
from typing import Any, Callable

import foxglove
import rosgraph
import rospkg
import rospy
from foxglove.websocket import Capability, StatusLevel
from rosgraph_msgs.msg import Clock

from foxglove_bridge_server.assets import read_asset
from foxglove_bridge_server.io.relay import Relay
from foxglove_bridge_server.parameters import BridgeParameters, ignored, is_allowed
from foxglove_bridge_server.ros.client_topics import ClientTopics
from foxglove_bridge_server.ros.master_parameters import MasterParameters, as_parameters
from foxglove_bridge_server.ros.services import Services
from foxglove_bridge_server.ros.topic_channels import ENCODING, TopicChannels
from node_kit.ros.graph.ros_api import call
from node_kit.ros.lifecycle.ending import is_ending
from node_kit.ros.log import Log
from node_kit.rules.answer import Answer

LONGEST_LOOK_S = 1.0  # between two looks at the master
BACKLOG = 1024  # messages that the SDK keeps for a client; then it drops the oldest
SWITCH_S = 0.0005  # how long a thread may keep the others waiting
CLOCK = "/clock"
SDK_NAMES = {
    "clientPublish": Capability.ClientPublish,
    "parameters": Capability.Parameters,
    "parametersSubscribe": Capability.Parameters,
    "services": Capability.Services,
    "connectionGraph": Capability.ConnectionGraph,
    "time": Capability.Time,
}


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
        self._parameters, self._log = parameters, Log()
        is_simulated = bool(rospy.get_param("/use_sim_time", False))
        self._state: Any = None
        self._master_pid = _ask("getPid")[1]
        self.has_lost_master = False
        self._publishing = ClientTopics(parameters.client_topic_whitelist, self._warn)
        self._values = MasterParameters(parameters.param_whitelist)
        context = foxglove.Context()
        self._topics = TopicChannels(context, CLOCK if is_simulated else None)
        words = {*parameters.capabilities, *(["time"] if is_simulated else [])}
        self._has_graph = "connectionGraph" in words
        self._server = foxglove.start_server(
            name="foxglove_bridge",
            port=0,
            capabilities=[SDK_NAMES[word] for word in words & set(SDK_NAMES)],
            server_listener=_Listener(self._topics, self._publishing, self._values, self._warn),
            supported_encodings=[ENCODING],
            asset_handler=self._asset if "assets" in words else None,
            context=context,
            message_backlog_size=BACKLOG,
        )
        self._services = Services(self._server, self._warn) if "services" in words else None
        self._listener, self._tls = listener, tls
        if is_simulated:  # rospy itself subscribes to it, too, and makes one connection
            rospy.Subscriber(CLOCK, Clock, self._on_clock)

    def run(self) -> None:
        """Serve until the node is shut down."""
        sys.setswitchinterval(SWITCH_S)
        for line in ignored(self._parameters):
            self._log.warn(line)
        self._look()
        threading.Thread(target=self._watch, daemon=True).start()
        Relay(self._listener, self._server.port, self._parameters.send_buffer_limit, self._tls)
        host, port = self._listener.getsockname()[:2]
        self._log.info(f"foxglove_bridge: ws{'s' if self._tls else ''}://{host}:{port}")
        rospy.on_shutdown(self._publishing.end)
        self._publishing.run()
        self._server.stop()

    def _warn(self, line: str) -> None:
        """Show a warning here and in all clients: the SDK cannot address one alone."""
        self._log.warn(line)
        self._server.publish_status(line, StatusLevel.Warning)

    def _asset(self, uri: str) -> bytes | None:
        folder_of = rospkg.RosPack().get_path
        return read_asset(uri, self._parameters.asset_uri_allowlist, folder_of)

    def _on_clock(self, message: Clock) -> None:
        self._server.broadcast_time(message.clock.to_nsec())
        buffer = BytesIO()
        message.serialize(buffer)
        self._topics.pass_on(CLOCK, buffer.getvalue())

    def _watch(self) -> None:
        period_s = min(self._parameters.max_update_ms / 1000, LONGEST_LOOK_S)
        while not is_ending():
            time.sleep(period_s)
            answer, pid = _ask("getPid")
            if answer is Answer.REFUSED or pid not in (None, self._master_pid):
                self.has_lost_master = True
                rospy.signal_shutdown("the master has gone")
                return
            self._look()
            changes = self._values.changes()
            if changes:
                self._server.publish_parameter_values(as_parameters(changes))

    def _look(self) -> None:
        """Ask the master what there is, and show it."""
        (answer, state), (typed, types) = _ask("getSystemState"), _ask("getTopicTypes")
        if {answer, typed} != {Answer.WELL}:
            return
        allowed, own = self._parameters, rospy.get_name()
        published, subscribed, services = state
        topics = {topic for topic, _ in published}
        topics |= {topic for topic, nodes in subscribed if set(nodes) - {own}}
        topics = {topic for topic in topics if is_allowed(topic, allowed.topic_whitelist)}
        self._topics.show({topic: kind for topic, kind in types if topic in topics and kind != "*"})
        if self._services:
            names = {name for name, _ in services if is_allowed(name, allowed.service_whitelist)}
            self._services.show(names)
        if self._has_graph and state != self._state:
            self._server.publish_connection_graph(_graph_of(state))
        self._state = state


class _Listener:
    """Takes the calls of the SDK, in its threads."""

    def __init__(
        self, topics: TopicChannels, publishing: ClientTopics, values: MasterParameters,
        warn: Callable[[str], object],
    ) -> None:  # fmt: skip
        self._values, self._warn = values, warn
        self.on_subscribe, self.on_unsubscribe = topics.on_subscribe, topics.on_unsubscribe
        self.on_client_advertise = publishing.on_client_advertise
        self.on_client_unadvertise = publishing.on_client_unadvertise
        self.on_message_data = publishing.on_message_data
        self.on_parameters_subscribe = values.watch
        self.on_parameters_unsubscribe = values.unwatch

    def on_get_parameters(
        self, _client: Any, names: list[str], request_id: str | None = None
    ) -> list[foxglove.Parameter]:
        return as_parameters(self._values.read(names))

    def on_set_parameters(
        self, _client: Any, parameters: list[foxglove.Parameter], request_id: str | None = None
    ) -> list[foxglove.Parameter]:
        refused = self._values.write(parameters)
        if refused:
            self._warn(f"param_whitelist does not have {', '.join(refused)}")
        return as_parameters(self._values.read([parameter.name for parameter in parameters]))

    def on_connection_graph_subscribe(self) -> None:
        """Leave it to the SDK, which sends the last graph."""

    on_connection_graph_unsubscribe = on_connection_graph_subscribe


def _ask(method: str) -> tuple[Answer, Any]:
    return call(rosgraph.get_master_uri(), method, caller=rospy.get_name())


def _graph_of(state: Any) -> foxglove.ConnectionGraph:
    graph = foxglove.ConnectionGraph()
    setters = graph.set_published_topic, graph.set_subscribed_topic, graph.set_advertised_service
    for add, column in zip(setters, state):
        for name, nodes in column:
            add(name, nodes)
    return graph
