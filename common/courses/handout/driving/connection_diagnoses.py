"""Diagnoses of the topics of a Joy-to-Twist program, and of its start."""

from __future__ import annotations

from tutorial_check import (
    MASTER_GONE,
    CutShort,
    Note,
    Wrong,
    never_calls_back,
    unsubscribed,
    with_import,
    wrong_of,
)

from .joy2twist_node import Joy2TwistNode


def crashed(node: Joy2TwistNode) -> Wrong | None:
    return node.crash() if node.run.has_traceback else None


def hidden_crash(node: Joy2TwistNode) -> Wrong | None:
    return node.hidden_crash


def ended_early(node: Joy2TwistNode) -> Wrong | None:
    return node.end() if node.run.ending.early else None


def uses_the_cpu(node: Joy2TwistNode) -> Wrong | None:
    return node.end() if node.run.program.spins else None


def master_gone(node: Joy2TwistNode) -> Wrong | None:
    return None if node.graph.master_alive else wrong_of(CutShort(MASTER_GONE), node.script)


def another_type_subscribed(node: Joy2TwistNode) -> Wrong | None:
    # The master still knows the topics of a program that has crashed.
    if node.graph.connected or node.run.ending.early:
        return None
    if node.answers.joy not in node.graph.subscribers:
        return None
    call = node.source.first("Subscriber")
    wanted = call.words[1] if call and len(call.words) > 1 else "another type"
    where = node.at_call("Subscriber")
    hint = node.source.idioms.typed_subscriber(node.answers.joy, "Joy")
    hint = with_import(hint, "Joy", node.source)
    return Wrong("", f"it wants {wanted} on {node.names.joy}", where, hint)


def no_callback(node: Joy2TwistNode) -> Wrong | None:
    call, seen = node.source.without_callback, node.run.numbered
    if seen.samples or seen.displayed or not call:
        return None
    where = node.at([call.line])
    return Wrong("", "its Subscriber has no callback", where, node.subscriber, sure=True)


def callback_never_called(node: Joy2TwistNode) -> Wrong | None:
    seen = node.run.numbered
    if not node.graph.connected or node.run.ending.early or seen.samples or seen.displayed:
        return None
    cause = never_calls_back(node.source)
    return Wrong("", cause.seen, node.at([cause.line]), cause.hint, sure=True) if cause else None


CONNECTED = (master_gone, another_type_subscribed, no_callback, callback_never_called)


def publishes_joys_alone(node: Joy2TwistNode) -> Wrong | None:
    if node.answers.joy not in node.graph.publishers:
        return None
    seen = f"it PUBLISHES on {node.names.joy} ({node.graph.types.get(node.answers.joy, '?')})"
    hint = "a Subscriber receives what the joystick sends, a Publisher sends"
    return Wrong("", seen, node.at_call("Subscriber"), hint)


def another_topic_subscribed(node: Joy2TwistNode) -> Wrong | None:
    if not node.joys_elsewhere:
        return None
    is_upper = node.joys_elsewhere.lower() == node.answers.joy
    lower = f"the topic is called {node.answers.joy}, in lower case"
    hint = lower if is_upper else node.subscriber
    where, seen = node.at_call("Subscriber"), f"it subscribes to {node.joys_elsewhere}"
    return node.private("Subscriber", seen) or Wrong("", seen, where, hint)


def subscription_has_ended(node: Joy2TwistNode) -> Wrong | None:
    cause = unsubscribed(node.source)
    if not cause:
        return None
    seen = f"it subscribes to nothing: {cause.seen}"
    return Wrong("", seen, node.at([cause.line]), cause.hint, sure=True)


def nothing_subscribed(node: Joy2TwistNode) -> Wrong:
    idioms = node.source.idioms
    hint = f"{node.subscriber}, after {idioms.init} and before {idioms.spin}"
    return Wrong("", "it subscribes to nothing", node.at_call("Subscriber"), hint)


NOT_CONNECTED = (
    uses_the_cpu, crashed, hidden_crash, ended_early, publishes_joys_alone,
    another_topic_subscribed, subscription_has_ended, nothing_subscribed,
)  # fmt: skip


def publishes_joys(node: Joy2TwistNode) -> Wrong | None:
    publishers = node.graph.publishers.get(node.answers.joy)
    if not publishers:
        return None
    seen = f"it publishes on {node.names.joy} itself ({publishers[0]})"
    hint = f"{node.answers.joy} belongs to the joystick"
    return Wrong("", seen, node.at_call("Publisher"), hint)


def another_type_published(node: Joy2TwistNode) -> Wrong | None:
    if not node.drivers or not node.carried:
        return None
    seen = f"{node.names.cmd_vel} carries {node.carried}"
    return Wrong("", seen, node.at_call("Publisher"), node.publisher)


def several_publish(node: Joy2TwistNode) -> Wrong | None:
    if len(node.drivers) < 2:
        return None
    return Wrong("", f"several do: {', '.join(node.drivers)}", node.at_call("Publisher"))


def publisher_made_in_callback(node: Joy2TwistNode) -> Note | None:
    lines = node.source.called_back.get("Publisher")
    if not node.drivers or not lines:
        return None
    seen = "the Publisher is made in the callback:"
    seen += " what it sends before a subscriber has connected is lost"
    return Note(seen, node.at(lines), "make it once, before the Subscriber")


TOPICS = (publishes_joys, another_type_published, several_publish, publisher_made_in_callback)


def crashed_with_publisher(node: Joy2TwistNode) -> Wrong | None:
    return crashed(node) if node.source.first("Publisher") else None


def publisher_ends_with_callback(node: Joy2TwistNode) -> Wrong | None:
    lines = node.source.called_back.get("Publisher")
    if node.source.is_python or not lines:
        return None
    seen = "the Publisher is made in the callback, and ends with it before a Twist is sent"
    hint = "make it once, in main: a global variable, or a member of a class"
    return Wrong("", seen, node.at(lines), hint)


def another_topic_published(node: Joy2TwistNode) -> Wrong | None:
    topic, where = node.twists_elsewhere, node.at_call("Publisher")
    hint = f"the topic is called {node.answers.cmd_vel}; that of the TurtleBot stands in"
    hint = f"{hint} the launch file alone, in a <remap>" if "mux" in topic else node.publisher
    seen = f"it publishes on {topic}"
    return node.private("Publisher", seen) or Wrong("", seen, where, hint) if topic else None


def nothing_published(node: Joy2TwistNode) -> Wrong:
    hint, where = f"{node.publisher}, and publish(msg) in the callback", node.at_call("Publisher")
    maker = node.source.idioms.publisher_name
    if node.source.first("Publisher"):
        return Wrong("", "it publishes nothing", where, hint)
    seen = f"it publishes nothing: there is no {maker} in it"
    return Wrong("", seen, where, f"{hint}; or was another file edited?")


NO_TOPIC = (
    crashed_with_publisher, another_topic_published, publisher_ends_with_callback,
    nothing_published,
)  # fmt: skip
