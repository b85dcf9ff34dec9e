"""Examine this machine, the master and the nodes, and return Facts."""

from __future__ import annotations

import contextlib
import glob
import io
import os
import stat
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import rosgraph
import rospkg
from diagnostic_msgs.msg import DiagnosticStatus
from std_msgs.msg import String

from gamepad.driver.report import SILENT_FOR
from kobuki_driver.choice import USUAL_PORT
from kobuki_driver.link.sample import Sample
from node_kit.io.machine import in_container, in_wsl
from node_kit.manifests import broken_manifests
from node_kit.message_types import message_class
from node_kit.ros.graph.ros_api import TIMEOUT_S, way_out
from node_kit.rules.answer import Answer
from tutorial_tools.doctor import requests
from tutorial_tools.doctor.connections import cuts
from tutorial_tools.doctor.facts import Facts, Joystick, Mux, MuxInput, Node
from tutorial_tools.hidden_stand_ins import hidden_stand_ins
from tutorial_tools.io.environment import environment
from tutorial_tools.paths import REPOSITORY, SHARE
from tutorial_tools.ros.doctor import network, processes
from tutorial_tools.ros.doctor.messages import (
    Messages,
    base,
    decode,
    nearest,
    offset,
    statuses,
    transforms_in,
)  # fmt: skip
from tutorial_tools.ros.doctor.network import addresses, call, is_here

CONNECT_S = 2.0  # Nodes that have just started take this long to connect.
LISTEN_S = 2.5  # /diagnostics comes once a second


def collect() -> Facts:
    """Return the Facts within about 15 s, even if the network is broken."""
    uri = rosgraph.get_master_uri()
    facts = {"master_uri": uri, "called_back": None, **this_machine()}
    try:
        host, _ = rosgraph.network.parse_http_host_and_port(uri)
    except ValueError:
        host = ""
    if not host or not uri.startswith("http://"):
        return Facts(**facts, master=Answer.MALFORMED)
    known_addresses = addresses(host)
    facts.update(master_host=host, master_here=all(map(is_here, known_addresses)))
    if not known_addresses:
        return Facts(**facts, master=Answer.UNKNOWN_NAME)
    if not facts["master_here"]:
        facts["way_out"] = way_out(known_addresses[0])
    facts["master"], _ = call(uri, "getPid")
    if facts["master"] not in (Answer.WELL, Answer.REFUSED):
        return Facts(**facts)  # Each further call would wait for its timeout.
    nodes = processes.running()
    if facts["master"] is Answer.WELL:
        if facts["own_is_here"]:
            facts["called_back"] = network.is_called_back(uri, facts["own_name"])
        facts.update(graph(uri, facts["joysticks"]))
    known = {node.uri for node in facts.get("nodes", {}).values()}
    return Facts(**facts, strays=processes.strays(nodes, uri, known))


def this_machine() -> dict[str, Any]:
    """Return what needs no network."""
    set_variables = [name for name in ("ROS_HOSTNAME", "ROS_IP") if os.environ.get(name)]
    with contextlib.redirect_stderr(io.StringIO()):  # it warns of an empty variable
        own_name = rosgraph.network.get_host_name()
    own_addresses = addresses(own_name)
    folders = os.environ.get("ROS_PACKAGE_PATH", "").split(":")
    own = [folder for folder in folders if folder and not folder.startswith(("/usr/", "/opt/"))]
    joy2twist, workspace = "", os.environ.get("TUTORIAL_IN", "")
    with contextlib.suppress(Exception):  # not found, or a package.xml is broken
        joy2twist = os.path.realpath(rospkg.RosPack().get_path("joy2twist"))
    return {
        "own_variable": set_variables[0] if set_variables else "",
        "own_name": own_name,
        "own_addresses": own_addresses,
        "own_is_here": bool(own_addresses) and all(map(is_here, own_addresses)),
        "joysticks": [joystick(path) for path in sorted(glob.glob("/dev/input/js*"))],
        "kobukis": kobukis(),
        "workspace": workspace,
        "hidden": hidden_stand_ins(Path(workspace), REPOSITORY, SHARE) if workspace else [],
        "broken_manifests": [broken for folder in own for broken in broken_manifests(folder)],
        "joy2twist": joy2twist,
        "container": in_container(),
        "environment": environment(workspace),
        "wsl": in_wsl(),
    }


def kobukis() -> list[Sample]:
    """Return what the ports of real robots show."""
    try:
        from kobuki_driver.io.port_samples import samples  # noqa: PLC0415 (needs python3-serial)
    except ImportError:
        missing = "python3-serial is not installed: sudo apt install python3-serial"
        return [Sample(USUAL_PORT, missing)] if os.path.exists(USUAL_PORT) else []
    return samples()


def joystick(path: str) -> Joystick:
    """Return whether a device can be opened."""
    try:
        # Not a FIFO of virtual_joystick: opening it would take it from its only reader.
        if not stat.S_ISFIFO(os.stat(path).st_mode):
            os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))
    except OSError as error:
        return Joystick(path, error.errno)
    return Joystick(path)


def graph(uri: str, joysticks: list[Joystick]) -> dict[str, Any]:
    """Return what the master and the nodes answer, as fields of Facts; add their joysticks."""
    publishers, subscribers, services = call(uri, "getSystemState")[1] or ([], [], [])
    state = [*publishers, *subscribers, *services]
    names = {name for _, users in state for name in users if name != network.CALLER}
    seen = network.at_once(lambda name: look_at(uri, name), names, 2 * TIMEOUT_S + 1)
    late = {name: Node("?", "?", Answer.SILENT, None) for name in names - set(seen)}
    facts: dict[str, Any] = {
        "publishers": dict(publishers),
        "subscribers": dict(subscribers),
        "types": dict(call(uri, "getTopicTypes")[1] or []),
        "nodes": {**{name: node for name, node in seen.items() if node}, **late},
    }
    facts.update(settled(uri, Facts(**facts)))
    known = Facts(**facts)
    devices = [
        parameter(uri, f"{node}/dev")
        for node in requests.joystick_nodes(known)
        if known.nodes[node].here
    ]
    there = {joystick.path for joystick in joysticks}
    paths = {device for device in devices if isinstance(device, str)}
    joysticks += [joystick(path) for path in sorted(paths - there)]
    return {**facts, "use_sim_time": parameter(uri, "/use_sim_time") is True, **heard(uri, known)}


def settled(uri: str, facts: Facts) -> dict[str, Any]:
    """Wait for new nodes to connect; return the nodes and the definitions, as fields of Facts."""
    end = time.monotonic() + CONNECT_S
    while cuts(facts) and time.monotonic() < end:
        time.sleep(0.2)
        names = {name for cut in cuts(facts) for name in (cut.sender, cut.receiver)}
        seen = network.at_once(lambda name: look_at(uri, name), names, 2 * TIMEOUT_S + 1)
        rest = {name: node for name, node in facts.nodes.items() if name not in names}
        now = {name: node for name, node in seen.items() if node}  # the others have exited
        facts = replace(facts, nodes={**rest, **now})
    definitions = {}
    for topic, sender, _ in cuts(facts):
        about = network.header(facts.nodes[sender].uri, topic)
        own = getattr(message_class(about.get("type", "")), "_md5sum", "")
        definitions[topic, sender] = (about.get("md5sum", ""), own)
    return {"nodes": facts.nodes, "definitions": definitions}


def look_at(uri: str, name: str) -> Node | None:
    """Return the Node of a name, or None if it has just exited."""
    answer, node_uri = call(uri, "lookupNode", name)
    if answer is not Answer.WELL:
        return None
    try:
        host, _ = rosgraph.network.parse_http_host_and_port(node_uri)
    except ValueError:
        return Node(node_uri, "?", Answer.STRANGE, None)
    known_addresses = addresses(host)
    if not known_addresses:
        return Node(node_uri, host, Answer.UNKNOWN_NAME, None)
    answer, links = call(node_uri, "getBusInfo")  # id, peer, direction, transport, topic
    # Only outgoing links: rospy lists incoming ones before they are connected.
    ends = [(link[4], link[1]) for link in links or [] if link[2] != "i"]
    columns = ("getPublications", "getSubscriptions") if answer is Answer.WELL else ()
    sends, takes = [dict(call(node_uri, column)[1] or []) for column in columns] or ({}, {})
    return Node(node_uri, host, answer, all(map(is_here, known_addresses)), ends, sends, takes)


def parameter(uri: str, name: str) -> Any:
    """Return the value of a parameter, or None."""
    return call(uri, "getParam", name)[1]


def heard(uri: str, facts: Facts) -> dict[str, Any]:
    """Return what arrives on topics, as fields of Facts."""
    came = network.at_once(
        lambda request: network.listen(
            facts.nodes[request.node].uri, request.topic, LISTEN_S, request.most
        ),
        requests.of_graph(facts),
        LISTEN_S + TIMEOUT_S,
    )
    of = {(request.node, request.topic): messages for request, messages in came.items()}
    on = {topic: messages for (_, topic), messages in of.items()}
    said = {
        name: statuses(of.get((name, requests.DIAGNOSTICS), []))
        for name in requests.reporters(facts)
    }
    active = requests.active_topics(facts)
    names = [topic[: -len("/active")] for topic in active if facts.publishers.get(topic)]
    return {
        "clock_ticks": bool(on.get(requests.CLOCK)),
        "clocks": {
            host: nearest([offset(topic, of.get((name, topic), [])) for name, topic, _ in needed])
            for host, needed in requests.for_clocks(facts).items()
        },
        "transforms": transforms_in(of),
        "muxes": {name: mux(uri, name, on.get(f"{name}/active", [])) for name in names},
        "states": {
            name: (status.level == DiagnosticStatus.OK, status.message)
            for name in facts.converters()
            for status in said[name]
            if status.name == f"{name.strip('/')}: joystick"
        },
        "bases": dict(
            filter(None, (base(name, said[name]) for name in requests.kobuki_nodes(facts)))
        ),
        "bridge": [
            (status.level == DiagnosticStatus.OK, status.message)
            for status in said.get(requests.BRIDGE, [])
        ],
        "silent_s": {
            name: float(pair.value)
            for name in requests.joystick_nodes(facts)
            for status in said[name]
            for pair in status.values
            if pair.key == SILENT_FOR and pair.value.replace(".", "", 1).isdigit()
        },
    }


def mux(uri: str, name: str, messages: Messages) -> Mux:
    """Return a Mux from its latched topic and, if the server has them, its parameters."""
    said = [decode(String, data) for _, data in messages]
    inputs = []
    with contextlib.suppress(TypeError, KeyError):  # a multiplexer of another kind
        for entry in parameter(uri, f"{name}/subscribers") or []:
            topic = f"{name}/{entry['topic']}"
            inputs.append(MuxInput(entry["name"], topic, entry["priority"]))
    return Mux(said[0].data if said and said[0] else None, inputs)
