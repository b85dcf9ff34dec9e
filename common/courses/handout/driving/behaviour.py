"""What a program from Joy to Twist does: section 4.3 asks it of joy2twist.py, 6.2 of the class."""

from __future__ import annotations

import re
import statistics
from dataclasses import replace

from tutorial_check import (
    MASTER_GONE,
    CutShort,
    Note,
    Row,
    Submission,
    Wrong,
    demand,
    find,
    wrong_of,
)

from ..task import AXES
from .facts import Facts
from .probes import ROUNDED, SILENCES
from .program import main_script
from .record import COUNT, drive
from .rules import judge

CONNECTS = "it subscribes to {f.n.joy}, sensor_msgs/Joy"
DISPLAYS = "every Joy displayed with its six axes, two decimals, in one line"
PUBLISHES = "it publishes on {f.n.cmd_vel}, geometry_msgs/Twist"
MAPS = "for each Joy one Twist: linear.x = {f.n.rules[1]}, angular.z = {f.n.rules[0]}, all else 0"
KEEPS_UP = "at 50 Joys a second as many Twists, each within 50 ms"
STRAYS = 2  # zeros in a row of Joys that may be
IN_CALLBACK = "publish in the callback alone, once for every Joy; end with rospy.spin()"

SLEEPING = Row(
    lambda c: c.seen.naps and f"{statistics.median(c.seen.waits):.1f} s",
    "{found} from one Twist to the next: the callback sleeps",
    "no sleep in the callback: it is called once for every message", "{f.at[sleep]}",
)  # fmt: skip
CRASHED = Row(lambda c: c.seen.trouble, lambda c: c.crash())
HIDDEN = Row(lambda c: c.hidden_crash, lambda c: c.hidden_crash)
ENDED = Row(lambda c: c.seen.ended_early, lambda c: c.end())
CONNECTED = (
    Row(lambda c: not c.seen.master_alive,
        lambda c: wrong_of(CutShort(MASTER_GONE), c.seen.script)),
    Row(lambda c: not c.seen.connected and c.a.joy in c.seen.subscribers,
        "it wants {f.wanted} on {f.n.joy}", "{f.line[Joy]}", "{f.at[Subscriber]}"),
    Row(lambda c: not (c.seen.samples or c.seen.shown) and c.facts.without_callback,
        "its Subscriber has no callback", "{f.line[Joy]}", "{f.seen.script}:{found.line}",
        sure=True),
)  # fmt: skip
NOT_CONNECTED = (
    Row(lambda c: c.seen.program.spins, lambda c: c.end()),
    CRASHED,
    HIDDEN,
    ENDED,
    Row(lambda c: c.a.joy in c.seen.publishers and c.seen.types.get(c.a.joy, "?"),
        "it PUBLISHES on {f.n.joy} ({found})",
        "a Subscriber receives what the joystick sends, a Publisher sends", "{f.at[Subscriber]}"),
    Row(lambda c: c.elsewhere["Joy"].lower() == c.a.joy and c.elsewhere["Joy"],
        "it subscribes to {found}", "the topic is called {f.a.joy}, in lower case",
        "{f.at[Subscriber]}"),
    Row(lambda c: c.elsewhere["Joy"],
        "it subscribes to {found}", "{f.line[Joy]}", "{f.at[Subscriber]}"),
    Row(lambda c: True, "it subscribes to nothing",
        "{f.line[Joy]}, after rospy.init_node and before rospy.spin()", "{f.at[Subscriber]}"),
)  # fmt: skip
DISPLAYED = (
    CRASHED,
    Row(lambda c: c.first_version, "displayed by {found}, no more by {f.seen.script}", note=True),
    Row(lambda c: c.seen.shown, f"{{found}} of {COUNT} were displayed", note=True),
    SLEEPING,
    Row(lambda c: c.seen.shows_numbers and next((
            each[0].line for name, each in c.facts.calls.items() if name.endswith("_throttle")), 0),
        "it displays a Joy now and then; the handout's displays every one",
        "rospy.loginfo in place of rospy.loginfo_throttle", "{f.seen.script}:{found}", note=True),
)  # fmt: skip
NOT_DISPLAYED = (
    HIDDEN,
    Row(lambda c: c.found_values(10 * ROUNDED) == AXES,
        "the six values have less than two decimals", "%.2f for each value", "{f.seen.script}"),
    Row(lambda c: c.found_values(), "a line has {found} of the six values of a message",
        "all six: [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f] % data.axes", "{f.seen.script}"),
    Row(lambda c: {"logdebug", "Publisher"} <= {*c.facts.calls},
        "it logs at the level debug, which is not shown", note=True),
    Row(lambda c: True, "not one value of a message was found in its output",
        "display data.axes in the callback, with rospy.loginfo(...)", "{f.seen.script}"),
)  # fmt: skip
TOPICS = (
    Row(lambda c: c.seen.publishers.get(c.a.joy), "it publishes on {f.n.joy} itself ({found[0]})",
        "{f.a.joy} belongs to the joystick", "{f.at[Publisher]}"),
    Row(lambda c: c.drivers and c.carried,
        "{f.n.cmd_vel} carries {found}", "{f.line[Twist]}", "{f.at[Publisher]}"),
    Row(lambda c: len(c.drivers) > 1 and ", ".join(c.drivers), "several do: {found}", "",
        "{f.at[Publisher]}"),
    Row(lambda c: c.drivers and c.facts.called_back.get("Publisher"),
        "the Publisher is made in the callback: what it sends before a subscriber has connected"
        " is lost", "make it once, before the Subscriber", "{f.seen.script}:{found[0]}", note=True),
)  # fmt: skip
NO_TOPIC = (
    Row(lambda c: c.seen.trouble and c.facts.first("Publisher"), lambda c: c.crash()),
    Row(lambda c: "mux" in c.elsewhere["Twist"] and c.elsewhere["Twist"], "it publishes on {found}",
        "the topic is called {f.a.cmd_vel}; that of the TurtleBot stands in"
        " the launch file alone, in a <remap>", "{f.at[Publisher]}"),
    Row(lambda c: c.elsewhere["Twist"],
        "it publishes on {found}", "{f.line[Twist]}", "{f.at[Publisher]}"),
    Row(lambda c: c.facts.first("Publisher"), "it publishes nothing",
        "{f.line[Twist]}, and publish(msg) in the callback", "{f.at[Publisher]}"),
    Row(lambda c: True, "it publishes nothing: there is no rospy.Publisher in it",
        "{f.line[Twist]}, and publish(msg) in the callback; or was another file edited?",
        "{f.seen.script}"),
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
    # An odd answer may be such a zero.
    Row(lambda c: c.seen.strays > STRAYS
        or (c.complaint and c.seen.has_clock and len({any(each) for each in c.seen.twists}) == 2),
        "zeros come between the answers: the robot jerks", IN_CALLBACK, "{f.at[loop]}"),
    Row(lambda c: c.seen.repeats,
        "Twists come by a clock of its own: without a joystick the robot drives on", IN_CALLBACK,
        "{f.at[loop]}"),
    Row(lambda c: c.repeated == (2, True) and not any(any(twist) for _, twist in c.seen.samples),
        "two Twists for one Joy, and the second is zero: the robot jerks",
        "publish once, at the end of the callback: delete this second publish", "{f.at[second]}"),
    Row(lambda c: c.repeated[1],
        "{f.repeated[0]} Twists for each Joy, and they differ: the robot jerks",
        "publish once, at the end of the callback", "{f.at[second]}"),
)  # fmt: skip
RIGHT_RULE = (
    Row(lambda c: c.seen.unanswered and not c.complaint and c.seen.trouble, lambda c: c.crash()),
    Row(lambda c: not c.complaint and c.seen.unanswered
        and find(SILENCES, c.seen.silence(c.submission.task)),
        "{found.seen}", "{found.hint}", "{f.at[publish]}"),
    Row(lambda c: c.complaint, lambda c: c.odd()),
    Row(lambda c: c.seen.trouble and c.crash(), "right, but also: {found.seen}", "{found.hint}",
        "{found.where}", note=True),
    Row(lambda c: c.repeated[0] > 1, "{f.repeated[0]} Twists for each Joy",
        "one is enough: publish once", "{f.at[second]}", note=True),
    Row(lambda c: c.hint, "{found}", note=True),
    Row(lambda c: any(each.names.get("latch") == "True"
                      for each in c.facts.calls.get("Publisher", [])),
        "latch=True: a subscriber that comes late gets a velocity of long ago",
        "leave latch out", note=True),
)  # fmt: skip
RATE = (
    CRASHED,
    Row(lambda c: c.seen.sleep_lines, "{f.seen.rate}",
        "no sleep and no Rate in the callback: it is called for each message", "{f.at[sleep]}"),
    Row(lambda c: True, "{f.seen.rate}", "what in the callback takes so long?", "{f.seen.script}"),
)  # fmt: skip


def _facts(submission: Submission, script: str = "") -> Facts:
    """Return what a program did: the one of section 4.3, or another script."""
    return Facts(submission, submission.recording(drive, script or main_script(submission)))


def _connected(submission: Submission, script: str) -> Facts:
    """Return the same of a program that subscribes to Joys. Raises Wrong."""
    one = _facts(submission, script)
    demand(CONNECTED, one, CONNECTS)
    said_anything = one.seen.samples or one.seen.shown
    if not one.seen.connected or (one.seen.ended_early and not said_anything):
        demand(NOT_CONNECTED, one, CONNECTS)
    return one


def displays(submission: Submission, script: str = "", few_are_enough: bool = False) -> Note | None:
    one = _connected(submission, script)
    if one.seen.all_shown or (one.seen.shown and few_are_enough):
        return None
    note = demand(DISPLAYED, one, DISPLAYS)
    if note or few_are_enough:
        return note or Note("it displays nothing; the handout's does")
    return demand(NOT_DISPLAYED, one, DISPLAYS)


def topics(submission: Submission, script: str = "") -> Note | str:
    one = _connected(submission, script)
    note = demand(TOPICS, one, PUBLISHES)
    if one.a.cmd_vel not in one.seen.publishers:
        demand(NO_TOPIC, one, PUBLISHES)
    name, node = submission.task.values.get("node"), one.seen.subscribers.get(one.a.joy, [""])[0]
    if name and not script and not re.fullmatch(rf"/{name}(_\d+_\d+)?", node):
        expected, hint = "the name of the node that the task asks for", f"init_node('{name}')"
        raise Wrong(expected, f"it is called {node}", one.at["init_node"], hint)
    return note or f"{one.n.joy} -> {one.n.cmd_vel}"


def mapping(submission: Submission, script: str = "") -> Note | None:
    """Check that linear.x follows axis 1, angular.z axis 0; a Wrong names the rule found."""
    one, task = _facts(submission, script), submission.task
    if not one.seen.trouble:
        demand([SLEEPING], one, MAPS)
    if len(one.seen.samples) < COUNT * 0.9:
        demand(ANSWERED, one, MAPS)
    ruled = judge(replace(one.seen.evidence, task=task))
    probed = ruled if ruled[0] else one.seen.judge_probes(task)
    one.complaint, one.hint = probed if probed[0] else ruled
    demand(ONCE, one, MAPS)
    return demand(RIGHT_RULE, one, MAPS)


def rate(submission: Submission, script: str = "") -> Note | str | None:
    one = _facts(submission, script)
    return one.seen.rate if one.seen.is_prompt else demand(RATE, one, KEEPS_UP)
