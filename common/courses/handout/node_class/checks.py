"""C29 to C33: the program as a class, also ended while it drives."""

from __future__ import annotations

import re
from pathlib import Path

from tutorial_check import (
    ClassFacts,
    Note,
    PythonFacts,
    Submission,
    Wrong,
    cause_of,
    check,
    check_file,
    crash,
    first_traceback,
    last_lines,
    must_be_launchable,
    must_be_one_program,
    with_bases,
    without_name,
)

from ..driving import behaviour
from ..driving.program import check_manifest
from ..task import NAME, PACKAGE
from .record import LAUNCH, End, Endings, alone, endings

NAMES_IT = re.compile(r"not defined|NameError")  # what the lack of the import leads to
ARGUMENTS_HINT = "roslaunch gives it arguments such as __name:=...; rospy.myargv() leaves those out"
REPORTS = re.compile(r"Traceback|Error\b|Exception|not defined|exceeded|\[(?:ERROR|FATAL|WARN)\]")


def _class_of(submission: Submission) -> tuple[str, ClassFacts] | None:
    """Return (path, ClassFacts) of the class that deals with ROS, of several the likeliest one."""
    scripts, folder = submission.scripts(PACKAGE), submission.package(PACKAGE).folder
    owned = [(path, one) for path, facts in scripts.items() for one in facts.classes]
    bases = {base.rpartition(".")[2] for _, one in owned for base in one.bases}
    whole = zip(owned, with_bases([one for _, one in owned]))

    def unlikely(found: tuple[str, ClassFacts]) -> tuple[bool | str, ...]:
        """Return a sort key: joy2twist.py may be a class already, and there are old copies."""
        path, one = found
        return (
            one.name in bases,
            not _fits(one.name + path),
            bool(re.search(r"(^|/)(old|backup|copy)[^/]*/", path, re.IGNORECASE)),
            "on_shutdown" not in scripts[path].calls,
            not (folder / path).stat().st_mode & 0o100,
            Path(path).name == NAME,
            path,
        )

    nodes = [(path, one) for (path, _), one in whole if one.is_node]
    return min(nodes, key=unlikely, default=None)


def _fits(words: str) -> bool:
    return bool(re.search(r"joy.*twist", words, re.IGNORECASE))


def program(submission: Submission) -> tuple[str, str, ClassFacts]:
    """Return (the program to start, the file with the class, its ClassFacts). Raises Wrong."""
    scripts, found = submission.scripts(PACKAGE), _class_of(submission)
    if not found:
        for path in (path for path, facts in scripts.items() if facts.error and _fits(path)):
            check_file(submission, PACKAGE, path)
        named = [path for path in scripts if re.search(r"new|class", path, re.IGNORECASE)]
        names = submission.task.names
        expected = f"a class that subscribes to {names.joy} and publishes on {names.cmd_vel}"
        hint = "class NewJoy2Twist: with __init__(self), callback(self, data), shutdown(self)"
        seen = f"no class in any program of {names.package}"
        raise Wrong(expected, seen, next(iter(named), ""), hint)
    path, one = found
    file = submission.package(PACKAGE).folder / path
    if scripts[path].has_main or file.stat().st_mode & 0o100 or "src/" not in path:
        return path, path, one
    stem = Path(path).stem
    users = (p for p, f in scripts.items() if any(stem in word.split(".") for word in f.imports))
    return next(users, path), path, one


def _check_given(path: str, one: ClassFacts, facts: PythonFacts, name: str, place: int) -> None:
    """Raise Wrong for what ROS is given in place of a method, by the calls of that name."""
    expected = f"{'the Subscriber' if place else 'rospy.on_shutdown'} gets a method of the object"
    for number, word in facts.given(name, place):
        bare, where = word.rsplit(".", 1)[-1], f"{path}:{number}"
        if place and word in one.methods:
            seen = f"{word} alone: within a class that is no name"
            raise Wrong(expected, seen, where, f"self.{word}")
        if bare.endswith("()") and bare[:-2] in facts.functions:
            raise Wrong(expected, f"{word} is called at once", where, f"without (): {word[:-2]}")
        known = (bare in {*each.methods, *each.attributes} or each.bases for each in facts.classes)
        if word != f"self.{bare}" or bare.endswith("()") or any(known):
            continue
        hint = f"one name: def {bare}(self), or one of {', '.join(one.methods)}"
        seen, line = f"the class has no {bare}", facts.functions.get(bare)
        if line:
            seen = f"`def {bare}` in line {line} is no method of the class"
            hint = "indent it like `def __init__`: neither further, nor less"
        raise Wrong(expected, seen, where, hint)


@check("C29", "the program is a class", "6.2", needs="C12", look="rosrun {n.package} THE_CLASS",
       timeless=True)  # fmt: skip
def is_class(submission: Submission) -> Note | str | None:
    script, path, one = program(submission)
    must_be_one_program(submission.package(PACKAGE).folder, Path(script).name)
    check_file(submission, PACKAGE, script)
    check_manifest(submission, script)
    facts, scripts = submission.scripts(PACKAGE)[path], submission.scripts(PACKAGE).values()
    expected = "a class with __init__, its callback bound to self, made under __main__"
    odd = [each for each in one.methods if re.fullmatch(r"_*init_*", each)]
    if "__init__" not in odd and (odd or not one.bases):
        seen = f"`def {odd[0]}`: Python calls `__init__`" if odd else f"{one.name} has no __init__"
        hint = "def __init__(self): with two underscores on either side"
        raise Wrong(expected, seen, f"{path}:{one.line}", hint)
    if not (one.instantiated or script != path or any(one.name in each.calls for each in scripts)):
        bare = (line for line, text in facts.bare_names if text == one.name)
        hint = f"{one.name}() with (), under if __name__ == '__main__':"
        raise Wrong(expected, f"{one.name} is never made", f"{path}:{next(bare, one.line)}", hint)
    _check_given(path, one, facts, "on_shutdown", 0)
    _check_given(path, one, facts, "Subscriber", 2)
    if facts.globals:
        seen = "a class needs no `global`: self. keeps what its methods share"
        return Note(seen, f"{path}:{facts.globals[0]}")
    early, made = map(facts.first, ("on_shutdown", "Publisher"))
    if early and made and early.line < made.line:
        seen = "on_shutdown comes before the publisher: a Ctrl-C in between finds none"
        seen += " to stop the robot with (the handout has it so)"
        return Note(seen, f"{path}:{early.line}", "first the Publisher, then rospy.on_shutdown")
    return f"{one.name} in {path}"


@check("C30", "the class does what the functions did", "6.2", needs=is_class,
       look="rostopic echo {n.cmd_vel}")  # fmt: skip
def behaves(submission: Submission) -> Note | str | None:
    script, _, _ = program(submission)
    notes: list[object] = [behaviour.displays(submission, script, few_are_enough=True)]
    behaviours = (behaviour.topics, behaviour.mapping, behaviour.rate)
    notes += [judge(submission, script) for judge in behaviours]
    return next((note for note in notes if isinstance(note, Note)), None)


def _endings(submission: Submission) -> Endings:
    must_be_launchable(submission)
    found = submission.recording(endings, program(submission)[0])
    if found.program:
        how = "by a launch file" if found.failed == LAUNCH else "under another name"
        expected = f"the class drives, started {how} as well"
        raise crash(submission, PACKAGE, found.program, expected, ARGUMENTS_HINT)
    return found


@check("C31", "ended, it stops the robot", "6.2", needs=behaves,
       look="rostopic echo {n.cmd_vel}; Ctrl-C in the node's terminal")  # fmt: skip
def stops(submission: Submission) -> Note | str | None:
    _, path, _ = program(submission)
    seen, facts = _endings(submission), submission.scripts(PACKAGE)[path]
    call = facts.first("on_shutdown")
    where = f"{path}:{call.line}" if call else path
    expected = "ended while it drives, it sends an all-zero Twist and is gone within 3 s"
    for way, end in seen.ends.items():
        words, hint = _complaint(end, bool(call))
        if not words:
            continue
        no_zero = end.zero_after_s is None
        # One that has gone, and whose text knows no shutdown, will not send a zero another time.
        sure = no_zero and end.took_s is not None and not call
        if no_zero or not end.in_time:
            called = facts.called_by("on_shutdown", 0)
            sleep, publish = (min(called.get(name, [0])) for name in ("sleep", "publish"))
            if 0 < sleep < publish:
                where, hint = f"{path}:{sleep}", "in shutdown first the zero, then the sleep"
            trace = first_traceback(end.output, str(submission.package(PACKAGE).folder))
            if trace:
                place, hint = cause_of(submission, PACKAGE, trace, Path(path).name)
                words, where = trace.error, place or where
                sure = sure or trace.error.startswith(("NameError", "TypeError"))
        raise Wrong(expected, f"after {way}: {words}", where, hint, sure)
    if not seen.robot_rests:
        expected = "the robot stands within a second of the end of the node"
        hint = "what the program has started ends with it; who publishes? rostopic info "
        hint += submission.task.answers.cmd_vel
        raise Wrong(expected, "the node is gone, and the robot still drives", where, hint)
    return ", ".join(
        f"{way}: zero after {1000 * (end.zero_after_s or 0.0):.0f} ms,"
        f" gone after {end.took_s:.1f} s"
        for way, end in seen.ends.items()
    )


def _complaint(end: End, is_registered: bool) -> tuple[str, str]:
    """Return (what is wrong with an end, what to do); empty if nothing is."""
    if end.zero_after_s is None:
        hint = "rospy.on_shutdown(self.shutdown), and self.cmd_vel.publish(Twist()) in shutdown"
        if is_registered:
            hint = "shutdown has to publish Twist(), all zero, with the publisher of the callback"
        return "no zero comes: the robot drives on", hint
    if not end.in_time:
        return "the zero comes more than 2 s late", "in shutdown first the zero, then the rest"
    if end.took_s is None:
        hint = "does shutdown come to an end? one second of rest is enough"
        return "it still runs 3 s later", hint
    return "", ""


@check("C32", "nothing follows the zero", "6.2", needs=stops, look="rostopic echo {n.cmd_vel}")
def nothing_after(submission: Submission) -> Note | str | None:
    """Note moving Twists after the zero; no failure, as the handout's listing sends some."""
    most = max(end.after_zero for end in _endings(submission).ends.values())
    if not most:
        return None
    seen = f"{most} moving Twists followed the zero:"
    seen += " the callback goes on during shutdown (the handout's does, too)"
    hint = "self.sub = rospy.Subscriber(...) in __init__;"
    hint += " in shutdown self.sub.unregister() first, then the zero"
    return Note(seen, program(submission)[1], hint)


@check("C33", "its errors are seen", "6.2", needs=behaves,
       look="rosrun {n.package} THE_CLASS, without a joystick")  # fmt: skip
def errors_are_seen(submission: Submission) -> Note | str | None:
    script, path, _ = program(submission)
    text = without_name(submission.text(PACKAGE, script), "Joy")
    seen = submission.recording(alone, script, text or "")
    excepts = submission.scripts(PACKAGE)[path].broad_excepts
    where = f"{path}:{excepts[0].lineno}" if excepts else path
    output = seen.program.output
    if seen.ended and not REPORTS.search(output):
        words = f"nobody publishes on {submission.task.names.joy}, and it ends; it printed: "
        words += last_lines(output) or "nothing"
        hint = "a Subscriber waits by itself, for as long as it takes;"
        hint += " what an except catches, it should show"
        expected = "without a joystick it waits for one, or says what it misses"
        raise Wrong(expected, words, where, hint)
    if not NAMES_IT.search(seen.broken.output) if seen.broken and seen.broken_ended else excepts:
        words = "except: hides every mistake, a misspelt name as well as Ctrl-C"
        return Note(words, where, "except rospy.ROSInterruptException:")
    if seen.ended:
        return Note(f"without a joystick it ends: {last_lines(output, 1)}", where)
    return None
