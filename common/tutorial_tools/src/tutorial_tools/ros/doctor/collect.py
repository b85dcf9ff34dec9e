"""Looks at this machine, the master and the nodes, and fills in Facts."""

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
from kobuki_msgs.msg import SensorState
from std_msgs.msg import String

from gamepad.driver.container import in_container
from gamepad.driver.report import SILENT_FOR
from kobuki_driver.choice import USUAL_PORT
from kobuki_driver.link.sample import Sample
from node_kit.manifests import broken_manifests
from node_kit.message_types import message_class
from node_kit.ros.graph.ros_api import TIMEOUT_S, way_out
from node_kit.rules.answer import Answer
from tutorial_tools.doctor.facts import JOY, Facts, Joystick, Mux, MuxInput, Node
from tutorial_tools.doctor.links import cuts
from tutorial_tools.doctor.transforms import TOPICS as TRANSFORM_TOPICS
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

# Frequent messages that begin with a Header: sequence number, stamp as two uint32 (s, ns).
STAMPED = (
    "diagnostic_msgs/DiagnosticArray", "nav_msgs/Odometry", "sensor_msgs/JointState", JOY,
    "sensor_msgs/LaserScan",
)  # fmt: skip
STAMPED_TOPICS = 6  # per host
STAMPED_MESSAGES = 20  # per topic; the fastest one counts
BRIDGE = "/ros2_bridge"  # the node of ros2_bridge
CONNECT_S = 2.0  # Nodes that have just started take this long to connect.
LISTEN_S = 2.5  # /diagnostics comes once a second


def collect() -> Facts:
    """Return the Facts within some 15 s, even if the network is broken."""
    uri = rosgraph.get_master_uri()
    facts = {"master_uri": uri, "called_back": None, **this_machine()}
    try:
        host, _ = rosgraph.network.parse_http_host_and_port(uri)
    except ValueError:
        host = ""
    if not host or not uri.startswith("http://"):
        return Facts(**facts, master=Answer.MALFORMED)
    found = addresses(host)
    facts.update(master_host=host, master_here=all(map(is_here, found)))
    if not found:
        return Facts(**facts, master=Answer.UNKNOWN_NAME)
    if not facts["master_here"]:
        facts["way_out"] = way_out(found[0])
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
    """Return what can be seen without a network."""
    set_variables = [name for name in ("ROS_HOSTNAME", "ROS_IP") if os.environ.get(name)]
    with contextlib.redirect_stderr(io.StringIO()):  # it comments on a variable that is empty
        own_name = rosgraph.network.get_host_name()
    own_addresses = addresses(own_name)
    folders = os.environ.get("ROS_PACKAGE_PATH", "").split(":")
    own = [folder for folder in folders if folder and not folder.startswith(("/usr/", "/opt/"))]
    joy2twist, workspace = "", os.environ.get("TUTORIAL_IN", "")
    with contextlib.suppress(Exception):  # not found, or an error of a broken package.xml
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
        "wsl": "microsoft" in os.uname().release.lower(),
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
        # Not a FIFO: virtual_joystick has one reader, and to open it is to read it.
        if not stat.S_ISFIFO(os.stat(path).st_mode):
            os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))
    except OSError as error:
        return Joystick(path, error.errno)
    return Joystick(path)


def graph(uri: str, joysticks: list[Joystick]) -> dict[str, Any]:
    """Return what the master and the nodes answer, by the names of Facts; add their joysticks."""
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
    devices = [parameter(uri, f"{node}/dev") for node in drivers(known) if known.nodes[node].here]
    there = {joystick.path for joystick in joysticks}
    paths = {device for device in devices if isinstance(device, str)}
    joysticks += [joystick(path) for path in sorted(paths - there)]
    return {**facts, "use_sim_time": parameter(uri, "/use_sim_time") is True, **heard(uri, known)}


def settled(uri: str, facts: Facts) -> dict[str, Any]:
    """Return the nodes, once those that have just started are connected, and the definitions."""
    end = time.monotonic() + CONNECT_S
    while cuts(facts) and time.monotonic() < end:
        time.sleep(0.2)  # between two questions
        names = {name for cut in cuts(facts) for name in (cut.sender, cut.receiver)}
        seen = network.at_once(lambda name: look_at(uri, name), names, 2 * TIMEOUT_S + 1)
        rest = {name: node for name, node in facts.nodes.items() if name not in names}
        now = {name: node for name, node in seen.items() if node}  # the others have left
        facts = replace(facts, nodes={**rest, **now})
    definitions = {}
    for topic, sender, _ in cuts(facts):
        about = network.header(facts.nodes[sender].uri, topic)
        own = getattr(message_class(about.get("type", "")), "_md5sum", "")
        definitions[topic, sender] = (about.get("md5sum", ""), own)
    return {"nodes": facts.nodes, "definitions": definitions}


def drivers(facts: Facts) -> set[str]:
    """Return the nodes that publish joysticks."""
    names = {name for joy in facts.topics(JOY) for name in facts.publishers.get(joy, [])}
    return names & set(facts.nodes)


def look_at(uri: str, name: str) -> Node | None:
    """Return the Node of a name, or None if it has just left."""
    answer, node_uri = call(uri, "lookupNode", name)
    if answer is not Answer.WELL:
        return None
    try:
        host, _ = rosgraph.network.parse_http_host_and_port(node_uri)
    except ValueError:
        return Node(node_uri, "?", Answer.STRANGE, None)
    found = addresses(host)
    if not found:
        return Node(node_uri, host, Answer.UNKNOWN_NAME, None)
    answer, links = call(node_uri, "getBusInfo")  # id, peer, direction, transport, topic
    # Those on which it sends: rospy lists what it receives before it is connected.
    ends = [(link[4], link[1]) for link in links or [] if link[2] != "i"]
    columns = ("getPublications", "getSubscriptions") if answer is Answer.WELL else ()
    sends, takes = [dict(call(node_uri, column)[1] or []) for column in columns] or ({}, {})
    return Node(node_uri, host, answer, all(map(is_here, found)), ends, sends, takes)


def parameter(uri: str, name: str) -> Any:
    """Return the value of a parameter, or None."""
    return call(uri, "getParam", name)[1]


def heard(uri: str, facts: Facts) -> dict[str, Any]:
    """Return what arrives on topics: clocks, simulated time, multiplexers, states."""
    active = [topic for topic in facts.topics(String._type) if topic.endswith("/active")]
    far: dict[str, list[tuple[str, str, int]]] = {}  # host: (node, topic, number of messages)
    stamped = [topic for kind in STAMPED for topic in facts.topics(kind)]
    well = {name: node for name, node in facts.nodes.items() if node.answer is Answer.WELL}
    for name, node in well.items():
        if node.here is False:
            sent = [topic for topic in stamped if name in facts.publishers.get(topic, [])]
            far.setdefault(node.host, []).extend((name, t, STAMPED_MESSAGES) for t in sent)
    far = {host: jobs[:STAMPED_TOPICS] for host, jobs in far.items()}
    bases = {name for topic in facts.topics(SensorState._type) for name in facts.senders(topic)}
    speakers = {*facts.converters(), *drivers(facts), *bases, *({BRIDGE} & set(well))}
    jobs = [job for several in far.values() for job in several]
    jobs += [(name, "/diagnostics", 1) for name in speakers]
    for topic in (*active, "/clock"):
        jobs += [(name, topic, 1) for name in facts.publishers.get(topic, [])[:1]]
    for topic in TRANSFORM_TOPICS:
        jobs += [(name, topic, STAMPED_MESSAGES) for name in facts.senders(topic)]
    came = network.at_once(
        lambda job: network.listen(well[job[0]].uri, job[1], LISTEN_S, job[2]),
        [job for job in jobs if job[0] in well],
        LISTEN_S + TIMEOUT_S,
    )
    of = {(name, topic): messages for (name, topic, _), messages in came.items()}
    on = {topic: messages for (_, topic), messages in of.items()}
    said = {name: statuses(of.get((name, "/diagnostics"), [])) for name in speakers}
    names = [topic[: -len("/active")] for topic in active if facts.publishers.get(topic)]
    return {
        "clock_ticks": bool(on.get("/clock")),
        "clocks": {
            host: nearest([offset(topic, of.get((name, topic), [])) for name, topic, _ in several])
            for host, several in far.items()
        },
        "transforms": transforms_in(of),
        "muxes": {name: mux(uri, name, on.get(f"{name}/active", [])) for name in names},
        "states": {
            name: (status.level == DiagnosticStatus.OK, status.message)
            for name in facts.converters()
            for status in said[name]
            if status.name == f"{name.strip('/')}: joystick"
        },
        "bases": dict(filter(None, (base(name, said[name]) for name in bases))),
        "bridge": [
            (status.level == DiagnosticStatus.OK, status.message) for status in said.get(BRIDGE, [])
        ],
        "silent_s": {
            name: float(pair.value)
            for name in drivers(facts)
            for status in said[name]
            for pair in status.values
            if pair.key == SILENT_FOR and pair.value.replace(".", "", 1).isdigit()
        },
    }


def mux(uri: str, name: str, messages: Messages) -> Mux:
    """Return a Mux, by its latched topic and, where they are on the server, its parameters."""
    said = [decode(String, data) for _, data in messages]
    inputs = []
    with contextlib.suppress(TypeError, KeyError):  # a multiplexer of another kind
        for entry in parameter(uri, f"{name}/subscribers") or []:
            topic = f"{name}/{entry['topic']}"
            inputs.append(MuxInput(entry["name"], topic, entry["priority"]))
    return Mux(said[0].data if said and said[0] else None, inputs)
