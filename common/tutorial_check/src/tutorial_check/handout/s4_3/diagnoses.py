"""What a program that turns Joy into Twist is asked: C14 to C17, and C30 of the class."""

from __future__ import annotations

import statistics
from dataclasses import replace

from tutorial_check.handout.s4_3.drive import Drive
from tutorial_check.handout.s4_3.facts import Facts
from tutorial_check.handout.s4_3.probes import ROUNDED, SILENCES
from tutorial_check.handout.s4_3.record import COUNT
from tutorial_check.handout.s4_3.rules import judge
from tutorial_check.handout.task import AXES
from tutorial_check.judge.rows import Row, demand, find
from tutorial_check.model import Note, master_gone
from tutorial_check.record.session import Session

CONNECTS = "it subscribes to {f.n.joy}, sensor_msgs/Joy"
DISPLAYS = "every Joy displayed with its six axes, two decimals, in one line"
PUBLISHES = "it publishes on {f.n.cmd_vel}, geometry_msgs/Twist"
MAPS = "for each Joy one Twist: linear.x = {f.n.rules[1]}, angular.z = {f.n.rules[0]}, all else 0"
KEEPS_UP = "at 50 Joys a second as many Twists, each within 50 ms"
IN_CALLBACK = "publish in the callback alone, once for every Joy; end with rospy.spin()"

SLEEPING = Row(
    lambda c: c.seen.naps and f"{statistics.median(c.seen.waits):.1f} s",
    "{found} from one Twist to the next: the callback sleeps",
    "no sleep in the callback: it is called once for every message", "{f.sleep}",
)  # fmt: skip
CRASHED = Row(lambda c: c.seen.trouble, lambda c: c.crash())
HIDDEN = Row(lambda c: c.hidden_crash, lambda c: c.hidden_crash)
ENDED = Row(lambda c: c.seen.ended_early, lambda c: c.end())
CONNECTED = (
    Row(lambda c: not c.seen.master_alive, lambda c: master_gone(c.script)),
    Row(lambda c: not c.seen.connected and c.joy in c.seen.subscribers,
        "it wants {f.wanted} on {f.n.joy}", "{f.joy_line}", "{f.at[Subscriber]}"),
    Row(lambda c: not (c.seen.samples or c.seen.shown) and c.facts.without_callback,
        "its Subscriber has no callback", "{f.joy_line}", "{f.script}:{found.line}", sure=True),
)  # fmt: skip
NOT_CONNECTED = (
    Row(lambda c: c.seen.program.spins, lambda c: c.end()),
    CRASHED,
    HIDDEN,
    ENDED,
    Row(lambda c: c.joy in c.seen.publishers and c.seen.types.get(c.joy, "?"),
        "it PUBLISHES on {f.n.joy} ({found})",
        "a Subscriber receives what the joystick sends, a Publisher sends", "{f.at[Subscriber]}"),
    Row(lambda c: c.heard_on.lower() == c.joy and c.heard_on,
        "it subscribes to {found}", "the topic is called {f.a.joy}, in lower case",
        "{f.at[Subscriber]}"),
    Row(lambda c: c.heard_on,
        "it subscribes to {found}", "{f.joy_line}", "{f.at[Subscriber]}"),
    Row(lambda c: True, "it subscribes to nothing",
        "{f.joy_line}, after rospy.init_node and before rospy.spin()", "{f.at[Subscriber]}"),
)  # fmt: skip
DISPLAYED = (
    CRASHED,
    Row(lambda c: c.first_version, "displayed by {found}, no more by {f.script}", note=True),
    Row(lambda c: c.seen.shown, f"{{found}} of {COUNT} were displayed", note=True),
    SLEEPING,
    Row(lambda c: c.throttled, "it displays a Joy now and then; the handout's displays every one",
        "rospy.loginfo in place of rospy.loginfo_throttle", "{f.script}:{found}", note=True),
)  # fmt: skip
NOT_DISPLAYED = (
    HIDDEN,
    Row(lambda c: c.found_values(10 * ROUNDED) == AXES, "the six values have less than two decimals",
        "%.2f for each value", "{f.script}"),
    Row(lambda c: c.found_values(), "a line has {found} of the six values of a message",
        "all six: [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f] % data.axes", "{f.script}"),
    Row(lambda c: {"logdebug", "Publisher"} <= {*c.facts.calls},
        "it logs at the level debug, which is not shown", note=True),
    Row(lambda c: True, "not one value of a message was found in its output",
        "display data.axes in the callback, with rospy.loginfo(...)", "{f.script}"),
)  # fmt: skip
TOPICS = (
    Row(lambda c: c.seen.publishers.get(c.joy), "it publishes on {f.n.joy} itself ({found[0]})",
        "{f.a.joy} belongs to the joystick", "{f.at[Publisher]}"),
    Row(lambda c: c.drivers and c.carried,
        "{f.n.cmd_vel} carries {found}", "{f.twist_line}", "{f.at[Publisher]}"),
    Row(lambda c: len(c.drivers) > 1 and ", ".join(c.drivers), "several do: {found}", "",
        "{f.at[Publisher]}"),
    Row(lambda c: c.drivers and c.facts.called_back.get("Publisher"),
        "the Publisher is made in the callback: what it sends before a subscriber has connected is lost",
        "make it once, before the Subscriber", "{f.script}:{found[0]}", note=True),
)  # fmt: skip
NO_TOPIC = (
    Row(lambda c: c.seen.trouble and c.facts.first("Publisher"), lambda c: c.crash()),
    Row(lambda c: "mux" in c.sent_on and c.sent_on,
        "it publishes on {found}", "the topic is called {f.a.cmd_vel}; that of the TurtleBot stands in"
        " the launch file alone, in a <remap>", "{f.at[Publisher]}"),
    Row(lambda c: c.sent_on,
        "it publishes on {found}", "{f.twist_line}", "{f.at[Publisher]}"),
    Row(lambda c: c.facts.first("Publisher"), "it publishes nothing",
        "{f.twist_line}, and publish(msg) in the callback", "{f.at[Publisher]}"),
    Row(lambda c: True, "it publishes nothing: there is no rospy.Publisher in it",
        "{f.twist_line}, and publish(msg) in the callback; or was another file edited?",
        "{f.script}"),
)  # fmt: skip
ANSWERED = (
    CRASHED,
    ENDED,
    HIDDEN,
    Row(lambda c: max(c.seen.came, len(c.seen.samples)), f"{{found}} Twists for {COUNT} Joys",
        "publish in the callback, for every message", "{f.at[publish]}"),
    Row(lambda c: True, "no Twist came for any Joy",
        "is pub.publish(msg) called in the callback, for every message?", "{f.at[publish]}"),
)  # fmt: skip
ONCE = (
    Row(lambda c: c.has_strays, "zeros come between the answers: the robot jerks", IN_CALLBACK,
        "{f.loop}"),
    Row(lambda c: c.seen.repeats,
        "Twists come by a clock of its own: without a joystick the robot drives on", IN_CALLBACK,
        "{f.loop}"),
    Row(lambda c: c.repeated == (2, True) and not any(any(twist) for _, twist in c.seen.samples),
        "two Twists for one Joy, and the second is zero: the robot jerks",
        "publish once, at the end of the callback: delete this second publish", "{f.second}"),
    Row(lambda c: c.repeated[1], "{f.repeated[0]} Twists for each Joy, and they differ: the robot jerks",
        "publish once, at the end of the callback", "{f.second}"),
)  # fmt: skip
RIGHT_RULE = (
    Row(lambda c: c.seen.unanswered and not c.complaint and c.seen.trouble, lambda c: c.crash()),
    Row(lambda c: not c.complaint and c.seen.unanswered and find(SILENCES, c.seen.silence(c.session.task)),
        "{found.seen}", "{found.hint}", "{f.at[publish]}"),
    Row(lambda c: c.complaint, lambda c: c.odd()),
    Row(lambda c: c.seen.trouble and c.crash(), "right, but also: {found.seen}", "{found.hint}",
        "{found.where}", note=True),
    Row(lambda c: c.repeated[0] > 1, "{f.repeated[0]} Twists for each Joy",
        "one is enough: publish once", "{f.second}", note=True),
    Row(lambda c: c.remark, "{found}", note=True),
    Row(lambda c: c.has_latch, "latch=True: a subscriber that comes late gets a velocity of long ago",
        "leave latch out", note=True),
)  # fmt: skip
RATE = (
    CRASHED,
    Row(lambda c: c.seen.sleep_lines, "{f.seen.rate}",
        "no sleep and no Rate in the callback: it is called for each message", "{f.sleep}"),
    Row(lambda c: True, "{f.seen.rate}", "what in the callback takes so long?", "{f.script}"),
)  # fmt: skip


def check_connected(session: Session, seen: Drive) -> Facts:
    one = Facts(session, seen)
    demand(CONNECTED, one, CONNECTS)
    if not seen.connected or (seen.ended_early and not seen.samples and not seen.shown):
        demand(NOT_CONNECTED, one, CONNECTS)
    return one


def check_displays(session: Session, seen: Drive, few_are_enough: bool = False) -> Note | None:
    one = check_connected(session, seen)
    if seen.all_shown or (seen.shown and few_are_enough):
        return None
    note = demand(DISPLAYED, one, DISPLAYS)
    if note or few_are_enough:
        return note or Note("it displays nothing; the handout's does")
    return demand(NOT_DISPLAYED, one, DISPLAYS)


def check_topics(session: Session, seen: Drive) -> Note | str:
    one = check_connected(session, seen)
    note = demand(TOPICS, one, PUBLISHES)
    if one.cmd_vel not in seen.publishers:
        demand(NO_TOPIC, one, PUBLISHES)
    return note or f"{one.n.joy} -> {one.n.cmd_vel}"


def check_mapping(session: Session, seen: Drive) -> Note | None:
    """Check that linear.x follows axis 1, angular.z axis 0; a Wrong names the rule found."""
    one = Facts(session, seen)
    if not seen.trouble:
        demand([SLEEPING], one, MAPS)
    if len(seen.samples) < COUNT * 0.9:
        demand(ANSWERED, one, MAPS)
    task = session.task
    one.complaint, one.hint = judge(replace(seen.evidence, task=task))
    if not one.complaint:
        one.remark = one.hint
        one.complaint, one.hint = seen.judge_probes(task)
    demand(ONCE, one, MAPS)
    return demand(RIGHT_RULE, one, MAPS)


def check_rate(session: Session, seen: Drive) -> Note | str | None:
    if seen.is_prompt:
        return seen.rate
    return demand(RATE, Facts(session, seen), KEEPS_UP)
