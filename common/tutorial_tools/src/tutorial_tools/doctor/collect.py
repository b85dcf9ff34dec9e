"""Looks at this machine, the master and the nodes: all that Facts holds."""

import contextlib
import glob
import io
import os
import stat
import struct

import rosgraph
import rospkg
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from genpy import DeserializationError
from std_msgs.msg import String

from gamepad.driver.container import in_container
from gamepad.driver.report import SILENT_FOR
from node_kit.manifests import broken_manifests
from tutorial_tools.doctor.facts import JOY, Answer, Facts, Joystick, Mux, MuxInput, Node, Offset
from tutorial_tools.doctor.network import (
    CALLER,
    TIMEOUT_S,
    addresses,
    at_once,
    call,
    is_called_back,
    is_here,
    listen,
    way_out,
)

# Where the stamp (two uint32: s, ns) stands in messages that come often. They begin with a Header,
# whose first field is a sequence number; a TFMessage has the length of its array before.
STAMPS = {
    "diagnostic_msgs/DiagnosticArray": 4,
    "nav_msgs/Odometry": 4,
    "sensor_msgs/Imu": 4,
    "sensor_msgs/JointState": 4,
    JOY: 4,
    "sensor_msgs/LaserScan": 4,
    "tf2_msgs/TFMessage": 8,
}
STAMPED_TOPICS = 6  # of each host
STAMPED_MESSAGES = 20  # of each topic: the one that was fastest on its way counts
LISTEN_S = 2.5  # /diagnostics comes once a second


def collect():
    """The Facts, within some 15 s whatever the network does."""
    uri = rosgraph.get_master_uri()
    facts = {"master_uri": uri, **this_machine()}
    try:
        host, _ = rosgraph.network.parse_http_host_and_port(uri)
        well_formed = uri.startswith("http://")
    except ValueError:
        well_formed = False
    if not well_formed:
        return Facts(**facts, master=Answer.MALFORMED, called_back=None)
    found = addresses(host)
    facts["master_host"] = host
    facts["master_here"] = all(map(is_here, found))
    if not found:
        return Facts(**facts, master=Answer.UNKNOWN_NAME, called_back=None)
    if not facts["master_here"]:
        facts["way_out"] = way_out(found[0])
    facts["master"], _ = call(uri, "getPid")
    called_back = None
    if facts["master"] is Answer.WELL:
        if facts["own_is_here"]:
            called_back = is_called_back(uri, facts["own_name"])
        facts.update(graph(uri, facts["joysticks"]))
    return Facts(**facts, called_back=called_back)


def this_machine():
    """What can be seen without a network."""
    set_variables = [name for name in ("ROS_HOSTNAME", "ROS_IP") if os.environ.get(name)]
    with contextlib.redirect_stderr(io.StringIO()):  # it comments on a variable that is empty
        own_name = rosgraph.network.get_host_name()
    own_addresses = addresses(own_name)
    return {
        "own_variable": set_variables[0] if set_variables else "",
        "own_name": own_name,
        "own_addresses": own_addresses,
        "own_is_here": bool(own_addresses) and all(map(is_here, own_addresses)),
        "joysticks": [joystick(path) for path in sorted(glob.glob("/dev/input/js*"))],
        "workspace": os.environ.get("TUTORIAL_IN", ""),
        "broken_manifests": broken_in_own_folders(),
        "joy2twist": folder_of("joy2twist"),
        "container": in_container(),
        "wsl": "microsoft" in os.uname().release.lower(),
    }


def broken_in_own_folders():
    """[(path, what is wrong)] of what broken_manifests() finds in the user's own workspaces."""
    folders = os.environ.get("ROS_PACKAGE_PATH", "").split(":")
    own = [each for each in folders if each and not each.startswith(("/usr/", "/opt/"))]
    return [broken for folder in own for broken in broken_manifests(folder)]


def folder_of(package):
    """Where a package lies, links followed; "" if it is not found."""
    try:
        return os.path.realpath(rospkg.RosPack().get_path(package))
    except Exception:  # not found, or whatever a broken package.xml brings about
        return ""


def joystick(path):
    """Whether a device can be opened."""
    try:
        # Not a FIFO: virtual_joystick has one reader, and to open it is to read it.
        if not stat.S_ISFIFO(os.stat(path).st_mode):
            os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))
    except OSError as error:
        return Joystick(path, error.errno)
    return Joystick(path)


def graph(uri, joysticks):
    """Return what the master and the nodes answer, by the names of Facts."""
    _, state = call(uri, "getSystemState")
    _, types = call(uri, "getTopicTypes")
    facts = {
        "publishers": others(state[0] if state else []),
        "subscribers": others(state[1] if state else []),
        "types": dict(types or []),
    }
    names = {name for column in state or [] for _, users in column for name in users}
    names = {name for name in names if name != CALLER}
    seen = at_once(lambda name: look_at(uri, name), names, 2 * TIMEOUT_S + 1)
    facts["nodes"] = {name: node for name, node in seen.items() if node}
    for name in names - set(seen):
        facts["nodes"][name] = Node("?", "?", Answer.SILENT, None)
    known = Facts(**facts)
    senders = {name for joy in known.topics(JOY) for name in known.publishers.get(joy, [])}
    here = [name for name, node in known.nodes.items() if name in senders and node.here]
    devices = [parameter(uri, f"{node}/dev") for node in here]
    paths = {device for device in devices if isinstance(device, str)}
    there = {joystick.path for joystick in joysticks}
    joysticks += [joystick(path) for path in sorted(paths - there)]
    return {**facts, "use_sim_time": parameter(uri, "/use_sim_time") is True, **heard(uri, known)}


def others(column):
    """{topic: nodes} without this program."""
    return {
        topic: [name for name in users if name != CALLER]
        for topic, users in column
        if not topic.startswith(CALLER)
    }


def look_at(uri, name):
    """The Node of a name, or None if it has just left."""
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
    here = all(map(is_here, found))
    answer, links = call(node_uri, "getBusInfo")
    return Node(node_uri, host, answer, here, [connection(link) for link in links or []])


def connection(link):
    """(topic, whether it comes in) of an entry of getBusInfo: id, peer, direction, way, topic."""
    return link[4], link[2] == "i"


def parameter(uri, name):
    """The value of a parameter, or None."""
    return call(uri, "getParam", name)[1]


def heard(uri, facts):
    """What comes over the topics: clocks, simulated time, multiplexers, states."""
    muxes = [
        topic[: -len("/active")]
        for topic in facts.topics(String._type)
        if topic.endswith("/active") and facts.publishers.get(topic)
    ]
    hosts = {}
    for node in facts.nodes.values():
        if node.here is False and node.answer is Answer.WELL:
            hosts.setdefault(node.host, stamped(facts, node.host))
    jobs = {("mux", name): (f"{name}/active", 1) for name in muxes}
    jobs.update({("state", name): ("/diagnostics", 1) for name in facts.converters()})
    drivers = {name for joy in facts.topics(JOY) for name in facts.senders(joy)}
    jobs.update({("state", name): ("/diagnostics", 1) for name in drivers})
    jobs["clock", ""] = ("/clock", 1)
    for host, names in hosts.items():
        jobs.update({("stamp", (host, topic)): (topic, STAMPED_MESSAGES) for topic in names})

    def hear(job):
        topic, most = jobs[job]
        kind, about = job
        senders = [about] if kind == "state" else facts.publishers.get(topic, [])
        if kind == "stamp":
            senders = [name for name in senders if facts.nodes[name].host == about[0]]
        for sender in senders[:1]:
            if sender in facts.nodes and facts.nodes[sender].answer is Answer.WELL:
                return listen(facts.nodes[sender].uri, topic, LISTEN_S, most)
        return []

    came = at_once(hear, jobs, LISTEN_S + TIMEOUT_S)
    return {
        "clock_ticks": bool(came.get(("clock", ""))),
        "clocks": {
            host: nearest(
                [
                    Offset(seconds, topic)
                    for topic in names
                    for seconds in offsets(facts.types[topic], came.get(("stamp", (host, topic))))
                ]
            )
            for host, names in hosts.items()
        },
        "muxes": {name: mux(uri, name, came.get(("mux", name))) for name in muxes},
        "states": dict(
            said for name in facts.converters() for said in states(name, came.get(("state", name)))
        ),
        "silent_s": {
            name: seconds for name in drivers for seconds in silences(came.get(("state", name)))
        },
    }


def stamped(facts, host):
    """Topics with stamps that come from a host."""
    return [
        topic
        for kind in STAMPS
        for topic in facts.topics(kind)
        if any(
            name in facts.nodes and facts.nodes[name].host == host
            for name in facts.publishers.get(topic, [])
        )
    ][:STAMPED_TOPICS]


def offsets(kind, messages):
    """How much the stamps are ahead of their arrival [s]: of the fastest on its way, or none."""
    ahead = []
    for arrived_s, data in messages or []:
        if len(data) >= STAMPS[kind] + 8:
            seconds, nanoseconds = struct.unpack_from("<II", data, STAMPS[kind])
            ahead.append(seconds + nanoseconds * 1e-9 - arrived_s)
    return [max(ahead)] if ahead else []


def nearest(offsets_):
    """The Offset that is nearest to none: a replayed recording beside it has old stamps."""
    return min(offsets_, key=lambda offset: abs(offset.seconds), default=None)


def mux(uri, name, messages):
    """A Mux, by its latched topic and, where they are on the server, its parameters."""
    said = [decode(String, data) for _, data in messages or []]
    inputs = []
    with contextlib.suppress(TypeError, KeyError):  # a multiplexer of another kind
        for entry in parameter(uri, f"{name}/subscribers") or []:
            topic = f"{name}/{entry['topic']}"
            inputs.append(MuxInput(entry["name"], topic, entry["priority"]))
    return Mux(said[0].data if said and said[0] else None, inputs)


def states(node, messages):
    """[(node, (whether it is well, what it says))] from its message on /diagnostics."""
    for _, data in messages or []:
        for status in (decode(DiagnosticArray, data) or DiagnosticArray()).status:
            if status.name == f"{node.strip('/')}: joystick":
                yield node, (status.level == DiagnosticStatus.OK, status.message)


def silences(messages):
    """For how long the gamepad of a joy_node has been silent [s], from its /diagnostics."""
    for _, data in messages or []:
        for status in (decode(DiagnosticArray, data) or DiagnosticArray()).status:
            for pair in status.values:
                if pair.key == SILENT_FOR and pair.value.replace(".", "", 1).isdigit():
                    yield float(pair.value)


def decode(kind, data):
    """The message, or None if the bytes are none."""
    try:
        return kind().deserialize(data)
    except DeserializationError:
        return None
