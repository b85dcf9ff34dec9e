"""C29, C30 and C33: the program as a class."""

from __future__ import annotations

import re
from pathlib import Path

from tutorial_check.course import check
from tutorial_check.handout.changed_programs import without_name
from tutorial_check.handout.s4_3 import diagnoses
from tutorial_check.handout.s4_3.judge import NAME, check_manifest
from tutorial_check.handout.s4_3.record import drive
from tutorial_check.handout.s6_2.record import alone
from tutorial_check.handout.task import PACKAGE
from tutorial_check.judge.rows import Row, demand
from tutorial_check.judge.scripts import check_file, misnamed_init, must_be_one
from tutorial_check.model import Note, Wrong
from tutorial_check.record.session import Session
from tutorial_check.source.python_facts import Call, ClassFacts, with_bases
from tutorial_check.source.tracebacks import last_lines

NAMES_IT = re.compile(r"not defined|NameError")  # what the lack of the import leads to
REPORTS = re.compile(r"Traceback|Error\b|Exception|not defined|exceeded|\[(?:ERROR|FATAL|WARN)\]")


def _class_files(session: Session) -> dict[str, ClassFacts]:
    """Return {path: ClassFacts} of the classes that deal with ROS; of several the likeliest first."""
    scripts = session.scripts(PACKAGE)
    owned = [(path, one) for path, facts in scripts.items() for one in facts.classes]
    bases = {base.rpartition(".")[2] for _, one in owned for base in one.bases}
    found: dict[str, ClassFacts] = {}
    for (path, _), one in zip(owned, with_bases([one for _, one in owned])):
        better = path not in found or (found[path].name in bases and one.name not in bases)
        if one.is_node and better and "checked_" not in path:
            found[path] = one
    folder = session.package(PACKAGE).folder

    def unlikely(path: str) -> tuple[bool | str, ...]:
        """Return a sort key: the step before, joy2twist.py, may be a class already; and there are old copies."""
        return (
            found[path].name in bases,
            not _fits(found[path].name + path),
            bool(re.search(r"(^|/)(old|backup|copy)[^/]*/", path, re.IGNORECASE)),
            "on_shutdown" not in scripts[path].calls,
            not (folder / path).stat().st_mode & 0o100,
            Path(path).name == NAME,
            path,
        )

    return {path: found[path] for path in sorted(found, key=unlikely)}


def _fits(words: str) -> bool:
    return bool(re.search(r"joy.*twist", words, re.IGNORECASE))


def program(session: Session) -> tuple[str, str, ClassFacts]:
    """Return (the program to start, the file with the class, its ClassFacts). Raises Wrong."""
    scripts, files = session.scripts(PACKAGE), _class_files(session)
    if not files:
        for path in (path for path, facts in scripts.items() if facts.error and _fits(path)):
            check_file(session, PACKAGE, path)
        named = [path for path in scripts if re.search(r"new|class", path, re.IGNORECASE)]
        names = session.task.names
        expected = f"a class that subscribes to {names.joy} and publishes on {names.cmd_vel}"
        hint = "class NewJoy2Twist: with __init__(self), callback(self, data), shutdown(self)"
        seen = f"no class in any program of {names.package}"
        raise Wrong(expected, seen, next(iter(named), ""), hint)
    path, one = next(iter(files.items()))
    file = session.package(PACKAGE).folder / path
    if scripts[path].has_main or file.stat().st_mode & 0o100 or "src/" not in path:
        return path, path, one
    stem = Path(path).stem
    users = (p for p, f in scripts.items() if any(stem in word.split(".") for word in f.imports))
    return next(users, path), path, one


class Form:
    """A class beside its program: the facts of the rows below."""

    def __init__(self, session: Session, script: str, path: str, one: ClassFacts) -> None:
        self.path, self.one = path, one
        self.facts = session.scripts(PACKAGE)[path]
        self.where = f"{path}:{one.line}"
        others = session.scripts(PACKAGE).values()
        is_made = one.instantiated or any(one.name in each.calls for each in others)
        self.is_made = is_made or script != path
        self.methods = ", ".join(one.methods)

    @property
    def odd_init(self) -> str:
        """What was meant to be __init__, or "no __init__"; empty if there is one, maybe of a base."""
        if "__init__" in self.one.methods:
            return ""
        odd = misnamed_init(self.one.methods)
        if odd:
            return f"`def {odd}`: Python calls `__init__`"
        return "" if self.one.bases else f"{self.one.name} has no __init__"

    @property
    def place_of_name(self) -> str:
        """Where its name stands alone, without (), or else the class."""
        bare = (line for line, text in self.facts.bare_names if text == self.one.name)
        return next((f"{self.path}:{line}" for line in bare), self.where)

    @property
    def early(self) -> int:
        """The line of an on_shutdown before the Publisher, or 0."""
        early, made = map(self.facts.first, ("on_shutdown", "Publisher"))
        return early.line if early and made and early.line < made.line else 0


class Given:
    """What ROS is given in place of a method."""

    def __init__(self, form: Form, call: Call, taker: str) -> None:
        self.form, self.taker = form, taker
        word = call.words[0] if call.words else ""
        if taker == "the Subscriber":
            word = call.words[2] if len(call.words) > 2 else call.names.get("callback", "")
        self.word, self.name = word, word.rsplit(".", 1)[-1]
        self.without = word[:-2]
        self.where = f"{form.path}:{call.line}"
        self.line = form.facts.functions.get(self.name, 0)

    @property
    def is_called(self) -> bool:
        return self.name.endswith("()") and self.name[:-2] in self.form.facts.functions

    @property
    def is_unknown(self) -> bool:
        """Return whether the object has no such method, as far as the text shows."""
        classes = self.form.facts.classes
        known = any(self.name in {*one.methods, *one.attributes} or one.bases for one in classes)
        return self.word == f"self.{self.name}" and not self.name.endswith("()") and not known


EXPECTED = "a class with __init__, its callback bound to self, made under __main__"
FORM = (
    Row(lambda f: f.odd_init, "{found}", "def __init__(self): with two underscores on either side",
        "{f.where}"),
    Row(lambda f: not f.is_made, "{f.one.name} is never made",
        "{f.one.name}() with (), under if __name__ == '__main__':", "{f.place_of_name}"),
)  # fmt: skip
METHODS = (
    Row(lambda g: g.taker == "the Subscriber" and g.word in g.form.one.methods,
        "{f.word} alone: within a class that is no name", "self.{f.word}", "{f.where}"),
    Row(lambda g: g.is_called, "{f.word} is called at once", "without (): {f.without}",
        "{f.where}"),
    Row(lambda g: g.is_unknown and g.line, "`def {f.name}` in line {found} is no method of the class",
        "indent it like `def __init__`: neither further, nor less", "{f.where}"),
    Row(lambda g: g.is_unknown, "the class has no {f.name}",
        "one name: def {f.name}(self), or one of {f.form.methods}", "{f.where}"),
)  # fmt: skip
RIGHT_FORM = (
    Row(lambda f: f.facts.globals, "a class needs no `global`: self. keeps what its methods share",
        "", "{f.path}:{found[0]}", note=True),
    Row(lambda f: f.early,
        "on_shutdown comes before the publisher: a Ctrl-C in between finds none to stop the robot"
        " with (the handout has it so)", "first the Publisher, then rospy.on_shutdown",
        "{f.path}:{found}", note=True),
)  # fmt: skip


@check("C29", "the program is a class", "6.2", "C12", look="rosrun {n.package} THE_CLASS",
       timeless=True)  # fmt: skip
def is_class(session: Session) -> Note | str | None:
    script, path, one = program(session)
    must_be_one(session.package(PACKAGE).folder, Path(script).name)
    check_file(session, PACKAGE, script)
    check_manifest(session, script)
    form = Form(session, script, path, one)
    demand(FORM, form, EXPECTED)
    for name, taker in (("on_shutdown", "rospy.on_shutdown"), ("Subscriber", "the Subscriber")):
        for call in form.facts.calls.get(name, []):
            demand(METHODS, Given(form, call, taker), f"{taker} gets a method of the object")
    return demand(RIGHT_FORM, form, EXPECTED) or f"{one.name} in {path}"


@check(
    "C30", "the class does what the functions did", "6.2", "C29", look="rostopic echo {n.cmd_vel}"
)
def behaves(session: Session) -> Note | str | None:
    script, _, _ = program(session)
    seen = session.recording(drive, script)
    notes = [
        diagnoses.check_displays(session, seen, few_are_enough=True),
        diagnoses.check_topics(session, seen),
        diagnoses.check_mapping(session, seen),
        diagnoses.check_rate(session, seen),
    ]
    return next((note for note in notes if isinstance(note, Note)), None)


@check("C33", "its errors are seen", "6.2", "C30",
       look="rosrun {n.package} THE_CLASS, without a joystick")  # fmt: skip
def errors_are_seen(session: Session) -> Note | str | None:
    script, path, _ = program(session)
    text = without_name(session.text(PACKAGE, script), "Joy")
    seen = session.recording(alone, script, text or "")
    excepts = session.scripts(PACKAGE)[path].broad_excepts
    where = f"{path}:{excepts[0].lineno}" if excepts else path
    output = seen.program.output
    if seen.ended and not REPORTS.search(output):
        words = f"nobody publishes on {session.task.names.joy}, and it ends; it printed: "
        words += last_lines(output) or "nothing"
        hint = "a Subscriber waits by itself, for as long as it takes; what an except catches, it should show"
        expected = "without a joystick it waits for one, or says what it misses"
        raise Wrong(expected, words, where, hint)
    if not NAMES_IT.search(seen.broken.output) if seen.broken and seen.broken_ended else excepts:
        words = "except: hides every mistake, a misspelt name as well as Ctrl-C"
        return Note(words, where, "except rospy.ROSInterruptException:")
    if seen.ended:
        return Note(f"without a joystick it ends: {last_lines(output, 1)}", where)
    return None
