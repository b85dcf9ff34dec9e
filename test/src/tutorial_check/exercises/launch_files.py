"""Launch files, read and not started: C21, and what the others ask of them."""

import difflib
import json
import os
import re
from pathlib import Path

from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.launch_facts import MARK
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.tracebacks import last_lines

BAG, STICK = "launch_bag.launch", "launch_joy_node.launch"
TURTLEBOT, REAL = "joy2twist_turtlebot.launch", "launch_joy_node_realTurtlebot.launch"
ALL = (BAG, STICK, TURTLEBOT, REAL)


def find_launch(session, name):
    """The path of a launch file in the student's package. Raises Wrong."""
    folder = session.package(PACKAGE).folder
    found = sorted(folder.rglob(name))
    if found:
        return found[0]
    others = {
        path.name: path for path in sorted(session.source.rglob("*launch*")) if path.is_file()
    }
    near = [
        other for other in others if other.lower() == name.lower()
    ] or difflib.get_close_matches(name, [other for other in others if other not in ALL], 1, 0.85)
    if near:
        inside = os.path.relpath(others[near[0]], session.source)
        raise Wrong(
            f"{PACKAGE}/launch/{name}",
            f"a file {inside}",
            where=inside,
            hint=f"its name must be {name}, and its place {PACKAGE}/launch",
        )
    raise Wrong(
        f"{PACKAGE}/launch/{name}",
        "no such file in your package",
        where=f"{PACKAGE}/launch",
        hint=f"write it; `roslaunch {PACKAGE} {name}` that works all the same runs OURS",
    )


def facts(session, name):
    """launch_facts of a file; all four are read at once."""
    return session.memo("launch facts", lambda: _read(session)).get(name)


def _read(session):
    folder = session.package(PACKAGE).folder
    paths = {}
    for name in ALL:
        for path in sorted(folder.rglob(name))[:1]:
            paths[name] = str(path)
    if not paths:
        return {}
    source = Path(__file__).resolve().parents[2]
    environment = dict(session.environment)
    environment["PYTHONPATH"] = f"{source}:{environment.get('PYTHONPATH', '')}"
    program = session.box.start(
        ["/usr/bin/python3", "-m", "tutorial_check.launch_facts", *paths.values()], environment
    )
    ended = session.box.wait(lambda: program.ended, 15.0)
    session.box.end(program)
    if not ended:
        raise Wrong(
            "launch files that roslaunch can read",
            "reading them does not end",
            hint="roslaunch --nodes FILE",
        )
    found = {}
    for line in program.output.splitlines():
        if line.startswith(MARK):
            one = json.loads(line[len(MARK) :])
            found[Path(one["path"]).name] = one
    if set(found) != set(paths):
        raise CannotCheck(f"launch files cannot be read: {last_lines(program.output)}")
    return found


def relative(session, path):
    """A path as the student knows it, within the package."""
    return os.path.relpath(path, session.package(PACKAGE).folder)


def check_file(session, name):
    """It exists, parses, and every $(find) leads somewhere that may be. Raises Wrong."""
    path = find_launch(session, name)
    where = relative(session, path)
    one = facts(session, name)
    text = path.read_text(errors="replace")
    if one["error"]:
        raise _parse_error(session, one["error"], where, text)
    unknown = re.findall(
        r"unrecognized tag (\S+)|[Uu]nknown (?:<\w+> )?attribute (\S+)",
        one["said"] + " ".join(one.get("errors", [])),
    )
    odd = [tag for tag in one["tags"] if tag not in _TAGS]
    if odd or unknown:
        word = odd[0] if odd else next(each for each in unknown[0] if each)
        line = line_of(text, f"<{word}" if odd else word)
        raise Wrong(
            "tags and attributes that roslaunch knows",
            f"{word}: ignored by roslaunch",
            where=f"{where}:{line}",
            hint=f"lower case: <{word.lower()}>"
            if word.lower() in _TAGS
            else "look at its spelling",
        )
    for each in one["nodes"]:
        _check_node(session, each, where, text)
    _check_finds(session, path, where, text)
    return path


_TAGS = {
    "launch",
    "node",
    "include",
    "remap",
    "param",
    "rosparam",
    "arg",
    "group",
    "env",
    "machine",
    "test",
    "master",
}


def line_of(text, word):
    """The number of the first line with a word; 1 if there is none."""
    for number, line in enumerate(text.splitlines(), 1):
        if word in line:
            return number
    return 1


def _parse_error(session, error, where, text):
    line = re.search(r"line (\d+)", error)
    place = f"{where}:{line[1]}" if line else where
    hint = "roslaunch --nodes FILE shows the same"
    missing = re.search(r"Resource not found: (\S+)|package \[?'?([\w-]+)", error)
    if (
        "mismatched tag" in error
        or "no element found" in error
        or "not well-formed" in error
        or "junk after" in error
        or "unclosed token" in error
    ):
        hint = "each <tag> needs its </tag> or />; the mistake is in the line named or in the one before"
        if any(quote in text for quote in "“”‘’"):
            hint = 'curly quotes came from the PDF: type " instead'
            place = f"{where}:{next(n for n, each in enumerate(text.splitlines(), 1) if any(q in each for q in '“”‘’'))}"
    elif missing:
        name = (missing[1] or missing[2]).rstrip(":.")
        hint = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
        place = f"{where}:{line_of(text, name)}"
    elif "No such file" in error or "does not exist" in error or "cannot resolve" in error.lower():
        file = re.search(r"'([^']+)'|\[([^\]]+)\]", error)
        named = Path(next((each for each in file.groups() if each), "")).name if file else ""
        hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
        place = f"{where}:{line_of(text, named)}"
    elif "attribute" in error or "requires" in error:
        hint = 'a node has pkg=, type= and name=; an include has file="$(find PACKAGE)/launch/FILE"'
        tag = re.search(r"<(\w+)>", error)
        place = f"{where}:{line_of(text, '<' + tag[1] if tag else '<node')}"
    elif "arg" in error:
        hint = 'each $(arg x) needs an <arg name="x" default="..."/>'
    return Wrong("a launch file that roslaunch can read", error[:250], where=place, hint=hint)


def _check_node(session, node, where, text):
    package, kind = node["package"], node["type"]
    place = f"{where}:{line_of(text, kind)}"
    if kind.endswith(".launch"):
        raise Wrong(
            "programs in <node>",
            f'type="{kind}"',
            where=place,
            hint=f'<include file="$(find {package})/launch/{kind}"/>',
        )
    if package == PACKAGE:
        folder = session.package(PACKAGE).folder
        found = [path for path in folder.rglob(kind) if path.is_file()]
        if kind == "joy_node":
            raise Wrong(
                "joy_node of package joy",
                'pkg="joy2twist" has no joy_node: your package hides ours',
                where=place,
                hint='<node pkg="joy" type="joy_node" name="joy_node"/>',
            )
        if not found:
            near = difflib.get_close_matches(
                kind, [path.name for path in folder.rglob("*") if path.is_file()], 1, 0.7
            )
            raise Wrong(
                f"a program {kind} in {PACKAGE}",
                "Cannot locate node of type [" + kind + "]",
                where=place,
                hint=f'type="{near[0]}"' if near else "type is the name of the file, with .py",
            )
        if not any(path.stat().st_mode & 0o100 for path in found):
            raise Wrong(
                f"{kind} may be run", "it is not executable", where=place, hint=f"chmod +x {kind}"
            )
        return
    if not node["found"] and (package, kind) != ("rviz", "rviz"):
        hint = (
            "look at pkg= and type=: rosrun PACKAGE and twice Tab lists the programs of a package"
        )
        if kind == "joy_node":
            hint = '<node pkg="joy" type="joy_node" name="joy_node"/>'
        raise Wrong(
            "nodes that exist",
            f"Cannot locate node of type [{kind}] in package [{package}]",
            where=place,
            hint=hint,
        )


def _check_finds(session, path, where, text):
    """No $(find joy2twist) leads to a file that the student does not have."""
    folder = session.package(PACKAGE).folder
    for number, line in enumerate(text.splitlines(), 1):
        for rest in re.findall(rf"\$\(find\s+{PACKAGE}\)([^\s\"'<>$]*)", line):
            if rest.strip("/") and not (folder / rest.strip("/")).exists():
                note = (
                    "mkdir bag, and copy joy.bag into it"
                    if rest.endswith(".bag")
                    else f"write {Path(rest).name} in YOUR package"
                )
                raise Wrong(
                    f"$(find {PACKAGE}){rest} in your package",
                    "no such file there",
                    where=f"{where}:{number}",
                    hint=f"{note}; another workspace's file would be taken without a word",
                )


def files(session):
    """C21: the two launch files of section 5."""
    return ", ".join(relative(session, check_file(session, name)) for name in (BAG, STICK))
