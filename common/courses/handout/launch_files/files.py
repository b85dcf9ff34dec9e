"""Launch files, read and not started: C21, and what the others ask of them."""

from __future__ import annotations

import difflib
import os
import re
import shlex
from pathlib import Path
from typing import Any

from tutorial_check import (
    GAPS,
    UNSET,
    Fault,
    Lines,
    Node,
    Note,
    Submission,
    Wrong,
    attribute,
    blamed_place,
    check,
    find_script,
    is_stand_in,
    launch_error,
    line_of,
    meant,
    must_be_launchable,
    package_hint,
    place_of,
    read_launch_files,
    read_xml,
    text_of_file,
)

from ..task import NAME, PACKAGE

BAG, STICK = "launch_bag.launch", "launch_joy_node.launch"
TURTLEBOT, REAL = "joy2twist_turtlebot.launch", "launch_joy_node_realTurtlebot.launch"
ALL = (BAG, STICK, TURTLEBOT, REAL)
# {what a node is: a pattern of its PACKAGE/TYPE}
ROLES = {
    "viewer": r"[^/]*/(rviz|view_robot)",
    "player": "rosbag/play",
    "simulator": r"fake_turtlebot_sim/fake_turtlebot\.py|arbotix.*",
    "joystick": r"(?!rosbag/)[^/]*/(joy_node|joy_node\.py|joystick\.py)",
}
JOY_HINT = '<node pkg="joy" type="joy_node" name="joy_node"/>'
TAGS = "launch node include remap param rosparam arg group env machine test master"
ATTRIBUTES = (
    "pkg type name args output required respawn respawn_delay ns cwd launch-prefix machine"
    " clear_params file from to value default if unless command textfile binfile param"
    " pass_all_args doc"
)


class LaunchFile(Lines):
    """A launch file of the student's: its text, and what roslaunch makes of it."""

    def __init__(self, submission: Submission, name: str) -> None:
        self.submission, self.name = submission, name
        self.path = find_launch(submission, name)
        self.where = shown(submission, self.path)
        self.text = read_xml(self.path)
        self.facts = _read(submission)[name]
        self.nodes: list[Node] = self.facts["nodes"]  # that it starts
        self.package = submission.task.named(PACKAGE)
        self.own = [node for node in self.nodes if node["package"] == self.package]

    def at_node(self, node: Node) -> str:
        """Return FILE:LINE of a node, which may be in an included file."""
        path = Path(node["filename"])
        path = path if self.submission.is_own(path) else self.path
        words = (*attribute("type", node["type"]), Path(node["type"]).name)
        return place_of(shown(self.submission, path), read_xml(path), *words)

    def of(self, *roles: str) -> list[Node]:
        """Return the nodes that it starts of any of these ROLES."""
        pattern = "|".join(ROLES[each] for each in roles)
        named = (("{package}/{type}".format(**one), one) for one in self.nodes)
        return [one for name, one in named if re.fullmatch(pattern, name)]

    def demand(self, what: str, nodes: list[Node], hint: str) -> Node:
        """Return the first of these nodes. Raises Wrong if there is none."""
        if not nodes:
            raise Wrong(f"{self.name} starts {what}", "it does not", self.where, hint)
        return nodes[0]

    def words_of(self, node: Node) -> list[str]:
        """Return the arguments of a node, as a shell would part them. Raises Wrong."""
        try:
            return shlex.split(node["args"])
        except ValueError as error:
            expected, seen = "a second quote for each one in args", f"{node['args']} ({error})"
            hint = "leave the ' out: a path without spaces needs none"
            raise Wrong(expected, seen, self.at_node(node), hint) from None


def shown(submission: Submission, path: str | Path) -> str:
    """Return the path of a file within the student's package, or else within src."""
    inside = os.path.relpath(path, submission.package(PACKAGE).folder)
    return os.path.relpath(path, submission.source) if inside.startswith("..") else inside


def copy_bag(submission: Submission) -> str:
    """Return the commands that put the suite's recording into the student's package."""
    folder = submission.whole("bag", PACKAGE)
    return f'mkdir -p {folder}; cp "$(rospack find gamepad)/bag/joy.bag" {folder}'


def find_launch(submission: Submission, name: str) -> Path:
    """Return the path of a launch file in the student's package. Raises Wrong."""
    folder, own = submission.package(PACKAGE).folder, submission.task.named(PACKAGE)
    found = sorted(path for path in folder.rglob(name) if path.is_file())
    if len(found) > 1:
        inside = [str(path.relative_to(folder)) for path in found]
        hint = f"roslaunch says 'multiple files named {name}' and starts nothing: keep one in"
        seen = f"several: {', '.join(inside)}"
        raise Wrong(f"one file {name}", seen, inside[1], f"{hint} {own}/launch")
    if found:
        return found[0]
    paths = sorted(path for path in submission.source.rglob("*launch*") if path.is_file())
    others = {path.name.lower(): path for path in paths if path.name not in ALL}
    expected = f"{submission.task.names.package}/launch/{name}"
    for near in difflib.get_close_matches(name.lower(), others, 1, 0.85):
        other = os.path.relpath(others[near], submission.source)
        hint = f"its name must be {name}, and its place {own}/launch"
        raise Wrong(expected, f"a file {other}", other, hint)
    hint = f"write it: launch/{name} in YOUR package. ./tutorial shell without --in has one of OURS"
    raise Wrong(expected, "no such file in your package", f"{PACKAGE}/launch", hint)


def _read(submission: Submission) -> dict[str, dict[str, Any]]:
    """Return {name: facts} of those of the four that are there."""
    must_be_launchable(submission)
    folder = submission.package(PACKAGE).folder
    files = (path for name in ALL for path in sorted(folder.rglob(name))[::-1] if path.is_file())
    paths = {
        path.name: os.path.relpath(path, submission.source) for path in files
    }  # the first ones
    facts = submission.recording(read_launch_files, *paths.values()).files
    if facts is None:
        seen, hint = "reading them does not end", "roslaunch --nodes FILE"
        raise Wrong("launch files that roslaunch can read", seen, hint=hint)
    return {Path(one["path"]).name: one for one in facts}


def check_file(submission: Submission, name: str) -> LaunchFile:
    """Return the LaunchFile: it exists, parses, each $(find) leads where it may. Raises Wrong."""
    try:
        file = LaunchFile(submission, name)
        _check_text(file)
        for node in file.nodes:
            _check_node(file, node)
        _check_finds(file)
        return file
    except Wrong as wrong:
        wrong.look = wrong.look or f"roslaunch --nodes {submission.task.names.package} {name}"
        raise


def _check_text(file: LaunchFile) -> None:
    one = file.facts
    for gap in filter(None, (re.search(each, file.text) for each in GAPS)):
        whole = gap[0].replace(gap[1], "_".join(gap[1].split()))
        hint = f"a name has no space, the PDF shows _ as a gap: {whole}"
        raise Wrong("names in one word", gap[0], file.at(gap[0]), hint)
    if one["fault"]:
        raise _fault(file, Fault(**one["fault"]))
    said = one["said"] + " ".join(one.get("errors", []))
    _check_words(file, said)
    inside = re.search(r"unrecognized '(\w+)' child tag", said)
    node = rf"<node\b[^<>]*(?<!/)>(?:(?!</node>).)*?<{inside[1]}\b" if inside else "(?!)"
    found = re.search(node, file.text, re.DOTALL)
    if inside and found:
        expected = "no tag in a <node> but remap, param, rosparam and env"
        hint = "the <node> of this line goes on to its </node>: close it first, with /> or </node>"
        seen = f"<{inside[1]}> in it: ignored by roslaunch"
        raise Wrong(expected, seen, f"{file.where}:{line_of(file.text, found.start())}", hint)


def _fault(file: LaunchFile, fault: Fault) -> Wrong:
    """Return the Wrong for what roslaunch cannot read, in this file or in an included one."""
    submission = file.submission
    path, line = blamed_place(fault, submission.is_own)
    text = text_of_file(Path(path))
    wrong = launch_error(fault, shown(submission, path), line, text, submission.may_see)
    inner, number = fault.places[-1]
    if not submission.is_own(inner) and fault.kind != UNSET:
        wrong.seen += f" (in {inner}:{number})"
    hiding = (each for each in submission.packages if each.folder in Path(path).parents)
    for name in (each.name for each in hiding if is_stand_in(each.name)):
        wrong.hint += f"; or remove {name} from src: this suite has one that needs nothing else"
    return wrong


def _check_words(file: LaunchFile, said: str) -> None:
    pattern = r"unrecognized (?:tag |')(\w+)|[Uu]nknown (?:<\w+> )?attribute '?([^\s']+)"
    odd = (each.groups("") for each in re.finditer(pattern, said))
    tag, name = next((each for each in odd if each[0] not in TAGS.split()), ("", ""))
    if not tag and not name:
        return
    hint = meant(name, ATTRIBUTES.split(), 0.7, "is {}= meant?") or "look at its spelling"
    if tag.lower() in TAGS.split():
        hint = f"lower case: <{tag.lower()}>"
    written = rf"<{tag}\b" if tag else rf"\s{name}\s*="
    for path in (file.path, *map(Path, file.facts["files"])):
        found = file.submission.is_own(path) and re.search(written, read_xml(path))
        if found:  # else it is in a file of others
            where = f"{shown(file.submission, path)}:{line_of(read_xml(path), found.end())}"
            expected = "tags and attributes that roslaunch knows"
            raise Wrong(expected, f"{tag or name}: ignored by roslaunch", where, hint)


def _check_node(file: LaunchFile, node: Node) -> None:
    package, kind, place = node["package"], node["type"], file.at_node(node)
    if "/" in kind:
        expected = "type is the name of a program, without its folder"
        raise Wrong(expected, f'type="{kind}"', place, f'type="{Path(kind).name}"')
    if kind.endswith(".launch"):
        hint = f'<include file="$(find {package})/launch/{kind}"/>'
        raise Wrong("programs in <node>", f'type="{kind}"', place, hint)
    if node["found"] or (package, kind) == ("rviz", "rviz"):
        return
    submission, seen = file.submission, f"Cannot locate node of type [{kind}]"
    if package != file.package:
        hint = "look at pkg= and type=: rosrun PACKAGE and Tab twice lists its programs"
        hint = package_hint(package) if node["found"] is None else hint
        if difflib.get_close_matches(kind, ["joy_node"], 1, 0.8):
            hint = JOY_HINT
        raise Wrong("nodes that exist", f"{seen} in package [{package}]", place, hint)
    files = [path for path in submission.package(PACKAGE).folder.rglob("*") if path.is_file()]
    for path in (path for path in files if path.name == kind):
        hint = f"chmod +x {submission.whole(path, PACKAGE)}"
        raise Wrong(f"{kind} may be run", "it is not executable", place, hint)
    if kind == NAME:
        find_script(submission, PACKAGE, NAME)  # which says what is there in its place
    hint = meant(kind, sorted(path.name for path in files), 0.7, 'type="{}"')
    hint = hint or "type is the name of the file, with .py"
    hint = JOY_HINT if kind == "joy_node" else hint
    raise Wrong(f"a program {kind} in {submission.task.names.package}", seen, place, hint)


def _check_finds(file: LaunchFile) -> None:
    """Raise Wrong for a $(find joy2twist) of a file that the student does not have."""
    folder, package = file.submission.package(PACKAGE).folder, file.package
    shown_as = file.submission.task.names.package
    for number, line in enumerate(file.text.splitlines(), 1):
        for rest in re.findall(rf"\$\(find\s+{package}\)([^\s\"'<>$]*)", line):
            if not rest.strip("/") or (folder / rest.strip("/")).exists():
                continue
            name = Path(rest).name
            hint = f"write {name} in YOUR package"
            if rest.endswith(".bag"):
                hint = copy_bag(file.submission)
            there = sorted(each.relative_to(folder) for each in folder.rglob(name))
            if there:
                hint = f"it is elsewhere: $(find {package})/{there[0]}"
            expected = f"$(find {shown_as}){rest} in your package"
            hint += "; roslaunch would take another workspace's file and not say so"
            raise Wrong(expected, f"no {rest} in it", f"{file.where}:{number}", hint)


@check("C21", "the two launch files can be read, and what they name is there", "5.1", needs="C12",
       look="roslaunch --nodes {n.package} launch_bag.launch", timeless=True)  # fmt: skip
def files(submission: Submission) -> Note | str | None:
    return ", ".join(check_file(submission, name).where for name in (BAG, STICK))
