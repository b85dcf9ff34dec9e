"""Why rosrun cannot start a program, or Python cannot read it."""

from __future__ import annotations

import re
import shutil

from tutorial_check.checking.causes import explain
from tutorial_check.checking.cpp_programs import must_be_built
from tutorial_check.checking.package_files import Script
from tutorial_check.checking.results import Wrong, first_of
from tutorial_check.checking.submission import Submission
from tutorial_check.data.recorders import INSTALLED
from tutorial_check.submission import student_files
from tutorial_check.submission.cpp_sources import CPP_ENDINGS
from tutorial_check.submission.python_text import unreadable

# env -S takes arguments.
INTERPRETER = re.compile(rb"#!\s*(?:\S*/env\s+(?:-S\s*)?(?:\w+=\S*\s+)*)?(\S+)")
PYTHON3 = "#!/usr/bin/env python3"


class ScriptFile(Script):
    """A program, with the bytes of its file."""

    def __init__(self, submission: Submission, package: str, path: str) -> None:
        super().__init__(submission, package, path)
        self.path = submission.package(package).folder / path
        self.data = student_files.read(submission.folder, self.path)
        self.whole = submission.whole(path, package)  # for a shell
        self.first = self.data.split(b"\n", 1)[0]
        self.first_line = self.first.decode(errors="replace")[:80]
        interpreter = INTERPRETER.match(self.first)
        self.interpreter = interpreter[1].decode(errors="replace") if interpreter else ""


def check_file(submission: Submission, package: str, script: str) -> None:
    """Raise Wrong for a program that rosrun cannot start, or its language cannot read."""
    if script.endswith(CPP_ENDINGS):
        must_be_built(submission, package, script)
        return
    file = ScriptFile(submission, package, script)
    wrong = first_of(FAULTS, file)
    if wrong:
        wrong.look = wrong.look or f"rosrun {submission.task.in_messages(package)} {file.name}"
        raise wrong


def empty(file: ScriptFile) -> Wrong | None:
    if file.data.strip():
        return None
    return Wrong("a program", "the file is empty", file.where, "was it saved?")


def byte_order_mark(file: ScriptFile) -> Wrong | None:
    if not file.data.startswith((b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff")):
        return None
    seen, hint = "a byte order mark before them", "save the file as UTF-8 without BOM"
    return Wrong("#! as the very first two bytes", seen, file.at_line(1), hint)


def web_page(file: ScriptFile) -> Wrong | None:
    if not re.match(rb"\s*<(!doctype|html)", file.data, re.IGNORECASE):
        return None
    hint = "the download is the page, not the file: use the address of the raw file"
    return Wrong("a Python program", "a web page", file.where, hint)


def windows_line_ends(file: ScriptFile) -> Wrong | None:
    if not file.first.endswith(b"\r"):  # harmless further down
        return None
    seen = "the file has Windows line endings (python3\\r: No such file)"
    hint, look = f"sed -i 's/\\r$//' {file.whole}", f"head -1 {file.whole} | cat -A"
    return Wrong("Unix line endings", seen, file.at_line(1), hint, look=look)


def other_coding(file: ScriptFile) -> Wrong | None:
    line, seen = (file.is_python and unreadable(file.data)) or (0, "")
    if not line:
        return None
    hint = "save the file as UTF-8 and declare no encoding, or declare the right one in line 2:"
    hint, look = f"{hint} # coding: latin-1", f"python3 -m py_compile {file.whole}"
    expected = "a file in UTF-8, or in the encoding that its first lines declare"
    return Wrong(expected, seen, file.at_line(line), hint, look=look)


def no_python(file: ScriptFile) -> Wrong | None:
    facts = file.facts
    if not facts.error:
        return None
    seen = ": ".join(filter(None, (facts.error, facts.error_text)))
    where, look = f"{file.where}:{facts.error_line}", f"python3 -m py_compile {file.whole}"
    hint = explain(facts.error, facts.error_text, file.whole, "syntax")
    return Wrong("Python that can be read", seen, where, hint, look=look)


def no_interpreter(file: ScriptFile) -> Wrong | None:
    if file.first.startswith(b"#!"):
        return None
    further = "; #! is further down" if b"\n#!" in file.data else ""
    seen = f"the first line is {file.first_line!r}{further}"
    hint = "without #! in the very first line the shell tries to run the Python lines itself"
    hint, look = f"{hint} (import: command not found)", f"head -3 {file.whole}"
    return Wrong(f"{PYTHON3} as the first line", seen, file.at_line(1), hint, look=look)


def unknown_interpreter(file: ScriptFile) -> Wrong | None:
    is_known = file.interpreter in ("python", "python3") or shutil.which(file.interpreter)
    if "python" in file.interpreter and is_known:
        return None
    expected, hint = f"an interpreter that exists: {PYTHON3}", f"{PYTHON3}, or #!/usr/bin/python3"
    look = f"head -1 {file.whole}"
    return Wrong(expected, file.first_line, file.at_line(1), hint, look=look)


def python2(file: ScriptFile) -> Wrong | None:
    if "python2" not in file.interpreter:
        return None
    hint, look = f"ROS here belongs to Python 3: {PYTHON3}", f"head -1 {file.whole}"
    return Wrong("Python 3", file.first_line, file.at_line(1), hint, look=look)


def not_executable(file: ScriptFile) -> Wrong | None:
    may_be_run = file.path.stat().st_mode & 0o100  # or catkin makes a copy executable, in devel
    if may_be_run or file.submission.recording(INSTALLED, file.package, file.where).installed:
        return None
    seen = f"{file.name} is not executable (rosrun: Couldn't find executable)"
    hint, look = f"chmod +x {file.whole}", f"ls -l {file.whole}"
    return Wrong("an executable program", seen, file.where, hint, look=look)


def odd_main(file: ScriptFile) -> Wrong | None:
    """Find a __main__ test without its underscores, which the PDF shows as gaps."""
    line, seen = file.facts.odd_main or (0, "")
    if not line:
        return None
    hint = "two underscores on either side of name and of main, and no blanks: the PDF shows gaps"
    return Wrong("if __name__ == '__main__':", seen, file.at_line(line), hint)


def name_with_a_space(file: ScriptFile) -> Wrong | None:
    kinds = ("Publisher", "Subscriber", "init_node")
    calls = (call for kind in kinds for call in file.facts.calls.get(kind, []) if call.words)
    for call in (call for call in calls if " " in call.words[0]):
        seen, right = f"the name {call.words[0]!r} has a space", "_".join(call.words[0].split())
        expected = "names of nodes and topics without a space"
        hint = f"the PDF shows _ as a gap: {right!r}"
        return Wrong(expected, seen, file.at_line(call.line), hint)
    return None


FAULTS = (
    empty, byte_order_mark, web_page, windows_line_ends, other_coding, no_python, no_interpreter,
    unknown_interpreter, python2, not_executable, odd_main, name_with_a_space,
)  # fmt: skip
