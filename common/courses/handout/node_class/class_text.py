"""The program that is a class: its text, and diagnoses of the text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping

from tutorial_check import (
    ClassFacts,
    Note,
    SourceFacts,
    Submission,
    Wrong,
    check_file,
    find_script,
    first_of,
    with_bases,
)

from ..task import NAME, PACKAGE
from .class_words import ClassWords, words_for

OF_CLASS = re.compile("new|class", re.IGNORECASE)  # in the name of a program


@dataclass(frozen=True)
class ClassProgram:
    """The program to start, and the class in it or in a file that it imports."""

    script: str
    path: str  # of the file with the class
    node: ClassFacts
    scripts: Mapping[str, SourceFacts]  # by path

    @property
    def facts(self) -> SourceFacts:
        return self.scripts[self.path]

    @property
    def words(self) -> ClassWords:
        return words_for(self.facts)

    def at(self, line: int) -> str:
        return self.facts.place(self.path, line)


def _class_of(submission: Submission) -> tuple[str, ClassFacts] | None:
    """Return (path, ClassFacts) of the class that uses ROS; if there are several, the likeliest."""
    scripts, folder = submission.programs(PACKAGE), submission.package(PACKAGE).folder
    owned = [(path, owner) for path, facts in scripts.items() for owner in facts.classes]
    bases = {base.rpartition(".")[2] for _, owner in owned for base in owner.bases}
    whole = zip(owned, with_bases([owner for _, owner in owned]))

    def unlikely(candidate: tuple[str, ClassFacts]) -> tuple[bool | str, ...]:
        """Return a sort key: joy2twist.py may already be a class, and there may be old copies."""
        path, node = candidate
        return (
            node.name in bases,
            not (scripts[path].is_python or node.instantiated),
            not _fits(node.name + path),
            bool(re.search(r"(^|/)(old|backup|copy)[^/]*/", path, re.IGNORECASE)),
            "on_shutdown" not in scripts[path].calls,
            not (folder / path).stat().st_mode & 0o100,
            Path(path).stem == Path(NAME).stem,
            path,
        )

    nodes = [(path, node) for (path, _), node in whole if node.is_node]
    return min(nodes, key=unlikely, default=None)


def _unread_class(scripts: Mapping[str, SourceFacts]) -> tuple[str, ClassFacts] | None:
    """Return the likeliest program in C++ on a machine that cannot read C++."""
    unread = (path for path, facts in scripts.items() if not (facts.is_python or facts.functions))
    for path in (path for path in unread if OF_CLASS.search(path)):
        return path, ClassFacts(Path(path).stem, 0, [], True, True, set(), set())
    return None


def _fits(words: str) -> bool:
    return bool(re.search(r"joy.*twist", words, re.IGNORECASE))


def program(submission: Submission) -> ClassProgram:
    """Return the program that is a class. Raises Wrong if there is none."""
    scripts = submission.programs(PACKAGE)
    likeliest = _class_of(submission) or _unread_class(scripts)
    if not likeliest:
        raise _no_class(submission)
    path, node = likeliest
    file = submission.package(PACKAGE).folder / path
    if not scripts[path].is_python:
        return ClassProgram(path, path, node, scripts)
    if scripts[path].has_main or file.stat().st_mode & 0o100 or "src/" not in path:
        return ClassProgram(path, path, node, scripts)
    stem = Path(path).stem
    users = (p for p, f in scripts.items() if any(stem in word.split(".") for word in f.imports))
    return ClassProgram(next(users, path), path, node, scripts)


def _no_class(submission: Submission) -> Wrong:
    scripts, names = submission.programs(PACKAGE), submission.task.names
    for path in (path for path, facts in scripts.items() if facts.error and _fits(path)):
        check_file(submission, PACKAGE, path)
    stems = {path.stem for path in submission.cpp_sources(PACKAGE)}
    for stem in sorted(stems - {Path(path).stem for path in scripts}):
        if OF_CLASS.search(stem):
            find_script(submission, PACKAGE, f"{stem}.py")
    named = [path for path in scripts if OF_CLASS.search(path)]
    expected = f"a class that subscribes to {names.joy} and publishes on {names.cmd_vel}"
    hint = words_for([SourceFacts(), *scripts.values()][-1]).class_parts
    return Wrong(expected, f"no class in any program of {names.package}", "".join(named[:1]), hint)


def no_init(made: ClassProgram) -> Wrong | None:
    node = made.node
    odd = [name for name in node.methods if re.fullmatch(r"_*init_*", name)]
    if "__init__" in odd or (node.bases and not odd):
        return None
    seen = f"`def {odd[0]}`: Python calls `__init__`" if odd else f"{node.name} has no __init__"
    hint = "def __init__(self): with two underscores on either side"
    return Wrong(made.words.is_class, seen, made.at(node.line), hint)


def never_made(made: ClassProgram) -> Wrong | None:
    node, words = made.node, made.words
    is_called = any(node.name in facts.calls for facts in made.scripts.values())
    if node.instantiated or made.script != made.path or (is_called and made.facts.is_python):
        return None
    bare = [(line, text) for line, text in made.facts.bare_names if text == node.name]
    line, text = node.unmade or next(iter(bare), (node.line, ""))
    seen = f"{node.name} is never created"
    seen += f": `{text}` makes no object that lasts" if node.unmade else ""
    return Wrong(words.is_class, seen, made.at(line), words.makes_object.format(name=node.name))


@dataclass(frozen=True)
class GivenFunction:
    """An argument of a ROS call that takes a function."""

    made: ClassProgram
    call: str  # on_shutdown or Subscriber
    line: int
    word: str

    @property
    def name(self) -> str:
        """The last part of the argument."""
        return self.word.rsplit(".", 1)[-1]

    def wrong(self, seen: str, hint: str) -> Wrong:
        receiver = "the Subscriber" if self.call == "Subscriber" else "rospy.on_shutdown"
        return Wrong(f"{receiver} gets a method of the object", seen, self.made.at(self.line), hint)


def method_without_self(given: GivenFunction) -> Wrong | None:
    word = given.word
    if given.call != "Subscriber" or word not in given.made.node.methods:
        return None
    return given.wrong(f"{word} alone: in a class this name is not known", f"self.{word}")


def called_at_once(given: GivenFunction) -> Wrong | None:
    is_called = given.name[-2:] == "()" and given.name[:-2] in given.made.facts.functions
    hint = f"without (): {given.word[:-2]}"
    return given.wrong(f"{given.word} is called at once", hint) if is_called else None


def no_method(given: GivenFunction) -> Wrong | None:
    name, facts = given.name, given.made.facts
    owners = (name in {*c.methods, *c.attributes} or c.bases for c in facts.classes)
    if given.word != f"self.{name}" or name[-2:] == "()" or any(owners):
        return None
    line = facts.functions.get(name)
    if line:
        hint = "indent it like `def __init__`: neither further, nor less"
        return given.wrong(f"`def {name}` in line {line} is no method of the class", hint)
    hint = f"one name: def {name}(self), or one of {', '.join(given.made.node.methods)}"
    return given.wrong(f"the class has no {name}", hint)


def odd_method(made: ClassProgram) -> Wrong | None:
    """Find an argument for ROS that should be a method, and is not."""
    words = [("on_shutdown", *word) for word in made.facts.given("on_shutdown", 0)]
    words += [("Subscriber", *word) for word in made.facts.given("Subscriber", 2)]
    diagnoses = (method_without_self, called_at_once, no_method)
    wrongs = (first_of(diagnoses, GivenFunction(made, *word)) for word in words)
    return next(filter(None, wrongs), None)


def shares_by_global(made: ClassProgram) -> Note | None:
    lines = made.facts.globals
    return Note(made.words.shares, made.at(lines[0])) if lines else None


def early_shutdown(made: ClassProgram) -> Note | None:
    early, publisher = map(made.facts.first, ("on_shutdown", "Publisher"))
    if not early or not publisher or early.line >= publisher.line:
        return None
    seen = "on_shutdown comes before the publisher: a Ctrl-C in between has none"
    seen += " to stop the robot with (the handout has it so)"
    return Note(seen, made.at(early.line), "first the Publisher, then rospy.on_shutdown")


PYTHON_DIAGNOSES = (no_init, never_made, odd_method, shares_by_global, early_shutdown)
CPP_DIAGNOSES = (never_made, shares_by_global)
