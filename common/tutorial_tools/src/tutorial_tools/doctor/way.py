"""Judge the way from joystick to robot: topics, multiplexers, what joy2twist says (pure)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from node_kit.arming import DRIVING
from node_kit.ros_api import Answer
from tutorial_tools.doctor.facts import JOY, TWIST, Facts, Finding, Mux, ok, some, unknown, wrong

SILENT_S = 2.0  # a gamepad in the hand is not still for so long
IDLE = ("", "idle")  # what a multiplexer publishes when no input is active
MISSING = "is missing"  # what the bridge says of its other side
NO_MESSAGE = re.compile("no message|waiting for the joystick")


def topics(facts: Facts) -> Iterator[Finding]:
    """Judge whether the way from joystick to robot is connected from end to end."""
    converters = facts.converters()
    joys = facts.topics(JOY)
    heard = {joy for inputs, _ in converters.values() for joy in inputs}
    if not joys:
        todo = start_all(facts)
        yield wrong("topics", "there is neither a joystick nor joy2twist", todo)
    for joy in joys:
        namespace = joy.rsplit("/", 1)[0]
        into = f" __ns:={namespace}" if namespace else ""
        if not facts.publishers.get(joy):
            todo = f"rosrun joy joy_node{into}, or: rosbag play FILE"
            todo += f" /joy:={joy}" if namespace else ""
            todo += "; with joystick:=browser, drive on the cockpit's page"
            yield wrong("topics", f"nobody sends {joy}", todo)
        if joy not in heard:
            # A robot with a multiplexer has launch files of its own.
            half = "roslaunch joy2twist joy2twist_turtlebot.launch"
            if namespace or not facts.muxes:
                half = f"rosrun joy2twist joy2twist.py{into}"
            todo = f"start joy2twist ({half})"
            yield wrong("topics", f"nothing turns {joy} into velocities", todo)
    for node, (inputs, outputs) in sorted(converters.items()):
        yield from way(facts, node, inputs, outputs)


def start_all(facts: Facts) -> str:
    """Return the launch that starts joystick and joy2twist for the robot that is there."""
    robots = [t.split("/")[1] for t in undriven(facts) if re.fullmatch(r"/\w+/cmd_vel", t)]
    file = "launch_joy_node_realTurtlebot.launch" if facts.muxes else "launch_joy_node.launch"
    if robots:
        file = f"student.launch name:={robots[0]}"
    without = "without a gamepad add joystick:=browser or virtual:=true"
    return f"roslaunch joy2twist {file} ({without})"


def undriven(facts: Facts) -> list[str]:
    """Return the velocity topics that a robot listens to and nobody publishes."""
    return [t for t in facts.topics(TWIST) if not facts.publishers.get(t)]


def way(facts: Facts, node: str, inputs: list[str], outputs: list[str]) -> Iterator[Finding]:
    """Judge whether one converter is connected on both sides."""
    both = [*((topic, True) for topic in inputs), *((topic, False) for topic in outputs)]
    cut = [finding for end in both for finding in link(facts, node, *end)]
    yield from cut
    alive = node not in facts.nodes or facts.nodes[node].answer is Answer.WELL
    if alive and not cut and all(facts.publishers.get(topic) for topic in inputs):
        begins = sorted({name for topic in inputs for name in facts.senders(topic)})
        ends = sorted({name for topic in outputs for name in facts.subscribers[topic]})
        steps = (begins, inputs, [node], outputs, ends)
        yield ok("topics", " -> ".join(", ".join(step) for step in steps))


def link(facts: Facts, node: str, topic: str, inwards: bool) -> Iterator[Finding]:
    """Judge whether a converter is connected to those at the other end of a topic."""
    others = (facts.publishers if inwards else facts.subscribers).get(topic, [])
    if not others and not inwards:
        free = undriven(facts)
        # The other inputs of a multiplexer are not for people.
        free = [t for t in free if t.endswith("/input/teleop")] or free
        todo = "start the robot" + (f", or drive the one at {some(free, ' or ')}" if free else "")
        yield wrong("topics", f"nobody listens to {topic} of {node}", todo)
    known = facts.nodes.get(node)
    if others and known and known.answer is Answer.WELL and (topic, inwards) not in known.links:
        seen = f"{topic}: {', '.join(others)} and {node} know of each other, but are not connected"
        todo = "fix what the lines above say, or a firewall between them"
        yield wrong("topics", seen, todo)


def muxes(facts: Facts) -> Iterator[Finding]:
    """Judge whether a multiplexer lets joy2twist through."""
    ours = {topic for _, sends in facts.converters().values() for topic in sends}
    for name, mux in sorted(facts.muxes.items()):
        for topic in sorted(t for t in ours if t.startswith(f"{name}/")):
            yield mux_finding(facts, name, mux, topic)


def mux_finding(facts: Facts, name: str, mux: Mux, topic: str) -> Finding:
    """Judge whether a multiplexer lets one of our topics through."""
    if mux.active is None:
        todo = f"rostopic echo {name}/active"
        return unknown("mux", f"{name} does not say what is active", todo)
    if mux.active in IDLE:
        senders = facts.publishers.get(topic, [])
        if any(facts.states.get(sender) == (True, DRIVING) for sender in senders):
            todo = "its network was cut meanwhile: release LB and the sticks, wait a second"
            seen = f"{name} does not listen to {topic}, though {', '.join(senders)} drives"
            return wrong("mux", seen, todo)
        return ok("mux", f"{name}: nobody drives at this moment")
    inputs = {i.name: i for i in mux.inputs}
    ours = [i for i in mux.inputs if i.topic == topic]
    active = inputs.get(mux.active)
    # A TurtleBot's own multiplexer keeps its inputs in a file: there Teleoperation is input/teleop.
    short = topic.rsplit("/", 1)[1].lower()
    if active in ours or (not ours and mux.active.lower().startswith(short)):
        return ok("mux", f"{name} lets {topic} through")
    if active and ours and active.priority < ours[0].priority:
        return ok("mux", f'{name} lets "{mux.active}" through, until {topic} drives')
    senders = facts.publishers.get(active.topic, []) if active else []
    todo = f"end {', '.join(senders)}" if senders else "end what sends to that"
    return wrong("mux", f'{name} lets "{mux.active}" through, and not {topic}', todo)


def rivals(facts: Facts) -> Iterator[Finding]:
    """Judge whether several nodes drive one robot, or several joysticks one joy2twist."""
    for topic in [*facts.topics(JOY), *facts.topics(TWIST)]:
        senders = facts.senders(topic)
        if len(senders) > 1 and facts.subscribers.get(topic):
            seen = f"{topic} is sent by {some(senders)} at once"
            yield wrong("topics", seen, "end all of them but one")


def states(facts: Facts) -> Iterator[Finding]:
    """Judge what joy2twist itself reports on /diagnostics."""
    for node, (well, text) in sorted(facts.states.items()):
        joy = " ".join(facts.converters().get(node, (["joy"], []))[0])
        todo = f"move the joystick, or start it: rostopic hz {joy} shows its messages"
        todo += "; with joystick:=browser, drive on the cockpit's page"
        todo = todo if NO_MESSAGE.search(text) else ""
        seen = f"{node} says: {text}"
        yield ok("state", seen) if well else wrong("state", seen, todo)
    for well, text in facts.bridge:
        if MISSING in text:
            todo = "its terminal says why; ./tutorial ros2 talker tries ROS 2 alone"
            yield wrong("bridge", text, todo)
        else:  # the user may not need the topics that are not carried
            yield ok("bridge", text) if well else unknown("bridge", text)
    still = any("has not changed" in text for _, text in facts.states.values())
    for node, seconds in sorted(facts.silent_s.items()) if still else ():
        if seconds > SILENT_S:
            seen = f"the gamepad of {node} has been silent for {seconds:.0f} s"
            todo = "look at its battery and its distance, then move a stick"
            yield wrong("joystick", seen, todo)
