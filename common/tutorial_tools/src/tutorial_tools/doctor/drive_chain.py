"""Judge the chain from joystick to robot: topics, multiplexers, what joy2twist reports."""

from __future__ import annotations

import re
from collections.abc import Iterator

from node_kit.rules.answer import Answer
from node_kit.rules.arming import DRIVING
from tutorial_tools.doctor.connections import cuts, mismatched
from tutorial_tools.doctor.facts import JOY, TWIST, Facts, Finding, Mux, ok, some, unknown, wrong
from tutorial_tools.doctor.unmatched_topics import is_empty, is_tool, pairs, plays_a_bag

SILENT_S = 2.0  # a gamepad that is held is never still for so long
IDLE = ("", "idle")  # what a multiplexer publishes when no input is active
MISSING = "is missing"  # what the bridge reports about its other side
NO_MESSAGE = re.compile("no message|waiting for the joystick")


def topics(facts: Facts) -> Iterator[Finding]:
    """Judge whether the chain from joystick to robot is connected."""
    converters = facts.converters()
    joys = facts.topics(JOY)
    heard = {joy for inputs, _ in converters.values() for joy in inputs}
    for joy in joys:
        namespace = joy.rsplit("/", 1)[0]
        into = f" __ns:={namespace}" if namespace else ""
        if not facts.publishers.get(joy):
            yield wrong("topics", f"nobody sends {joy}", _joystick(facts, joy, into))
        if joy not in heard and joy not in mismatched(facts) and not facts.driven():
            # A robot with a multiplexer has launch files of its own.
            half = "roslaunch joy2twist joy2twist_turtlebot.launch"
            if namespace or not facts.muxes:
                half = f"rosrun joy2twist joy2twist.py{into}"
            todo = f"start joy2twist ({half})"
            yield wrong("topics", f"nothing turns {joy} into velocities", todo)
    if not joys:
        yield from without_joystick(facts)
    for node, (inputs, outputs) in sorted(converters.items()):
        yield from chain(facts, node, inputs, outputs)


def _joystick(facts: Facts, joy: str, into: str) -> str:
    """Return what to start so that a joystick is published."""
    if bags := plays_a_bag(facts):
        return f"the recording of {some(bags)} does not have it: rosbag info FILE lists what it has"
    todo = f"rosrun joy joy_node{into}, or: rosbag play FILE"
    todo += f" /joy:={joy}" if into else ""
    return f"{todo}; with joystick:=browser, drive on the cockpit's page"


def without_joystick(facts: Facts) -> Iterator[Finding]:
    """Judge whether something drives the robot, if there is no joystick."""
    topics = sorted(facts.used(), key=lambda topic: topic not in facts.driven())
    links = [link for topic in topics for link in _links(facts, topic)]
    if links:
        yield ok("topics", "; ".join(links[:2]) + (f"; {len(links) - 2} more" * (len(links) > 2)))
    idle = {topic: facts.users(topic, TWIST, inwards=True) for topic in undriven(facts)}
    if needs_driver(facts):
        robots = some({name for names in idle.values() for name in names})
        yield wrong("topics", f"nobody drives {robots}, by {some(idle)}", start_all(facts))
    elif is_empty(facts) and not facts.strays:
        others = f" but {some(facts.nodes)}" if facts.nodes else ""
        yield wrong("topics", f"no node runs at this master{others}", start_all(facts))


def needs_driver(facts: Facts) -> bool:
    """Return whether a robot runs, and nothing drives it or was probably meant to."""
    return bool(undriven(facts)) and not facts.driven() and not pairs(facts)


def _links(facts: Facts, topic: str) -> list[str]:
    """Return ["senders -> topic -> receivers"] if these are connected and not just tools."""
    ends = facts.senders(topic), facts.receivers(topic)
    joined = not any(cut.topic == topic for cut in cuts(facts)) and topic not in mismatched(facts)
    if joined and all(names and not all(map(is_tool, names)) for names in ends):
        return [f"{some(ends[0])} -> {topic} -> {some(ends[1])}"]
    return []


def start_all(facts: Facts) -> str:
    """Return the command that starts joystick and joy2twist for the robot that runs."""
    topics = undriven(facts)
    turtles = [t for t in topics if re.fullmatch(r"/turtle\d+/cmd_vel", t)]
    if turtles:
        remap = "" if "/turtle1/cmd_vel" in turtles else f" /turtle1/cmd_vel:={turtles[0]}"
        return f"rosrun turtlesim turtle_teleop_key{remap}"
    robots = [t.split("/")[1] for t in topics if re.fullmatch(r"/\w+/cmd_vel", t)]
    file = "launch_joy_node_realTurtlebot.launch" if facts.muxes else "launch_joy_node.launch"
    if robots:
        file = f"student.launch name:={robots[0]}"
    without = "without a gamepad add joystick:=browser or virtual:=true"
    return f"roslaunch joy2twist {file} ({without})"


def undriven(facts: Facts) -> list[str]:
    """Return the velocity topics that a robot subscribes to and no node publishes."""
    wanted = [t for t in facts.topics(TWIST) if not facts.publishers.get(t)]
    return [t for t in wanted if not all(map(is_tool, facts.users(t, TWIST, inwards=True)))]


def chain(facts: Facts, node: str, inputs: list[str], outputs: list[str]) -> Iterator[Finding]:
    """Judge whether one converter is connected on both sides."""
    lost = [topic for topic in outputs if not facts.subscribers.get(topic)]
    for topic in lost:
        free = undriven(facts)
        # A multiplexer's other inputs are for programs.
        free = [t for t in free if t.endswith("/input/teleop")] or free
        todo = "start the robot" + (f", or drive the one at {some(free, ' or ')}" if free else "")
        yield wrong("topics", f"nobody listens to {topic} of {node}", todo)
    cut = {cut.topic for cut in cuts(facts) if node in cut} | mismatched(facts)
    alive = node not in facts.nodes or facts.nodes[node].answer is Answer.WELL
    sent = all(facts.publishers.get(topic) for topic in inputs)
    if alive and sent and not lost and not cut.intersection([*inputs, *outputs]):
        begins = sorted({name for topic in inputs for name in facts.senders(topic)})
        ends = sorted({name for topic in outputs for name in facts.subscribers[topic]})
        steps = (begins, inputs, [node], outputs, ends)
        yield ok("topics", " -> ".join(", ".join(step) for step in steps))


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
    # A TurtleBot's own multiplexer reads its inputs from a file, which names input/teleop so.
    short = topic.rsplit("/", 1)[1].lower()
    if active in ours or (not ours and mux.active.lower().startswith(short)):
        return ok("mux", f"{name} lets {topic} through")
    if active and ours and active.priority < ours[0].priority:
        return ok("mux", f'{name} lets "{mux.active}" through, until {topic} drives')
    senders = facts.publishers.get(active.topic, []) if active else []
    todo = f"end {', '.join(senders)}" if senders else "end what sends to that"
    return wrong("mux", f'{name} lets "{mux.active}" through, and not {topic}', todo)


def rivals(facts: Facts) -> Iterator[Finding]:
    """Judge whether several nodes drive one robot, or several joysticks drive one joy2twist."""
    for topic, kind in [(t, own) for own in (JOY, TWIST) for t in facts.topics(own)]:
        senders = facts.living(topic, kind)
        if len(senders) > 1 and facts.subscribers.get(topic):
            seen = f"{topic} is sent by {some(senders)} at once"
            yield wrong("topics", seen, "end all of them but one")


def states(facts: Facts) -> Iterator[Finding]:
    """Judge what joy2twist itself reports on /diagnostics."""
    for node, (well, text) in sorted(facts.states.items()):
        joys = facts.converters().get(node, (["joy"], []))[0]
        joy, right = " ".join(joys), not mismatched(facts).intersection(joys)
        todo = f"move the joystick, or start it: rostopic hz {joy} shows its messages"
        todo += "; with joystick:=browser, drive on the cockpit's page"
        todo = todo if NO_MESSAGE.search(text) and right else ""
        seen = f"{node} says: {text}"
        yield ok("state", seen) if well else wrong("state", seen, todo)
    for well, text in facts.bridge:
        if MISSING in text:
            todo = "its terminal says why; ./tutorial ros2 talker tries ROS 2 alone"
            yield wrong("bridge", text, todo)
        else:  # the user may not need these topics
            yield ok("bridge", text) if well else unknown("bridge", text)
    still = any("has not changed" in text for _, text in facts.states.values())
    for node, seconds in sorted(facts.silent_s.items()) if still else ():
        if seconds > SILENT_S:
            seen = f"the gamepad of {node} has been silent for {seconds:.0f} s"
            todo = "look at its battery and its distance, then move a stick"
            yield wrong("joystick", seen, todo)
