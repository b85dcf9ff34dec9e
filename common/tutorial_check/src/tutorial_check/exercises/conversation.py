"""What a program that turns Joy into Twist is asked: C14 to C17, and C30 of the class."""

import contextlib
import re

from tutorial_check.causes import with_import
from tutorial_check.changed_programs import unmasked
from tutorial_check.exercises.answers import check_awake, check_clock, check_once, check_strays
from tutorial_check.exercises.driving import CMD_VEL, COUNT, JOY, PACKAGE, check_master, drive
from tutorial_check.exercises.files import check_file, crash
from tutorial_check.exercises.silent_end import silent_end
from tutorial_check.mapping import judge
from tutorial_check.model import Note, Wrong
from tutorial_check.probing import judge_probes
from tutorial_check.python_text import python_lines

JOY_LINE = "rospy.Subscriber('/joy', Joy, callback)"
TWIST_LINE = "rospy.Publisher('/cmd_vel', Twist, queue_size=10)"


def crash_of(session, seen, expected, hint=""):
    """The Wrong for a program that failed; with an except that hides the cause taken away."""
    program = seen.program
    facts = session.scripts(PACKAGE)[seen.script]
    hides = facts.broad_excepts and not program.spins
    if hides and (seen.ended_early or not seen.trouble):
        text = unmasked(session.text(PACKAGE, seen.script))
        if text:
            shown = drive(
                session,
                session.memo(
                    ("unmasked", seen.script), lambda: session.sibling(PACKAGE, seen.script, text)
                ),
            )
            if shown.trouble:
                wrong = crash(session, PACKAGE, shown.program, expected, hint)
                wrong.where = wrong.where.replace(shown.script, seen.script)
                failed = int(wrong.where.rpartition(":")[2] or 0)
                line = min(facts.broad_excepts, key=lambda each: (each < failed, each))
                text = python_lines(session.text(PACKAGE, seen.script))[line - 1].strip()
                wrong.seen += f" (hidden by `{text}` in line {line})"
                return wrong
    return crash(session, PACKAGE, program, expected, hint)


def _raise_hidden(session, seen, expected):
    """Raise the Wrong for an error that an except hides, if that explains it."""
    if session.scripts(PACKAGE)[seen.script].broad_excepts:
        wrong = crash_of(session, seen, expected)
        if wrong.where:
            raise wrong


def check_connected(session, seen):
    """It subscribes to /joy as Joy, or Wrong says why not."""
    check_master(seen)
    expected = "it subscribes to /joy, sensor_msgs/Joy"
    facts = session.scripts(PACKAGE)[seen.script]
    call = facts.first("Subscriber")
    where = f"{seen.script}:{call.line}" if call else seen.script
    if not seen.connected and JOY in seen.subscribers:
        words = call.words[1] if call and len(call.words) > 1 else "another type"
        raise Wrong(
            expected,
            f"it wants {words} on /joy",
            where=where,
            hint=with_import(JOY_LINE, "Joy", facts),
        )
    if facts.deaf and not (seen.samples or seen.shown):
        place = f"{seen.script}:{facts.deaf.line}"
        raise Wrong(
            expected, "its Subscriber has no callback", where=place, hint=JOY_LINE, sure=True
        )
    if seen.connected and not (seen.ended_early and not seen.samples and not seen.shown):
        return
    if seen.program.spins:
        raise crash_of(session, seen, expected)
    if seen.trouble or facts.broad_excepts:
        wrong = crash_of(session, seen, expected)
        if seen.trouble or wrong.where:
            raise wrong
    if seen.ended_early:
        place, hint = silent_end(facts, seen.script)
        raise Wrong(
            expected, crash(session, PACKAGE, seen.program, "").seen, where=place, hint=hint
        )
    if JOY in seen.publishers:
        raise Wrong(
            expected,
            f"it PUBLISHES on /joy ({seen.types.get(JOY)})",
            where=where,
            hint="a Subscriber hears what the joystick says, a Publisher speaks",
        )
    others = sorted(set(seen.subscribers) - {"/rosout", "/clock"})
    if others:
        raise Wrong(
            expected, f"it subscribes to {others[0]}", where=where, hint="the topic is called /joy"
        )
    raise Wrong(
        expected,
        "it subscribes to nothing",
        where=where,
        hint=f"{JOY_LINE}, after rospy.init_node and before rospy.spin()",
    )


def check_displays(session, script, seen, few_are_enough=False):
    """Joys appear in the output with all six axes, or Wrong."""
    check_connected(session, seen)
    expected = "every Joy displayed with its six axes, two decimals, in one line"
    if seen.all_shown or (seen.shown and few_are_enough):
        return None
    if seen.trouble:
        raise crash_of(session, seen, expected)
    first = next(
        (
            other
            for other, facts in session.scripts(PACKAGE).items()
            if other != script
            and "Subscriber" in facts.calls
            and "Publisher" not in facts.calls
            and not other.rsplit("/", 1)[-1].startswith("checked_")
        ),
        None,
    )
    if first:
        with contextlib.suppress(Wrong):
            check_file(session, PACKAGE, first)
            if drive(session, first, wants_twist=False).all_shown:
                return Note(f"displayed by {first}, no more by {script}")
    if seen.shown:
        return Note(f"{seen.shown} of {COUNT} were displayed")
    check_awake(seen)
    facts = session.scripts(PACKAGE)[script]
    throttled = next(
        (calls[0] for name, calls in facts.calls.items() if name.endswith("_throttle")), None
    )
    if throttled and seen.shows_numbers:
        return Note(
            "it displays a Joy now and then; the handout's displays every one",
            f"{script}:{throttled.line}",
            "rospy.loginfo in place of rospy.loginfo_throttle",
        )
    _raise_hidden(session, seen, expected)
    has_words = any(name in facts.calls for name in ("loginfo", "print", "logdebug", "logwarn"))
    values = [f"{abs(axis):.2f}" for axis in seen.joys[3][0]]
    found = sum(value in seen.output for value in values)
    if few_are_enough:
        return Note("it displays nothing; the handout's does")
    if found >= 2:
        raise Wrong(
            expected,
            f"{found} of the six values of a message were found",
            where=script,
            hint="all six: [%.2f, %.2f, %.2f, %.2f, %.2f, %.2f] % data.axes",
        )
    if "logdebug" in facts.calls and "Publisher" in facts.calls:
        return Note("it logs at the level debug, which is not shown")
    raise Wrong(
        expected,
        "not one value of a message was found in its output",
        where=script,
        hint="rospy.loginfo(...) in the callback, with data.axes"
        if not has_words
        else "does the callback display data.axes?",
    )


def check_topics(session, seen):
    """/joy in, /cmd_vel out, with their types, or Wrong."""
    check_connected(session, seen)
    expected = "it publishes on /cmd_vel, geometry_msgs/Twist"
    facts = session.scripts(PACKAGE)[seen.script]
    call = facts.first("Publisher")
    where = f"{seen.script}:{call.line}" if call else seen.script
    if JOY in seen.publishers:
        raise Wrong(
            "it only listens to /joy",
            f"it publishes on /joy itself ({', '.join(seen.publishers[JOY])})",
            where=where,
            hint="/joy belongs to the joystick",
        )
    if CMD_VEL in seen.publishers:
        kind = seen.types.get(CMD_VEL)
        if kind != "geometry_msgs/Twist" or any(
            "datatype" in line and CMD_VEL in line for line in seen.warnings
        ):
            raise Wrong(
                expected,
                f"/cmd_vel carries {kind}",
                where=where,
                hint=with_import(TWIST_LINE, "Twist", facts),
            )
        if len(set(seen.publishers[CMD_VEL])) > 1:
            raise Wrong(expected, f"several do: {', '.join(seen.publishers[CMD_VEL])}", where=where)
        made = facts.called_back.get("Publisher")
        if made:
            return Note(
                "the Publisher is made in the callback: what it sends before anybody has"
                " connected is lost",
                f"{seen.script}:{made[0]}",
                "make it once, before the Subscriber",
            )
        return "/joy -> /cmd_vel"
    if seen.trouble and call:
        raise crash_of(session, seen, expected)
    others = sorted(set(seen.publishers) - {"/rosout", JOY})
    if others:
        hint = "the topic is called /cmd_vel"
        if "mux" in others[0]:
            hint += "; that of the TurtleBot stands in the launch file alone, in a <remap>"
        raise Wrong(expected, f"it publishes on {others[0]}", where=where, hint=hint)
    hint = f"{TWIST_LINE}, and publish(msg) in the callback"
    beside = [path for path, each in session.scripts(PACKAGE).items() if "Publisher" in each.calls]
    if beside and not call:
        hint += f"; {beside[0]} has that: was the other file edited?"
    raise Wrong(
        expected,
        "it publishes nothing" + ("" if call else ": there is no rospy.Publisher in it"),
        where=where,
        hint=hint,
    )


def check_mapping(session, seen):
    """linear.x follows axis 1, angular.z axis 0; or Wrong names the rule that was found."""
    facts = session.scripts(PACKAGE)[seen.script]
    expected = "for each Joy one Twist: linear.x = axes[1], angular.z = axes[0], all else 0"
    publish = facts.first("publish")
    where = f"{seen.script}:{publish.line}" if publish else seen.script
    if not seen.trouble:
        check_awake(seen)
    if len(seen.samples) < COUNT * 0.9:
        if seen.trouble:
            raise crash_of(session, seen, expected)
        if seen.ended_early:
            wrong = crash_of(session, seen, expected)
            place, hint = silent_end(facts, seen.script)
            wrong.where, wrong.hint = wrong.where or place, wrong.hint or hint
            raise wrong
        _raise_hidden(session, seen, expected)
        if not seen.samples and not seen.came:
            hint = (
                "is pub.publish(msg) called in the callback?"
                if not publish
                else "is publish reached for every message?"
            )
            raise Wrong(expected, "no Twist came for any Joy", where=where, hint=hint)
        raise Wrong(
            expected,
            f"{max(seen.came, len(seen.samples))} Twists for {COUNT} Joys",
            where=where,
            hint="publish in the callback, for every message",
        )
    complaint, remark = judge(seen.evidence)
    if not complaint:
        complaint, hint = judge_probes(seen.samples, seen.answers)
        remark = hint or remark
    check_strays(seen, facts, complaint)
    check_clock(seen, facts)
    repeated = check_once(seen, facts)
    if seen.unanswered and not complaint:
        if seen.trouble:
            raise crash_of(session, seen, expected)
        told, hint = seen.silence
        raise Wrong(expected, told, where=where, hint=hint)
    if complaint:
        line, hint = _line_of(session, seen.script, complaint)
        raise Wrong(
            expected,
            complaint,
            where=line or where,
            hint=hint or remark,
            sure=not seen.missing and not seen.unasked,
        )
    if seen.trouble:
        wrong = crash_of(session, seen, expected)
        return Note(f"right, but also: {wrong.seen}", wrong.where, wrong.hint)
    if repeated or remark:
        return repeated or Note(remark)
    if any(
        "latch" in call.names and call.names["latch"] == "True"
        for call in facts.calls.get("Publisher", [])
    ):
        return Note(
            "latch=True: a velocity of long ago reaches whoever comes later", hint="leave latch out"
        )
    return None


def _line_of(session, script, complaint):
    """(where the field is set that the complaint names, what to do if the line itself says that)."""
    field = re.search(r"(linear|angular)\.[xyz]", complaint)
    name = re.escape(field[0]) if field else r"(?:linear\.x|angular\.z)"
    for number, line in enumerate(python_lines(session.text(PACKAGE, script)), 1):
        if re.search(name + r"\s*=.*\bbuttons\b(?!.*\baxes\b)", line):
            return f"{script}:{number}", "the stick is data.axes, not data.buttons"
        if field and re.search(name + r"\s*[-+*/]?=", line):
            return f"{script}:{number}", ""
    return "", ""


def check_rate(session, seen):
    """50 Joys a second are answered, each soon."""
    expected = "at 50 Joys a second as many Twists, each within 50 ms"
    sleeps = seen.sleep_lines
    if seen.is_prompt:
        return f"{seen.answered} for {seen.sent}" + (
            f", {1000 * seen.delay_s:.1f} ms" if seen.delay_s is not None else ""
        )
    delay = f", {1000 * seen.delay_s:.0f} ms late" if seen.delay_s is not None else ""
    told = f"{seen.answered} Twists for {seen.sent} Joys{delay}"
    if seen.trouble:
        raise crash_of(session, seen, expected)
    raise Wrong(
        expected,
        told,
        where=f"{seen.script}:{sleeps[0]}" if sleeps else seen.script,
        hint="no sleep and no Rate in the callback: it is called for each message"
        if sleeps
        else "what in the callback takes so long?",
    )
