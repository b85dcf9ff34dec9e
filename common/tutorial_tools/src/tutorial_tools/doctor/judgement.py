"""What the facts mean when nothing moves: a list of findings."""

from __future__ import annotations

import errno
from collections.abc import Iterator

from gamepad.driver.device_choice import explain
from node_kit.rules.answer import Answer
from tutorial_tools.doctor.connections import types, unconnected
from tutorial_tools.doctor.drive_chain import muxes, needs_driver, rivals, states, topics
from tutorial_tools.doctor.facts import (
    DEAD,
    JOY,
    Facts,
    Finding,
    Stray,
    ok,
    some,
    unknown,
    wrong,
)
from tutorial_tools.doctor.kobuki import kobukis
from tutorial_tools.doctor.transforms import transforms
from tutorial_tools.doctor.unmatched_topics import is_empty, unmatched_topics

# Clocks may differ by this much [s]: transforms that are a tenth of a second old do no harm, nor
# are joystick messages of this age refused.
CLOCK_TOLERANCE_S = 0.1
RESTART = "and restart its nodes"


def judge(facts: Facts) -> list[Finding]:
    """Return all findings, in the order in which a person would look for the cause."""
    findings = [*environment(facts), *overlay(facts), *master(facts), *address(facts)]
    findings += strays(facts)
    if facts.master is Answer.WELL:
        findings += [*nodes(facts), *clocks(facts), *types(facts), *topics(facts)]
        findings += [*unconnected(facts), *unmatched_topics(facts), *muxes(facts)]
        findings += [*rivals(facts), *states(facts), *transforms(facts)]
    return [*findings, *joysticks(facts), *kobukis(facts)]


def environment(facts: Facts) -> Iterator[Finding]:
    """Judge whether this terminal or the workspace keeps ROS 1 from starting."""
    yield from (wrong("environment", seen, todo) for seen, todo in facts.environment)
    if not facts.environment:
        yield ok("environment", "Python, em and the workspace are those of ROS 1 alone")


def overlay(facts: Facts) -> Iterator[Finding]:
    """Judge which joy2twist would run."""
    path, workspace = facts.joy2twist, facts.workspace
    for broken, why in facts.broken_manifests:
        todo = "fix that line or the one before; until then no ROS program starts"
        yield wrong("overlay", f"{broken}: {why}", todo)
    if facts.broken_manifests:
        return
    for seen, todo in facts.hidden:
        yield wrong("overlay", seen, todo)
    if not workspace and path:
        yield ok("overlay", f"joy2twist is the suite's: {path}")
    elif not workspace:
        todo = "call this through ./tutorial, or source devel/setup.bash of a workspace that has it"
        yield unknown("overlay", "no joy2twist is found here", todo)
    elif not path:
        todo = f"make it in {workspace}/src, then catkin_make in {workspace}"
        yield unknown("overlay", "your workspace has no joy2twist yet", todo)
    elif path.startswith(f"{workspace}/src/"):
        yield ok("overlay", f"joy2twist is yours: {path}")
    else:
        todo = f"mv it into {workspace}/src, then catkin_make"
        yield wrong("overlay", f"joy2twist is not in your workspace: {path}", todo)


def master(facts: Facts) -> Iterator[Finding]:
    """Judge whether a master answers at ROS_MASTER_URI."""
    host = facts.master_host
    start = "start roscore" if facts.master_here else f"start roscore, or minimal.launch, on {host}"
    other = "export ROS_MASTER_URI=http://HOST:11311, with the machine on which roscore runs"
    todo = {
        Answer.MALFORMED: other,
        Answer.UNKNOWN_NAME: f'write the address of "{host}" instead, or add it to /etc/hosts',
        Answer.REFUSED: f"{start}; or {other}",
        Answer.SILENT: f"try: ping {host}; look at cable, Wi-Fi and firewall",
        Answer.STRANGE: f"end that program, or {other}",
    }
    if facts.master is Answer.WELL:
        yield ok("master", f"{facts.master_uri} answers")
    else:
        seen = f"ROS_MASTER_URI={facts.master_uri} {facts.master.value}"
        yield wrong("master", seen, todo[facts.master])


def address(facts: Facts) -> Iterator[Finding]:
    """Judge whether the name under which this machine's nodes register leads back to them."""
    name = facts.own_name
    said = f"{facts.own_variable}={name}" if facts.own_variable else f'the name "{name}"'
    todo = f"unset ROS_IP ROS_HOSTNAME, or export ROS_IP=127.0.0.1, {RESTART}"
    if facts.way_out:
        todo = f"export ROS_IP={facts.way_out} in every terminal of this machine {RESTART}"
    loopback = all(a.startswith("127.") or a == "::1" for a in facts.own_addresses)
    if not facts.own_addresses:
        yield wrong("address", f"{said} of this machine cannot be looked up", todo)
    elif not facts.own_is_here:
        where = ", ".join(facts.own_addresses)
        shown = said if where == name else f"{said} ({where})"
        yield wrong("address", f"{shown} is no address of this machine", todo)
    elif facts.called_back:
        yield ok("address", f'the master reaches this machine as "{name}"')
    elif not facts.master_here and loopback and facts.own_variable:
        yield wrong("address", f"{said} is seen by this machine only", todo)
    elif facts.called_back is None:
        yield ok("address", f'nodes of this machine call it "{name}"')
    else:
        todo += "; or open this machine's firewall for it"
        if facts.wsl:
            todo = "Windows hides WSL behind its own address: networkingMode=mirrored below [wsl2]"
            todo += " in .wslconfig of your Windows home, then wsl --shutdown"
        yield wrong("address", f'the master does not reach "{name}"', todo)


def nodes(facts: Facts) -> Iterator[Finding]:
    """Judge whether every registered node can be reached from here."""
    alone = facts.master_here and all(node.here is not False for node in facts.nodes.values())
    export = f"on its machine export ROS_IP {RESTART}"
    bad = {name: node for name, node in facts.nodes.items() if node.answer is not Answer.WELL}
    for name, node in sorted(facts.nodes.items()):
        at = f"{name} at {node.uri}"
        local = node.host == "localhost" or node.host.startswith("127.")
        if local and not alone:
            # From another machine, this address leads to another program.
            bad[name] = node
            yield wrong("nodes", f"{at} can be reached from its own machine only", export)
        elif node.answer is Answer.UNKNOWN_NAME:
            todo = f'add "{node.host}" to /etc/hosts, or {export}'
            yield wrong("nodes", f'{at}: "{node.host}" cannot be looked up here', todo)
        elif node.answer in DEAD:
            todo = "restart it, or forget it with: rosnode cleanup"
            todo += f"; if it runs on another machine, {export}" if local else ""
            yield wrong("nodes", f"{at} is registered, but has died", todo)
        elif node.answer is not Answer.WELL:
            todo = f"it hangs, or a network is down: try ping {node.host}; look at its firewall"
            yield wrong("nodes", f"{at} {node.answer.value}", todo)
    if not bad and not lost_nodes(facts):
        yield ok("nodes", f"all {len(facts.nodes)} answer")


def strays(facts: Facts) -> Iterator[Finding]:
    """Judge whether the nodes on this machine are registered with this master."""
    lost = some(f"{stray.name} (process {stray.pid})" for stray in lost_nodes(facts))
    if lost:
        gone = "unknown to the master, which was restarted meanwhile"
        if facts.master is not Answer.WELL:
            gone = "of a master that has exited"
        yield wrong("nodes", f"running here, but {gone}: {lost}", "restart them, after roscore")
    for uri in sorted({stray.master_uri for stray in facts.strays if stray.master_uri}):
        names = some(stray.name for stray in facts.strays if stray.master_uri == uri)
        todo = f"to join them: export ROS_MASTER_URI={uri} here, or restart them with this one"
        yield unknown("nodes", f"running here, with the master {uri}: {names}", todo)


def lost_nodes(facts: Facts) -> list[Stray]:
    """Return the nodes that use this master, which does not know them."""
    return [stray for stray in facts.strays if not stray.master_uri]


def clocks(facts: Facts) -> Iterator[Finding]:
    """Judge whether the other machines' clocks agree with ours, or whether simulated time runs."""
    if facts.use_sim_time:
        yield ok("clocks", "/use_sim_time: all follow /clock")
        if not facts.clock_ticks:
            todo = "rosparam delete /use_sim_time and restart the nodes, or start what sends /clock"
            yield wrong("clocks", "/use_sim_time is true, and no /clock arrives", todo)
        return
    if not facts.clocks:
        yield ok("clocks", "every node runs on this machine")
    for host, offset in sorted(facts.clocks.items()):
        if offset is None:
            todo = f"compare: date +%s.%N; ssh {host} date +%s.%N"
            yield unknown("clocks", f"{host} sends no stamped message", todo)
        elif abs(offset.seconds) <= CLOCK_TOLERANCE_S:
            yield ok("clocks", f"{host} is within {CLOCK_TOLERANCE_S:g} s, by {offset.topic}")
        else:
            ahead = "ahead of" if offset.seconds > 0 else "behind"
            seen = f"{host} is {abs(offset.seconds):.1f} s {ahead} us, by {offset.topic}"
            todo = "on both machines: sudo apt install chrony (a recording has old stamps, though)"
            yield wrong("clocks", seen, todo)


def joysticks(facts: Facts) -> Iterator[Finding]:
    """Judge whether the gamepads of this machine can be read."""
    joys = facts.topics(JOY)
    senders = {name for joy in joys for name in facts.living(joy, JOY)}
    for path, error in facts.joysticks:
        if error is None:
            yield ok("joystick", f"{path} can be read")
        else:
            seen = explain(path, error, facts.container, facts.wsl)
            yield wrong("joystick", seen.rstrip("."))
    if not facts.joysticks and senders:
        seen = f"none at /dev/input/js*; joystick messages come from {some(senders)}"
        yield ok("joystick", seen)
    elif not facts.joysticks and (joys or needs_driver(facts) or is_empty(facts)):
        seen = explain("/dev/input/js0", errno.ENOENT, facts.container, facts.wsl)
        yield unknown("joystick", seen.rstrip("."))
