"""Launch files, read and not started: C21, and what the others ask of them."""

import difflib
import json
import os
import re
from pathlib import Path

from tutorial_check import launch_facts, preloaded
from tutorial_check.exercises import check
from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.exercises.files import find_script, is_runnable
from tutorial_check.exercises.joy2twist import NAME
from tutorial_check.exercises.launch_text import attribute, parse_error, place_of, read, space_hint
from tutorial_check.exercises.launch_xml import line_of, unclosed_node
from tutorial_check.exercises.manifests import must_be_launchable
from tutorial_check.model import CannotCheck, Wrong
from tutorial_check.tracebacks import last_lines

BAG, STICK = "launch_bag.launch", "launch_joy_node.launch"
TURTLEBOT, REAL = "joy2twist_turtlebot.launch", "launch_joy_node_realTurtlebot.launch"
ALL = (BAG, STICK, TURTLEBOT, REAL)


def copy_bag(session):
    """The commands that put the suite's recording into the student's package."""
    folder = session.whole("bag", PACKAGE)
    return f'mkdir -p {folder}; cp "$(rospack find gamepad)/bag/joy.bag" {folder}'


def find_launch(session, name):
    """The path of a launch file in the student's package. Raises Wrong."""
    folder = session.package(PACKAGE).folder
    found = sorted(path for path in folder.rglob(name) if path.is_file())
    if len(found) > 1:
        raise Wrong(
            f"one file {name}",
            "several: " + ", ".join(str(path.relative_to(folder)) for path in found),
            where=str(found[1].relative_to(folder)),
            hint=f"roslaunch says 'multiple files named {name}' and starts nothing: keep one in"
            f" {PACKAGE}/launch",
        )
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
        hint=f"write it: launch/{name} in YOUR package. ./tutorial shell without --in has one of OURS",
    )


def facts(session, name):
    """launch_facts of a file; all four are read at once."""
    return session.memo("launch facts", lambda: _read(session)).get(name)


def _read(session):
    must_be_launchable(session)
    session.must_reach_floor()
    folder = session.package(PACKAGE).folder
    paths = {}
    for name in ALL:
        for path in sorted(each for each in folder.rglob(name) if each.is_file())[:1]:
            paths[name] = str(path)
    if not paths:
        return {}
    program = session.box.fork(
        lambda: preloaded.end_with(lambda: launch_facts.tell(paths.values())),
        session.environment,
        "launch_facts",
    )
    ended = session.box.wait(lambda: program.ended, 15.0)
    session.box.end(program)
    if not ended and session.box.patience.strained():
        raise CannotCheck(
            "launch files cannot be read in time: the machine has too much else to do"
        )
    if not ended:
        raise Wrong(
            "launch files that roslaunch can read",
            "reading them does not end",
            hint="roslaunch --nodes FILE",
        )
    found = {}
    for line in program.output.splitlines():
        if line.startswith(launch_facts.MARK):
            one = json.loads(line[len(launch_facts.MARK) :])
            found[Path(one["path"]).name] = one
    if set(found) != set(paths):
        raise CannotCheck(f"launch files cannot be read: {last_lines(program.output)}")
    return found


def relative(session, path):
    """A path as the student knows it, within the package."""
    return os.path.relpath(path, session.package(PACKAGE).folder)


def check_file(session, name):
    """It exists, parses, and every $(find) leads somewhere that may be; its path. Raises Wrong."""
    try:
        return _check_file(session, name)
    except Wrong as wrong:
        wrong.look = wrong.look or f"roslaunch --nodes {PACKAGE} {name}"
        raise


def _check_file(session, name):
    path = find_launch(session, name)
    where = relative(session, path)
    one = facts(session, name)
    text = read(path)
    if one.get("root", "launch") != "launch":
        raise Wrong(
            "<launch> around all",
            f"<{one['root']}>",
            where=place_of(where, text, f"<{one['root']}"),
            hint="roslaunch knows <launch> alone, in lower case",
        )
    if one["error"]:
        raise parse_error(one["error"], where, path.read_text(errors="replace"))
    said = one["said"] + " ".join(one.get("errors", []))
    unknown = re.findall(
        r"unrecognized tag (\S+)|[Uu]nknown (?:<\w+> )?attribute '?([^\s']+)", said
    )
    odd = [tag for tag in one["tags"] if tag not in _TAGS]
    if odd or unknown:
        word = odd[0] if odd else next(each for each in unknown[0] if each)
        near = difflib.get_close_matches(word, _ATTRIBUTES, 1, 0.7)
        hint = f"is {near[0]}= meant?" if near and not odd else "look at its spelling"
        if odd and word.lower() in _TAGS:
            hint = f"lower case: <{word.lower()}>"
        written = re.search(rf"<{word}\b" if odd else rf"\s{word}\s*=", text)
        raise Wrong(
            "tags and attributes that roslaunch knows",
            f"{word}: ignored by roslaunch",
            where=f"{where}:{line_of(text, written.end())}" if written else where,
            hint=hint,
        )
    inside = re.search(r"unrecognized '(\w+)' child tag", said)
    line = unclosed_node(text, inside[1]) if inside else None
    if line:
        raise Wrong(
            "no tag in a <node> but remap, param, rosparam and env",
            f"<{inside[1]}> in it: ignored by roslaunch",
            where=f"{where}:{line}",
            hint="the <node> of this line goes on to its </node>: close it first, with /> or </node>",
        )
    gap, hint = space_hint(text)
    if gap:
        raise Wrong("names in one word", gap, where=place_of(where, text, gap), hint=hint)
    for each in one["nodes"]:
        _check_node(session, each, where, text)
    _check_finds(session, path, where, text)
    return path


_ATTRIBUTES = (
    *("pkg", "type", "name", "args", "output", "required", "respawn", "respawn_delay", "ns", "cwd"),
    *("launch-prefix", "machine", "clear_params", "file", "from", "to", "value", "default", "if"),
    *("unless", "command", "textfile", "binfile", "param", "pass_all_args", "doc"),
)
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


def _check_node(session, node, where, text):
    package, kind = node["package"], node["type"]
    place = place_of(where, text, *attribute("type", kind), Path(kind).name)
    if "/" in kind:
        raise Wrong(
            "type is the name of a program, without its folder",
            f'type="{kind}"',
            where=place,
            hint=f'type="{Path(kind).name}"',
        )
    if kind.endswith(".launch"):
        raise Wrong(
            "programs in <node>",
            f'type="{kind}"',
            where=place,
            hint=f'<include file="$(find {package})/launch/{kind}"/>',
        )
    if package == PACKAGE:
        folder = session.package(PACKAGE).folder
        found = [path for path in folder.rglob("*") if path.name == kind and path.is_file()]
        if kind == "joy_node":
            raise Wrong(
                "joy_node of package joy",
                'pkg="joy2twist" has no joy_node: your package hides ours',
                where=place,
                hint='<node pkg="joy" type="joy_node" name="joy_node"/>',
            )
        if not found and kind == NAME:
            find_script(session, PACKAGE, NAME)  # which says what is there in its place
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
        if not any(is_runnable(session, PACKAGE, path) for path in found):
            raise Wrong(
                f"{kind} may be run",
                "it is not executable",
                where=place,
                hint=f"chmod +x {session.whole(found[0], PACKAGE)}",
            )
        return
    if not node["found"] and (package, kind) != ("rviz", "rviz"):
        hint = (
            "look at pkg= and type=: rosrun PACKAGE and twice Tab lists the programs of a package"
        )
        if difflib.get_close_matches(kind, ["joy_node"], 1, 0.8):
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
                name = Path(rest).name
                note = (
                    copy_bag(session) if rest.endswith(".bag") else f"write {name} in YOUR package"
                )
                there = sorted(each.relative_to(folder) for each in folder.rglob(name))
                if there:
                    note = f"it lies elsewhere: $(find {PACKAGE})/{there[0]}"
                raise Wrong(
                    f"$(find {PACKAGE}){rest} in your package",
                    "no such file there",
                    where=f"{where}:{number}",
                    hint=f"{note}; another workspace's file would be taken without a word",
                )


@check(
    "C21",
    "the two launch files can be read",
    "5.1",
    "C12",
    look="roslaunch --nodes joy2twist launch_bag.launch",
    timeless=True,
)
def files(session):
    """The two launch files of section 5."""
    return ", ".join(relative(session, check_file(session, name)) for name in (BAG, STICK))
