"""The usual cause of an error, and its fix; the package that provides what is missing."""

from __future__ import annotations

import difflib
import fnmatch
import re
from pathlib import Path
from typing import Collection, Iterable

import yaml

from tutorial_check.submission.idioms import HOMES
from tutorial_check.submission.source_facts import SourceFacts

FILE = Path(__file__).with_suffix(".txt")
TABLES: dict[str, str] = yaml.safe_load(FILE.with_name("debian_packages.yaml").read_text())
MODULES, DEV_PACKAGES = TABLES["MODULES"], TABLES["DEV_PACKAGES"]
OTHER_MODULES, OTHER_PACKAGES = TABLES["OTHER_MODULES"], TABLES["OTHER_PACKAGES"]
LACKING = {name for row in TABLES["LACKING"].splitlines() for name in row.partition(":")[0].split()}
UNDEFINED = r"name '(\w+)' is not defined"
NO_VECTOR = r"'(?:float|int)' object has no attribute '[xyz]'"  # where a vector is needed
ROW = re.compile(r"((?:\S.*\n)+)((?: .*\n)+)")  # of causes.txt: patterns, and their explanation
# A name refers to another module than the student means.
NOT_MEANT = re.compile(
    r"module '(\w+)[\w.]*' has no attribute|from (?:partially initialized module )?'(\w+)[\w.]*'"
    r"|'(\w+)' is not a package"
)
# Modules that the student may mean by a missing one.
COMMON = [*MODULES.split(), *HOMES.values(), "nav_msgs", "rospy", "roslib", "math", "time", "numpy"]


def _table() -> dict[str, list[tuple[str, list[str]]]]:
    """Return {section: [(pattern, explanation)]} of causes.txt."""
    text = FILE.read_text(encoding="utf-8").replace("MESSAGE", "|".join(HOMES))
    parts = (part.partition("\n") for part in text.strip().split("\n\n")[1:])
    return {
        head[1 : head.index("]")]: [
            (pattern, re.findall(r"\S.*", words))
            for patterns, words in ROW.findall(f"{rows}\n")
            for pattern in patterns.splitlines()
        ]
        for head, _, rows in parts
    }


TABLE = _table()


def explained(section: str, text: str, file: str = "") -> list[str]:
    """Return the explanation of a section's first pattern that matches; empty if none does."""
    for pattern, words in TABLE[section]:
        match = re.search(pattern, text)
        if match:
            about = {name: value for name, value in match.groupdict().items() if value}
            home = HOMES.get(about.get("m", ""))
            return [word.format(home=home, file=file, **about) for word in words]
    return []


def meant(name: str, known: Iterable[str], likeness: float, words: str = "is {} meant?") -> str:
    """Return words with the known name that is most like this one; empty if none is like it."""
    near = difflib.get_close_matches(name, known, 1, likeness)
    return words.replace("{}", near[0]) if near else ""


def explain(error: str, text: str = "", file: str = "FILE", section: str = "python") -> str:
    """Return the usual cause of an error in a line of a file, or "". section: python or syntax."""
    both = f"{error}\n{text}"
    hint = "".join(explained("python2", both, file) or explained(section, both))
    missing = re.search(r"No module named '([^'.]+)'", error)
    if hint or not missing:
        return hint
    module = missing[1]
    hint = meant(module, COMMON, 0.75, f"there is no module {module}: is {{}} meant?")
    other = f"there is no {module} here: hand in your own file with the program, or install it"
    return advice(module, package_of_module(module)) or hint or other


def with_import(line: str, message: str, facts: SourceFacts) -> str:
    """Return a line to write, and the message's import if the program lacks it."""
    home, lacks = HOMES[message], message not in facts.names
    if not facts.is_python:
        lacks = bool(facts.imports) and f"{home}/{message}.h" not in facts.imports
    return f"{line}, and at the top: {facts.idioms.imported(message)}" if lacks else line


def traced(error: str, line: int, facts: SourceFacts) -> tuple[int, str]:
    """Return (line to blame, fix) as far as the text shows them. line: of the error, or 0."""
    for name, (place, value) in facts.attributes.items():
        part = {"linear": "x", "angular": "z"}.get(name.rpartition(".")[2])
        if part and not value.endswith("()") and re.search(NO_VECTOR, error):
            return place, f"{name} has three parts: {name}.{part} = ..."
    undefined = re.search(UNDEFINED, error)
    if not undefined:
        return line, ""
    name, known = undefined[1], facts.names
    if name in facts.inner_names and line in facts.loose:
        return line, f"this line is outside of {facts.loose[line]}: indent it like the lines in it"
    if f"self.{name}" in facts.attributes:
        return line, f"in a class, write self.{name}"
    for near in difflib.get_close_matches(name, known, 3, 0.6):
        if name not in known and name not in HOMES and near[0].lower() == name[0].lower():
            return line, f"{near} in line {known[near]}, {name} here: one name for one thing"
    return line, ""


def hider(error: str, script: str, others: Collection[str]) -> tuple[str, str]:
    """Return (file, fix) if a file beside the script hides a package; else ("", "")."""
    match = NOT_MEANT.search(error)
    name = next(filter(None, match.groups()), "") if match else ""
    beside = f"{script.rpartition('/')[0]}/{name}.py".lstrip("/")
    if not name or beside not in others:
        return "", ""
    hint = f"{beside} hides the package {name}: Python looks beside the program first; "
    if beside == script:
        return "", f"{hint}give the program, or what it imports, another name"
    return beside, f"{hint}rename it"


def _in_table(table: str, name: str) -> str:
    """Return a table's text for the first pattern that matches a name, with {} filled in; or ""."""
    for row in table.strip().splitlines():
        names, _, words = row.partition(": ")
        if any(fnmatch.fnmatchcase(name, pattern) for pattern in names.split()):
            return words.replace("{}", name.lower().replace("_", "-"))
    return ""


def package_of_module(module: str) -> str:
    """Return the Debian package that provides a Python module, or ""."""
    top = module.partition(".")[0]
    return _in_table(f"{top}: python3-{{}}" if top in MODULES.split() else OTHER_MODULES, top)


def packages_of_ros(name: str) -> str:
    """Return the Debian packages, separated by blanks, that provide a ROS package; or ""."""
    table = f"{name}: lib{{}}-dev" if name in DEV_PACKAGES.split() else OTHER_PACKAGES
    return _in_table(table, name) or package_of_module(name)


def is_lacking(name: str) -> bool:
    """Return whether a ROS package of this name exists, but not in Debian."""
    return name in LACKING or name in TABLES["REAL"].split()


def advice(name: str, packages: str) -> str:
    """Return how to get what is not installed, from these Debian packages or otherwise; or ""."""
    other = _in_table(TABLES["LACKING"], name)
    if not other and is_lacking(name):
        other = "its sources, cloned into src, may build"
    lacks = f"Debian lacks {name}; {other}" if other else ""
    return f"Debian has it: sudo apt install {packages}" if packages else lacks
