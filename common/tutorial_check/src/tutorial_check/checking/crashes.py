"""Why a student's program has failed or ended."""

from __future__ import annotations

import re
from pathlib import Path

from tutorial_check.checking.causes import explain, hider, traced
from tutorial_check.checking.cpp_causes import CALLS_BACK
from tutorial_check.checking.cpp_crashes import compiled_crash, compiled_program
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.data.recorders import BUILT
from tutorial_check.data.recordings import Ran
from tutorial_check.submission.idioms import PYTHON
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.source_facts import ClassFacts, SourceFacts
from tutorial_check.submission.tracebacks import Traceback, first_traceback, last_lines

ENDS_AT_ONCE = {
    "spinOnce": "ros::spinOnce() returns at once, and then main: ros::spin() waits for messages",
    "AsyncSpinner": "its start() returns at once, and then main: ros::waitForShutdown() below it",
}
COPY = re.compile(r"checked_\d+_")  # a program with one thing changed; see Builder.sibling


def traceback_of(submission: Submission, package: str, output: str) -> Traceback | None:
    """Return the first Traceback in the output of a package's program, or None."""
    return first_traceback(output, str(submission.package(package).folder))


def cause_of(
    submission: Submission, package: str, trace: Traceback, name: str = ""
) -> tuple[str, str]:
    """Return (the line to blame, fix) for a program's Traceback. name: the program's, if known."""
    name, paths = COPY.sub("", name), submission.scripts(package)
    script = next((path for path in paths if Path(path).name == name), "")
    script = COPY.sub("", trace.where.rpartition(":")[0] or script)  # with the same lines
    if not script:
        return trace.where, explain(trace.error, trace.text)
    facts = PythonFacts(submission.text(package, script))
    function = re.search(r"(\w+)\(\) (?:takes|missing)", trace.error)
    line = int(trace.where.rpartition(":")[2] or 0)
    if not line and function:  # called by rospy itself
        line = facts.names.get(function[1], 0)
    line, hint = traced(trace.error, line, facts)
    hint = hint or explain(trace.error, trace.text, submission.whole(script, package))
    file, hides = hider(trace.error, script, paths)
    if hides:
        return file or f"{script}:{line}", hides
    is_import = re.match("ImportError|ModuleNotFoundError", trace.error)
    if is_import and submission.needs_build() and submission.recording(BUILT).code != 0:
        fails = "catkin_make, which may have to generate it, fails: run it to see why"
        hint = "; ".join(filter(None, (hint, fails)))
    return f"{script}:{line}" if line else "", hint


def crash(
    submission: Submission, package: str, program: Ran, expected: str, hint: str = ""
) -> Wrong:
    """Return the Wrong for a program that ended or failed, with the cause from its output."""
    compiled = compiled_crash(submission, package, program, expected)
    if compiled:
        compiled.hint = compiled.hint or hint
        return compiled
    trace = traceback_of(submission, package, program.output)
    if trace and not (program.was_stopped and trace.error.startswith("KeyboardInterrupt")):
        seen = trace.error + (f"   in: {trace.text}" if trace.text else "")
        place, cause = cause_of(submission, package, trace, program.name)
        return Wrong(expected, seen, place, cause or hint, sure=True)
    if program.code is not None and program.code < 0:
        return Wrong(expected, f"the program was ended by signal {-program.code}", "", hint)
    if program.spins:
        return _busy(submission, package, program, expected)
    seen = "it runs" if program.code is None else f"it ended, exit code {program.code}"
    said = last_lines(program.output)
    seen += f"; it printed: {said}" if said else ", and printed nothing"
    return Wrong(expected, seen, hint=hint)


def _busy(submission: Submission, package: str, program: Ran, expected: str) -> Wrong:
    """Return the Wrong for a program that has an endless loop."""
    seen = f"{program.name} uses the CPU without making progress"
    path = compiled_program(submission, package, program.name)
    facts = submission.facts_of(package, path) if path else None
    if facts and facts.lapses.empty_loop:
        where = facts.place(path, facts.lapses.empty_loop)
        hint = "the ; after while (...) is the whole loop: delete it"
        return Wrong(expected, seen, where, hint, sure=True)
    init = (facts.idioms if facts else PYTHON).init
    hint = f"an endless loop? There must be none in the callback, or before {init}"
    return Wrong(expected, seen, hint=hint, sure=True)


def silent_end(facts: SourceFacts) -> tuple[int, str]:
    """Return (line or 0, hint) for a program that ends at once, as far as its text shows why."""
    if not facts.is_python:
        return silent_main(facts)
    if facts.keyboard:
        return facts.keyboard, explain("EOF when reading a line")
    for line, text in facts.bare_names:
        if text.endswith(("spin", "listener")):
            return line, f"{text} needs its (): {text}()"
    for node in (node for node in facts.classes if node.is_node):
        hint = misspelt_init(node) or never_made(node)
        if hint:
            return node.line, hint
    if facts.sunken_main:
        line, function = facts.sunken_main
        hint = f"line {line} is inside {function}(): move it, and the lines below it, to the left"
        return line, f"{hint} margin"
    if "spin" not in facts.calls:
        return 0, "rospy.spin() is missing: without it the program ends"
    if not facts.has_main:
        return 0, "listener() is never called: if __name__ == '__main__': listener()"
    return 0, "is listener() called, in the last line, and with ()?"


def silent_main(facts: SourceFacts) -> tuple[int, str]:
    """Return the same for a program in C++, whose main returns."""
    idioms = facts.idioms
    for name, hint in ENDS_AT_ONCE.items():
        if name in facts.calls and "spin" not in facts.calls and not facts.loops:
            return facts.lines(name)[0], hint
    if facts.loops or any(name in facts.calls for name in CALLS_BACK):
        return 0, f"main returns: only {idioms.spin}, or {idioms.loop}, keeps a program running"
    waits = "Subscriber" in facts.calls
    lines = facts.lines(*("Subscriber",) if waits else ("publish", "Publisher"))
    need = f"{idioms.spin} belongs below it" if waits else f"{idioms.loop} belongs around it"
    return next(iter(lines), 0), f"{need}: without that main returns, and the program ends"


def misspelt_init(node: ClassFacts) -> str:
    odd = next((name for name in node.methods if re.fullmatch(r"_*init_*", name)), "__init__")
    if odd == "__init__" or "__init__" in node.methods:
        return ""
    return f"`def {odd}`: Python calls `__init__`, two underscores on either side"


def never_made(node: ClassFacts) -> str:
    hint = f"it is never created: {node.name}() under if __name__ == '__main__':"
    return "" if node.instantiated else hint
