"""What every program must be before it can run: C5 and C13."""

import difflib
import re
import shutil
from pathlib import Path

from tutorial_check.causes import explain, hider, syntax_hint, traced
from tutorial_check.model import Note, Wrong
from tutorial_check.python_facts import read_python
from tutorial_check.python_text import unreadable
from tutorial_check.tracebacks import first_traceback, last_lines

INTERPRETER = re.compile(
    rb"#!\s*(\S+)(?:\s+(?:-S\s*)?(?:\w+=\S*\s+)*(\S+))?"
)  # env -S takes arguments


def _wrong(look, *about):
    """A Wrong with a command of its own to see it."""
    wrong = Wrong(*about)
    wrong.look = look
    return wrong


def find_script(session, package, name):
    """The path of a program within its package. Raises Wrong."""
    folder = session.package(package).folder
    found = [path for path in folder.rglob("*") if path.name in (name, name[:-3])]
    # One without .py counts where there is none with it.
    found = sorted(filter(Path.is_file, found), key=lambda path: (path.name != name, path))
    runnable = must_be_one(folder, name)
    if found:
        return str((runnable or found)[0].relative_to(folder))
    others = {
        path.name: path
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != "CMakeLists.txt"
    }
    near = [other for other in others if other.lower().startswith(name) or other.lower() == name]
    # new_joy2twist.py is another program, and no misspelt joy2twist.py.
    near = near or difflib.get_close_matches(name, [o for o in others if name not in o], 1, 0.75)
    if near:
        raise Wrong(
            f"a program {name}",
            f"a file {near[0]}",
            where=str(others[near[0]].relative_to(folder)),
            hint=f"mv {session.whole(others[near[0]], package)}"
            f" {session.whole(others[near[0]].with_name(name), package)}: capitals, underscores and the ending count",
        )
    raise _wrong(
        f"ls {session.whole('scripts', package)}",
        f"a program {name} in the package {package}",
        "no such file anywhere in it",
        "",
        f"create scripts/{name} in YOUR package; ./tutorial shell without --in has one of OURS",
    )


def must_be_one(folder, name):
    """The programs of that name that rosrun would find in a package: one, or none. Raises Wrong."""
    found = sorted(path for path in folder.rglob(name) if path.is_file())
    runnable = [path for path in found if path.stat().st_mode & 0o100]
    if len(runnable) > 1:
        raise Wrong(
            f"one program {name}",
            "several: " + ", ".join(str(path.relative_to(folder)) for path in runnable),
            where=str(runnable[1].relative_to(folder)),
            hint=f"rosrun asks which one ('You have chosen a non-unique executable'): remove all but one {name}",
        )
    return runnable


def check_file(session, package, script):
    """What can be said of a program without running it. Raises Wrong."""
    try:
        _check_text(session, package, script)
    except Wrong as wrong:
        wrong.look = wrong.look or f"rosrun {package} {Path(script).name}"
        raise


def _check_text(session, package, script):
    path, whole = session.package(package).folder / script, session.whole(script, package)
    name = path.name
    data = path.read_bytes()
    if not data.strip():
        raise Wrong("a program", "the file is empty", where=script, hint="was it saved?")
    if data.startswith((b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")):
        raise Wrong(
            "#! as the very first two bytes",
            "a byte order mark before them",
            where=f"{script}:1",
            hint="save the file as UTF-8 without BOM",
        )
    if re.match(rb"\s*<(!doctype|html)", data, re.IGNORECASE):
        raise Wrong(
            "a Python program",
            "a web page",
            where=script,
            hint="the download gave the page and not the file: take the address of the raw file",
        )
    first = data.split(b"\n", 1)[0]
    if first.endswith(b"\r"):  # further down they do no harm
        raise _wrong(
            f"head -1 {whole} | cat -A",
            "Unix line ends",
            "the file has Windows line ends (python3\\r: No such file)",
            f"{script}:1",
            f"sed -i 's/\\r$//' {whole}",
        )
    facts = session.scripts(package).get(script)
    odd = unreadable(data) if facts else None
    if odd:
        raise _wrong(
            f"python3 -m py_compile {whole}",
            "a file in UTF-8, or in the coding that its first lines name",
            odd[1],
            f"{script}:{odd[0]}",
            "save the file as UTF-8 and name no other coding; or name the right one in line 2: # coding: latin-1",
        )
    if facts and facts.error:
        raise _wrong(
            f"python3 -m py_compile {whole}",
            "Python that can be read",
            f"{facts.error}: {facts.error_text}",
            f"{script}:{facts.error_line}",
            syntax_hint(facts.error, facts.error_text),
        )
    if not first.startswith(b"#!"):
        later = b"\n#!" in data
        raise _wrong(
            f"head -3 {whole}",
            "#!/usr/bin/env python3 as the first line",
            "it stands further down"
            if later
            else f"the first line is {first.decode(errors='replace')[:60]!r}",
            f"{script}:1",
            "without #! in the very first line the shell tries to run the Python lines itself (import: command not found)",
        )
    try:
        _check_interpreter(first, script)
    except Wrong as wrong:
        wrong.look = f"head -1 {whole}"
        raise
    if not is_runnable(session, package, path):
        raise _wrong(
            f"ls -l {whole}",
            "a program that may be run",
            f"{name} is not executable (rosrun: Couldn't find executable)",
            script,
            f"chmod +x {whole}",
        )
    if facts:
        _check_gaps(facts, script)


def is_runnable(session, package, path):
    """Whether rosrun takes a program: it may be run, or catkin has made one of it in devel."""
    may_be_run = path.stat().st_mode & 0o100
    return bool(may_be_run) or session.command(package, path) != [str(path)]


def odd_node(session, package, script):
    """A Note on the name of a node of which ROS warns; None if there is none."""
    facts = session.scripts(package).get(script)
    if not facts or not facts.odd_node:
        return None
    line, name = facts.odd_node
    return Note(
        f"the node is called {name!r}, of which ROS warns: not a legal ROS base name",
        f"{script}:{line}",
        "letters, digits and _ only: " + repr(re.sub(r"\W", "_", re.sub(r"\.py$", "", name))),
    )


def _check_gaps(facts, script):
    """Underscores that the PDF shows as gaps and that Python reads all the same. Raises Wrong."""
    if facts.odd_main:
        line, text = facts.odd_main
        raise Wrong(
            "if __name__ == '__main__':",
            text,
            where=f"{script}:{line}",
            hint="two underscores on either side of name and of main, and no blanks: the PDF shows gaps",
        )
    for call in [
        each
        for kind in ("Publisher", "Subscriber", "init_node")
        for each in facts.calls.get(kind, [])
    ]:
        name = call.words[0] if call.words else ""
        if " " in name:
            raise Wrong(
                "names of nodes and topics without a space",
                f"the name {name!r} has a space",
                where=f"{script}:{call.line}",
                hint=f"the PDF shows _ as a gap: {'_'.join(name.split())!r}",
            )


def _check_interpreter(first, script):
    found = INTERPRETER.match(first)
    program = found[1].decode(errors="replace") if found else ""
    if program.endswith("/env") and found[2]:
        program = found[2].decode(errors="replace")
    known = program in ("python", "python3") or (program and shutil.which(program))
    if not known or "python" not in program:
        raise Wrong(
            "an interpreter that exists: #!/usr/bin/env python3",
            first.decode(errors="replace")[:80],
            where=f"{script}:1",
            hint="#!/usr/bin/env python3, or #!/usr/bin/python3",
        )
    if re.search(r"python2", program):
        raise Wrong(
            "Python 3",
            first.decode(errors="replace"),
            where=f"{script}:1",
            hint="ROS here belongs to Python 3: #!/usr/bin/env python3",
        )


def cause_of(session, package, name, trace):
    """(the line that is to blame, what to do) for a Traceback of the program of that name."""
    name = re.sub(r"^checked_\d+_", "", name)
    script = next((each for each in session.scripts(package) if Path(each).name == name), "")
    script = trace.where.rpartition(":")[0] or script
    if not script:
        return trace.where, explain(trace.error, trace.text)
    facts = read_python(session.text(package, script))
    function = re.search(r"(\w+)\(\) (?:takes|missing)", trace.error)
    line = int(trace.where.rpartition(":")[2] or 0)
    if not line and function:  # called by rospy itself
        line = facts.names.get(function[1], 0)
    line, hint = traced(trace.error, line, facts)
    hint = hint or explain(trace.error, trace.text)
    file, hides = hider(trace.error, script, session.scripts(package))
    if hides:
        return file or f"{script}:{line}", hides
    if re.match("ImportError|ModuleNotFoundError", trace.error) and session.lacks_build:
        fails = "catkin_make, which may have to make it, fails: exercise 2 says why"
        hint = f"{hint}; {fails}" if hint else fails
    return f"{script}:{line}" if line else "", hint


def crash(session, package, program, what, default_hint=""):
    """The Wrong for a program that ended or failed, with the cause as far as its output tells."""
    trace = first_traceback(program.output, str(session.package(package).folder))
    if trace and not (program.was_stopped and trace.error.startswith("KeyboardInterrupt")):
        seen = trace.error + (f"   in: {trace.text}" if trace.text else "")
        place, hint = cause_of(session, package, program.name, trace)
        return Wrong(what, seen, where=place, hint=hint or default_hint, sure=True)
    has_ended = program.ended and not program.was_stopped
    if has_ended and program.process.returncode is not None and program.process.returncode < 0:
        return Wrong(
            what,
            f"the program was ended by signal {-program.process.returncode}",
            hint=default_hint,
        )
    if program.spins:
        hint = "a loop without end? In the callback, and before rospy.init_node, there is none"
        seen = f"{program.name} works all the time and gets nowhere"
        return Wrong(what, seen, hint=hint, sure=True)
    said = last_lines(program.output)
    ended = f"it ended at once, exit code {program.process.returncode}" if has_ended else "it runs"
    return Wrong(
        what, f"{ended}; it said: {said}" if said else f"{ended}, without a word", hint=default_hint
    )


def check_end(session, package, script, taken_s, output):
    """A Note on how a program ended after Ctrl-C, or None; taken_s: how long that took, None: it had to be killed."""
    name = Path(script).name
    if taken_s is None:
        facts = session.scripts(package)[script]
        endless = facts.loops if "is_shutdown" not in facts.calls else []
        raise Wrong(
            f"{name} ends within 3 s of Ctrl-C",
            "it had to be killed",
            where=f"{script}:{endless[0]}" if endless else script,
            hint="rospy.spin(), or while not rospy.is_shutdown(): and no `except` that swallows the end",
        )
    trace = first_traceback(output, str(session.package(package).folder))
    if trace and "ROSInterrupt" in trace.error:
        return Note(
            f"{name} ends with a traceback, ROSInterruptException",
            trace.where,
            "except rospy.ROSInterruptException: pass",
        )
    if trace:
        raise Wrong(
            f"{name} ends without a traceback",
            trace.error,
            where=trace.where,
            hint="try: ... except rospy.ROSInterruptException: pass",
        )
    return None
