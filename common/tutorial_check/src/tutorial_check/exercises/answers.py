"""That a program answers each Joy at once, and with one Twist; whatever is in it."""

import collections
import statistics

from tutorial_check.model import Note, Wrong

STRAYS = 2  # zeros in a row of Joys that may be


def check_awake(seen):
    """Raises Wrong for a callback that sleeps, and so keeps the next Joy waiting."""
    if seen.naps:
        raise Wrong(
            "each Joy is answered at once",
            f"{statistics.median(seen.waits):.1f} s from one Twist to the next: the callback sleeps",
            where=f"{seen.script}:{seen.sleep_lines[0]}",
            hint="no sleep in the callback: it is called once for every message",
        )


def check_strays(seen, facts, complaint):
    """Raises Wrong for zeros between the answers, as of a loop that publishes an empty Twist.

    complaint: what is odd about the answers themselves, if anything; they may be such zeros.
    """
    has_both = len({any(twist) for twist in seen.twists}) == 2
    if seen.strays <= STRAYS and not (complaint and seen.has_clock and has_both):
        return
    line = next(iter(_outside(facts)), 0)
    raise Wrong(
        "one Twist for each Joy, and none between",
        "zeros come between the answers: the robot jerks",
        where=f"{seen.script}:{line}" if line else seen.script,
        hint="publish in the callback alone; the program ends with rospy.spin(), which waits for Joys",
    )


def check_clock(seen, facts):
    """Raises Wrong for Twists that go on moving the robot while no Joy comes, as of a Timer or a Rate loop."""
    if not seen.repeats:
        return
    timers = [call.line for name in ("Timer", "Rate") for call in facts.calls.get(name, [])]
    line = next(iter(_outside(facts) or timers), 0)
    raise Wrong(
        "one Twist for each Joy, and none without one",
        "Twists come by a clock of its own: without a joystick the robot drives on",
        where=f"{seen.script}:{line}" if line else seen.script,
        hint="publish in the callback, once for every Joy; the program ends with rospy.spin()",
    )


def _outside(facts):
    """The lines that publish within a loop, and not in a callback."""
    inside = facts.called_back.get("publish", [])
    outside = [call.line for call in facts.calls.get("publish", []) if call.line not in inside]
    return [line for line in outside if any(loop <= line for loop in facts.loops)]


def check_once(seen, facts):
    """A Note on several Twists for each Joy, or None. Raises Wrong if they differ."""
    if seen.has_clock or not seen.samples:
        return None
    count, differ = repetition([twist for _, twist in seen.samples], seen.twists)
    if count < 2:
        return None
    line = _second_line(facts)
    where = f"{seen.script}:{line}" if line else seen.script
    if not differ:
        return Note(f"{count} Twists for each Joy", where, "one is enough: publish once")
    if count == 2 and not any(map(any, (twist for _, twist in seen.samples))):
        raise Wrong(
            "one Twist for each Joy",
            "two Twists for one Joy, and the second is zero: the robot jerks",
            where=where,
            hint="publish once, at the end of the callback: delete this second publish",
        )
    raise Wrong(
        "one Twist for each Joy",
        f"{count} Twists for each Joy, and they differ: the robot jerks",
        where=where,
        hint="publish once, at the end of the callback",
    )


def _second_line(facts):
    """Where a second Twist may come from: a second publish in a callback, or a second Subscriber."""
    publishes = facts.called_back.get("publish", [])
    subscribers = [call.line for call in facts.calls.get("Subscriber", [])]
    return next((lines[1] for lines in (publishes, subscribers) if len(lines) > 1), 0)


def repetition(answers, twists):
    """(how many Twists came for each Joy, whether they differ); (1, False) if no such number is clear.

    answers: one Twist for each Joy; twists: all that came meanwhile. Which of them belong to one Joy
    is not looked at, as one may come late: it is counted how often an answer came.
    """
    count = round(len(twists) / len(answers))
    if count < 2 or abs(len(twists) - count * len(answers)) > 0.1 * len(answers):
        return 1, False
    often = collections.Counter(twists).values()
    return count, sum(times < count for times in often) > 0.5 * len(often)
