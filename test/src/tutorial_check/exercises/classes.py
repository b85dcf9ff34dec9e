"""C29 to C33: the program as a class, with an orderly end."""

import re
import time
from pathlib import Path

from tutorial_check.exercises import conversation
from tutorial_check.exercises.driving import CMD_VEL, JOY, NEUTRAL, PACKAGE, drive
from tutorial_check.exercises.files import check_file, crash
from tutorial_check.exercises.joy2twist import check_manifest
from tutorial_check.exercises.robot import held
from tutorial_check.model import Note, Wrong

STOP_S, GONE_S = 2.0, 3.0
ZERO = (0.0,) * 6


def _class_files(session):
    """{path: ClassFacts} of the classes that deal with ROS; of several the likeliest first."""
    scripts = session.scripts(PACKAGE)
    found = {
        path: next(one for one in facts.classes if one.is_node)
        for path, facts in scripts.items()
        if facts.is_class_program and "checked_" not in path
    }
    return dict(
        sorted(found.items(), key=lambda item: (not _fits(item[1].name + item[0]), item[0]))
    )


def _fits(words):
    return bool(re.search(r"joy.*twist", words, re.IGNORECASE))


def program(session):
    """(the program to start, the file with the class, its ClassFacts). Raises Wrong."""
    scripts = session.scripts(PACKAGE)
    files = _class_files(session)
    if not files:
        broken = [path for path, facts in scripts.items() if facts.error and _fits(path)]
        for path in broken:
            check_file(session, PACKAGE, path)
        named = [path for path in scripts if re.search(r"new|class", path, re.IGNORECASE)]
        raise Wrong(
            "a class that subscribes to /joy and publishes on /cmd_vel",
            "no class in any program of joy2twist",
            where=named[0] if named else "",
            hint="class NewJoy2Twist: with __init__(self), callback(self, data), shutdown(self)",
        )
    path, one = next(iter(files.items()))
    folder = session.package(PACKAGE).folder
    if scripts[path].has_main or (folder / path).stat().st_mode & 0o100 or "src/" not in path:
        return path, path, one
    stem = Path(path).stem
    for other, facts in scripts.items():
        if any(stem in word.split(".") for word in facts.imports):
            return other, path, one
    return path, path, one


def is_class(session):
    """C29."""
    script, path, one = program(session)
    check_file(session, PACKAGE, script)
    check_manifest(session, script)
    facts = session.scripts(PACKAGE)[path]
    where = f"{path}:{one.line}"
    expected = "a class with __init__, its callback bound to self, made under __main__"
    if "__init__" not in one.methods:
        odd = next((each for each in one.methods if re.fullmatch(r"_*init_*", each)), None)
        seen = f"`def {odd}`: Python calls `__init__`" if odd else f"{one.name} has no __init__"
        raise Wrong(
            expected,
            seen,
            where=where,
            hint="def __init__(self): with two underscores on either side",
        )
    made_elsewhere = any(
        one.name in other.calls or script != path for other in session.scripts(PACKAGE).values()
    )
    if not one.instantiated and not made_elsewhere:
        bare = next((line for line, text in facts.bare_names if text == one.name), None)
        raise Wrong(
            expected,
            f"{one.name} is never made",
            where=f"{path}:{bare}" if bare else where,
            hint=f"{one.name}() with (), under if __name__ == '__main__':",
        )
    for call in facts.calls.get("on_shutdown", []):
        if call.words and call.words[0].endswith("()"):
            raise Wrong(
                "rospy.on_shutdown gets the method itself",
                f"on_shutdown({call.words[0]}): it is called at the start",
                where=f"{path}:{call.line}",
                hint=f"without (): rospy.on_shutdown({call.words[0][:-2]})",
            )
        name = call.words[0].rsplit(".", 1)[-1] if call.words else ""
        if call.words and call.words[0].startswith("self.") and name not in one.methods:
            raise Wrong(
                "rospy.on_shutdown gets a method that exists",
                f"the class has no {name}",
                where=f"{path}:{call.line}",
                hint=f"one name: def {name}(self), or one of {', '.join(one.methods)}",
            )
    for call in facts.calls.get("Subscriber", []):
        callback = call.words[2] if len(call.words) > 2 else call.names.get("callback", "")
        if callback in one.methods:
            raise Wrong(
                "the callback is bound to the object",
                f"{callback} alone: within a class that is no name",
                where=f"{path}:{call.line}",
                hint=f"self.{callback}",
            )
        if callback.endswith("()"):
            raise Wrong(
                "the Subscriber gets the method itself",
                f"{callback} is called at once",
                where=f"{path}:{call.line}",
                hint=f"without (): {callback[:-2]}",
            )
    if facts.globals:
        return Note(
            "a class needs no `global`: self. keeps what its methods share",
            f"{path}:{facts.globals[0]}",
        )
    return f"{one.name} in {path}"


def behaves(session):
    """C30: as C14 to C17."""
    script, _, _ = program(session)
    seen = drive(session, script)
    notes = [
        conversation.check_displays(session, script, seen, few_are_enough=True),
        conversation.check_topics(session, seen),
        conversation.check_mapping(session, seen),
        conversation.check_rate(session, seen),
    ]
    return next((note for note in notes if isinstance(note, Note)), None)


class Ending:
    """What came of ending the program while it drove, in one of the ways there are."""

    def __init__(self, session, script, ways):
        self.took, self.zero_after, self.after_zero, self.output = {}, {}, {}, {}
        with session.stage() as stage:
            stage.call("advertise", JOY, "Joy")
            stage.call("listen", CMD_VEL, "Twist")
            for way in ways:
                self._end(session, stage, script, way)

    def _end(self, session, stage, script, way):
        before = stage.call("count", CMD_VEL)
        started = stage.start(PACKAGE, script)
        stage.wait_for_start(
            lambda: (
                (stage.call("listeners", JOY) and stage.call("speakers", CMD_VEL)) or started.ended
            )
        )
        stage.call("send", JOY, NEUTRAL)
        stage.call("stream", JOY, [held(0.2, 0.3)], 50.0, True)

        def driving():
            return (
                sum(abs(value[0]) > 0.01 for _, _, value in stage.call("heard", CMD_VEL, before))
                > 10
            )

        stage.wait(lambda: driving() or started.ended, 4.0)
        if started.ended or not driving():
            raise crash(session, PACKAGE, started, "the class drives before it is ended")
        node = stage.call("state")[0][CMD_VEL][0]
        index = stage.call("count", CMD_VEL)
        began_s = time.monotonic()  # one clock for all processes
        if way == "Ctrl-C":
            session.box.interrupt(started)
        else:
            stage.call("kill_node", node)
        stage.wait(lambda: started.ended, GONE_S + 0.5)
        gone = started.ended
        self.took[way] = time.monotonic() - began_s if gone else None
        stage.call("end_stream", JOY)
        session.box.end(started, 0.2)
        stage.wait(lambda: not stage.call("speakers", CMD_VEL), 3.0)
        heard = stage.call("heard", CMD_VEL, index)
        first = next((number for number, (_, _, value) in enumerate(heard) if value == ZERO), None)
        self.zero_after[way] = heard[first][0] - began_s if first is not None else None
        self.after_zero[way] = (
            sum(value != ZERO for _, _, value in heard[first or 0 :]) if first is not None else 0
        )
        self.output[way] = started.output


WAYS = ("Ctrl-C", "rosnode kill")


def _ending(session):
    return session.run("ending", lambda: Ending(session, program(session)[0], WAYS))


def stops(session):
    """C31."""
    _, path, _ = program(session)
    ending = _ending(session)
    facts = session.scripts(PACKAGE)[path]
    call = facts.first("on_shutdown")
    where = f"{path}:{call.line}" if call else path
    expected = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
    for way in WAYS:
        trace = None
        if ending.zero_after[way] is None or ending.zero_after[way] > STOP_S:
            trace = _trace(session, ending.output[way])
        if trace:
            from tutorial_check.tracebacks import explain  # noqa: PLC0415

            raise Wrong(
                expected,
                f"after {way}: {trace.error}",
                where=trace.where or where,
                hint=explain(trace.error),
            )
        if ending.zero_after[way] is None:
            hint = "rospy.on_shutdown(self.shutdown), and self.cmd_vel.publish(Twist()) in shutdown"
            if call:
                hint = (
                    "shutdown has to publish Twist(), all zero, with the publisher of the callback"
                )
            raise Wrong(
                expected, f"after {way} no zero comes: the robot drives on", where=where, hint=hint
            )
        if ending.took[way] is None:
            raise Wrong(
                expected,
                f"after {way} it still runs 3 s later",
                where=where,
                hint="does shutdown come to an end? one second of rest is enough",
            )
    return ", ".join(
        f"{way}: zero after {1000 * max(0.0, ending.zero_after[way]):.0f} ms, gone after {ending.took[way]:.1f} s"
        for way in WAYS
    )


def _trace(session, output):
    from tutorial_check.tracebacks import first_traceback  # noqa: PLC0415

    return first_traceback(output, str(session.package(PACKAGE).folder))


def nothing_after(session):
    """C32. Never a failure: the handout's listing does it."""
    ending = _ending(session)
    most = max(ending.after_zero.values())
    if most:
        path = program(session)[1]
        return Note(
            f"{most} moving Twists followed the zero: the callback goes on during shutdown (the handout's does, too)",
            path,
            "unregister the subscriber first: self.sub.unregister(); then publish the zero",
        )
    return None


def errors_are_seen(session):
    """C33. Never a failure: the handout's listing hides them."""
    path = program(session)[1]
    facts = session.scripts(PACKAGE)[path]
    if facts.broad_excepts:
        return Note(
            "except: hides every mistake, a misspelt name as well as Ctrl-C",
            f"{path}:{facts.broad_excepts[0]}",
            "except rospy.ROSInterruptException:",
        )
    return None
