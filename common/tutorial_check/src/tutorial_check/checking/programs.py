"""What every program must be before it can run, C5 and C13, and why one has failed."""

from __future__ import annotations

import difflib
import re
import shutil
from pathlib import Path
from typing import Iterator

from tutorial_check.checking.causes import explain, hider, traced
from tutorial_check.checking.packages import package_of
from tutorial_check.checking.results import Note, Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.processes.program import Ran
from tutorial_check.recording.build import built, installed
from tutorial_check.submission import student_files
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.python_text import unreadable
from tutorial_check.submission.tracebacks import Traceback, first_traceback, last_lines

COPY = re.compile(r"checked_\d+_")  # a program with one thing changed; see Submission.sibling
# env -S takes arguments.
INTERPRETER = re.compile(rb"#!\s*(?:\S*/env\s+(?:-S\s*)?(?:\w+=\S*\s+)*)?(\S+)")
PYTHON3 = "#!/usr/bin/env python3"


def find_script(submission: Submission, package: str, name: str) -> str:
    """Return the path of a program within its package. Raises Wrong."""
    folder = submission.package(package).folder
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    found = must_be_one_program(folder, name)
    # One without .py counts where there is none with it.
    found += [path for each in (name, name[:-3]) for path in files if path.name == each]
    if found:
        return str(found[0].relative_to(folder))
    others = {path.name: path for path in files if path.name != "CMakeLists.txt"}
    compiled = [path for path in files if path.suffix in (".cpp", ".cc", ".cxx", ".c")]
    compiled.sort(key=lambda path: path.stem != name[:-3])
    texts = [each for each in others if others[each].suffix.lower() in ("", ".py", ".txt")]
    near = [other for other in others if other.lower().startswith(name)]
    # new_joy2twist.py is another program, and no misspelt joy2twist.py.
    near = near or difflib.get_close_matches(name, [o for o in texts if name not in o], 1, 0.75)
    if near:
        other = others[near[0]]
        paths = (submission.whole(path, package) for path in (other, other.with_name(name)))
        hint = f"mv {' '.join(paths)}: capitals, underscores and the ending count"
        raise Wrong(f"a program {name}", f"a file {near[0]}", str(other.relative_to(folder)), hint)
    if compiled:
        seen = f"a program in C++, {compiled[0].name}"
        hint = f"the exercise asks for Python, rospy: write scripts/{name}; the C++ may stay"
        raise Wrong(f"a program {name}", seen, str(compiled[0].relative_to(folder)), hint)
    expected = f"a program {name} in the package {submission.task.shown(package)}"
    hint = f"create scripts/{name} in YOUR package; ./tutorial shell without --in has one of OURS"
    look = f"ls {submission.whole('scripts', package)}"
    raise Wrong(expected, "no such file anywhere in it", "", hint, look=look)


def program_of(submission: Submission, package: str, name: str) -> str:
    """Return the path of a program that can be run, within its package. Raises Wrong."""
    package_of(submission, package)
    script = find_script(submission, package, name)
    check_file(submission, package, script)
    return script


def must_be_one_program(folder: Path, name: str) -> list[Path]:
    """Return the programs of that name that rosrun finds: one, or none. Raises Wrong."""
    found = sorted(path for path in folder.rglob(name) if path.is_file())
    runnable = [path for path in found if path.stat().st_mode & 0o100]
    if len(runnable) > 1:
        inside = [str(path.relative_to(folder)) for path in runnable]
        hint = "rosrun asks which one ('You have chosen a non-unique executable'):"
        hint += f" remove all but one {name}"
        raise Wrong(f"one program {name}", f"several: {', '.join(inside)}", inside[1], hint)
    return runnable


def check_file(submission: Submission, package: str, script: str) -> None:
    """Raise Wrong for a program that rosrun does not start, or Python does not read."""
    for wrong in _faults(submission, package, script):  # the first counts
        wrong.look = wrong.look or f"rosrun {submission.task.shown(package)} {Path(script).name}"
        raise wrong


def _faults(submission: Submission, package: str, script: str) -> Iterator[Wrong]:
    path, whole = submission.package(package).folder / script, submission.whole(script, package)
    data, facts = (
        student_files.read(submission.folder, path),
        submission.scripts(package).get(script),
    )
    yield from _faults_of_bytes(data, script, whole)
    line, text = (facts and unreadable(data)) or (0, "")
    if line:
        hint = "save the file as UTF-8 and name no other coding; or name the right one in line 2:"
        hint, look = f"{hint} # coding: latin-1", f"python3 -m py_compile {whole}"
        expected = "a file in UTF-8, or in the coding that its first lines name"
        yield Wrong(expected, text, f"{script}:{line}", hint, look=look)
    if facts and facts.error:
        seen = ": ".join(filter(None, (facts.error, facts.error_text)))
        where = f"{script}:{facts.error_line}"
        hint = explain(facts.error, facts.error_text, whole, "syntax")
        look = f"python3 -m py_compile {whole}"
        yield Wrong("Python that can be read", seen, where, hint, look=look)
    yield from _faults_of_first_line(data, script, whole)
    may_be_run = path.stat().st_mode & 0o100  # or catkin makes it so, in devel
    if not may_be_run and not submission.recording(installed, package, script).installed:
        seen = f"{path.name} is not executable (rosrun: Couldn't find executable)"
        hint, look = f"chmod +x {whole}", f"ls -l {whole}"
        yield Wrong("a program that may be run", seen, script, hint, look=look)
    # Underscores that the PDF shows as gaps and that Python reads all the same.
    if facts and facts.odd_main:
        line, text = facts.odd_main
        hint = "two underscores on either side of name and of main, and no blanks: the PDF shows"
        hint += " gaps"
        yield Wrong("if __name__ == '__main__':", text, f"{script}:{line}", hint)
    kinds = ("Publisher", "Subscriber", "init_node")
    calls = (call for kind in kinds for call in (facts.calls.get(kind, []) if facts else ()))
    for call in (call for call in calls if call.words and " " in call.words[0]):
        seen, right = f"the name {call.words[0]!r} has a space", "_".join(call.words[0].split())
        hint = f"the PDF shows _ as a gap: {right!r}"
        expected = "names of nodes and topics without a space"
        yield Wrong(expected, seen, f"{script}:{call.line}", hint)


def _faults_of_bytes(data: bytes, script: str, whole: str) -> Iterator[Wrong]:
    if not data.strip():
        yield Wrong("a program", "the file is empty", script, "was it saved?")
    if data.startswith((b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")):
        seen, hint = "a byte order mark before them", "save the file as UTF-8 without BOM"
        yield Wrong("#! as the very first two bytes", seen, f"{script}:1", hint)
    if re.match(rb"\s*<(!doctype|html)", data, re.IGNORECASE):
        hint = "the download gave the page and not the file: take the address of the raw file"
        yield Wrong("a Python program", "a web page", script, hint)
    if data.split(b"\n", 1)[0].endswith(b"\r"):  # further down they do no harm
        seen = "the file has Windows line ends (python3\\r: No such file)"
        hint, look = f"sed -i 's/\\r$//' {whole}", f"head -1 {whole} | cat -A"
        yield Wrong("Unix line ends", seen, f"{script}:1", hint, look=look)


def _faults_of_first_line(data: bytes, script: str, whole: str) -> Iterator[Wrong]:
    first, where, look = data.split(b"\n", 1)[0], f"{script}:1", f"head -1 {whole}"
    line = first.decode(errors="replace")[:80]
    if not first.startswith(b"#!"):
        further = "; #! stands further down" if b"\n#!" in data else ""
        hint = "without #! in the very first line the shell tries to run the Python lines itself"
        hint, look = f"{hint} (import: command not found)", f"head -3 {whole}"
        seen = f"the first line is {line!r}{further}"
        yield Wrong(f"{PYTHON3} as the first line", seen, where, hint, look=look)
    found = INTERPRETER.match(first)
    program = found[1].decode(errors="replace") if found else ""
    is_known = program in ("python", "python3") or shutil.which(program)
    if "python" not in program or not is_known:
        hint = f"{PYTHON3}, or #!/usr/bin/python3"
        yield Wrong(f"an interpreter that exists: {PYTHON3}", line, where, hint, look=look)
    if "python2" in program:
        hint = f"ROS here belongs to Python 3: {PYTHON3}"
        yield Wrong("Python 3", line, where, hint, look=look)


def odd_node(submission: Submission, package: str, script: str) -> Note | None:
    """Return a Note on the name of a node of which ROS warns, or None."""
    facts = submission.scripts(package).get(script)
    if not facts or not facts.odd_node:
        return None
    line, name = facts.odd_node
    seen = f"the node is called {name!r}, of which ROS warns: not a legal ROS base name"
    right = re.sub(r"\W", "_", re.sub(r"\.py$", "", name))
    return Note(seen, f"{script}:{line}", f"letters, digits and _ only: {right!r}")


def cause_of(
    submission: Submission, package: str, trace: Traceback, name: str = ""
) -> tuple[str, str]:
    """Return (the line to blame, what to do) for a Traceback of a program, maybe of that name."""
    name = COPY.sub("", name)
    script = next((each for each in submission.scripts(package) if Path(each).name == name), "")
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
    file, hides = hider(trace.error, script, submission.scripts(package))
    if hides:
        return file or f"{script}:{line}", hides
    is_import = re.match("ImportError|ModuleNotFoundError", trace.error)
    if is_import and submission.needs_build() and submission.recording(built).code != 0:
        fails = "catkin_make, which may have to make it, fails: run it, it says why"
        hint = "; ".join(filter(None, (hint, fails)))
    return f"{script}:{line}" if line else "", hint


def crash(
    submission: Submission, package: str, program: Ran, expected: str, hint: str = ""
) -> Wrong:
    """Return the Wrong for a program that ended or failed, with the cause that its output shows."""
    trace = first_traceback(program.output, str(submission.package(package).folder))
    if trace and not (program.was_stopped and trace.error.startswith("KeyboardInterrupt")):
        seen = trace.error + (f"   in: {trace.text}" if trace.text else "")
        place, cause = cause_of(submission, package, trace, program.name)
        return Wrong(expected, seen, place, cause or hint, sure=True)
    if program.code is not None and program.code < 0:
        return Wrong(expected, f"the program was ended by signal {-program.code}", "", hint)
    if program.spins:
        seen = f"{program.name} works all the time and gets nowhere"
        hint = "a loop without end? In the callback, and before rospy.init_node, there is none"
        return Wrong(expected, seen, hint=hint, sure=True)
    seen = "it runs" if program.code is None else f"it ended, exit code {program.code}"
    said = last_lines(program.output)
    seen += f"; it printed: {said}" if said else ", and printed nothing"
    return Wrong(expected, seen, hint=hint)


def check_end(
    submission: Submission, package: str, script: str, taken_s: float | None, output: str
) -> Note | None:
    """Return a Note on how a program ended after Ctrl-C, or None. taken_s: None if killed."""
    name = Path(script).name
    if taken_s is None:
        facts = submission.scripts(package)[script]
        endless = facts.loops if "is_shutdown" not in facts.calls else []
        where = f"{script}:{endless[0]}" if endless else script
        hint = "rospy.spin(), or while not rospy.is_shutdown(): and no `except` that hides the end"
        raise Wrong(f"{name} ends within 3 s of Ctrl-C", "it had to be killed", where, hint)
    trace = first_traceback(output, str(submission.package(package).folder))
    if trace and "ROSInterrupt" in trace.error:
        seen = f"{name} ends with a traceback, ROSInterruptException"
        return Note(seen, trace.where, "except rospy.ROSInterruptException: pass")
    if trace:
        hint = "try: ... except rospy.ROSInterruptException: pass"
        raise Wrong(f"{name} ends without a traceback", trace.error, trace.where, hint)
    return None


def ended(wrong: Wrong, facts: PythonFacts, script: str) -> Wrong:
    """Return the Wrong of a program that ended, with what its text shows if its output does not."""
    if not wrong.where:
        asked = facts.first("Subscriber")
        wrong.seen += f"; it subscribes to {', '.join(asked.words[:2])}" if asked else ""
        wrong.where, hint = silent_end(facts, script)
        wrong.hint = hint if ":" in wrong.where else wrong.hint or hint
    return wrong


def silent_end(facts: PythonFacts, script: str) -> tuple[str, str]:
    """Return (where, hint) for a program that ends at once, as far as its text shows."""
    if facts.keyboard:
        return f"{script}:{facts.keyboard}", explain("EOF when reading a line")
    for line, text in facts.bare_names:
        if text.endswith(("spin", "listener")):
            return f"{script}:{line}", f"{text} needs its (): {text}()"
    for one in (one for one in facts.classes if one.is_node):
        odd = next((each for each in one.methods if re.fullmatch(r"_*init_*", each)), "__init__")
        if odd != "__init__" and "__init__" not in one.methods:
            hint = f"`def {odd}`: Python calls `__init__`, two underscores on either side"
            return f"{script}:{one.line}", hint
        if not one.instantiated:
            hint = f"it is never made: {one.name}() under if __name__ == '__main__':"
            return f"{script}:{one.line}", hint
    if facts.sunken_main:
        line, function = facts.sunken_main
        hint = f"line {line} stands within {function}(): move it, and what is below it, to the left"
        return f"{script}:{line}", f"{hint} margin"
    if "spin" not in facts.calls:
        return script, "rospy.spin() is missing: without it the program comes to its end"
    if not facts.has_main:
        return script, "listener() is never called: if __name__ == '__main__': listener()"
    return script, "is listener() called, in the last line, and with ()?"
