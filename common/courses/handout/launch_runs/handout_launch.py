"""The handout's launch files, read but not launched."""

from __future__ import annotations

import contextlib
import difflib
import re
import shlex
from pathlib import Path

from tutorial_check import (
    GAPS,
    LaunchFile,
    LaunchNode,
    Script,
    Submission,
    Wrong,
    find_launch,
    find_script,
    first_of,
    line_of,
    meant,
    read_xml,
)

from ..task import NAME, PACKAGE

BAG, STICK = "launch_bag.launch", "launch_joy_node.launch"
TURTLEBOT, REAL = "joy2twist_turtlebot.launch", "launch_joy_node_realTurtlebot.launch"
ALL = (BAG, STICK, TURTLEBOT, REAL)
# {role of a node: pattern of its PACKAGE/TYPE}
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
UNKNOWN = re.compile(
    r"unrecognized (?:tag |')(\w+)|[Uu]nknown (?:<\w+> )?attribute '?([^\s']+)"
)  # (tag, attribute), as roslaunch prints them


def program_name(submission: Submission) -> str:
    """Return the name by which a launch file starts the student's joy2twist."""
    if not submission.is_in_cpp(PACKAGE):
        return NAME
    with contextlib.suppress(Wrong):
        return Script(submission, PACKAGE, find_script(submission, PACKAGE, NAME)).name
    return Path(NAME).stem


class HandoutLaunch(LaunchFile):
    """One of the handout's launch files, and its nodes by role."""

    def __init__(self, submission: Submission, name: str) -> None:
        """Read it, and the others that later checks need. Raises Wrong."""
        hint = f"write it: launch/{name} in YOUR package. ./tutorial shell without --in has one of"
        path = find_launch(submission, PACKAGE, name, f"{hint} OURS")
        folder = submission.package(PACKAGE).folder
        others = (sorted(filter(Path.is_file, folder.rglob(other))) for other in ALL)
        super().__init__(submission, PACKAGE, path, [paths[0] for paths in others if paths])
        self.name, self.student_package = name, submission.task.name_of(PACKAGE)
        # The student's programs.
        self.own = [node for node in self.nodes if node["package"] == self.student_package]

    @property
    def own_node(self) -> str:
        """The element that starts the student's joy2twist."""
        name = program_name(self.submission)
        return f'<node pkg="{self.student_package}" type="{name}" name="myjoystick2twist"/>'

    def of(self, *roles: str) -> list[LaunchNode]:
        """Return the nodes with any of these ROLES."""
        pattern = re.compile("|".join(ROLES[role] for role in roles))
        return [node for node in self.nodes if pattern.fullmatch("{package}/{type}".format(**node))]

    def must_start(self, what: str, nodes: list[LaunchNode], hint: str) -> LaunchNode:
        """Return the first of these nodes. Raises Wrong if there is none."""
        if not nodes:
            raise Wrong(f"{self.name} starts {what}", "it does not", self.where, hint)
        return nodes[0]

    def words_of(self, node: LaunchNode) -> list[str]:
        """Return the arguments of a node, split as a shell does. Raises Wrong."""
        try:
            return shlex.split(node["args"])
        except ValueError as error:
            expected, seen = "a closing quote for each quote in args", f"{node['args']} ({error})"
            hint = "delete the ': a path without spaces needs none"
            raise Wrong(expected, seen, self.at_node(node), hint) from None


def copy_bag(submission: Submission) -> str:
    """Return the commands that copy the suite's bag into the student's package."""
    folder = submission.whole("bag", PACKAGE)
    return f'mkdir -p {folder}; cp "$(rospack find gamepad)/bag/joy.bag" {folder}'


def check_launch(submission: Submission, name: str) -> HandoutLaunch:
    """Return a launch file that exists and parses, with valid $(find)s. Raises Wrong."""
    try:
        file = HandoutLaunch(submission, name)
        wrong = name_with_a_gap(file)
        if not wrong:
            file.must_be_read()
        wrong = wrong or first_of((unknown_word, tag_within_a_node, faulty_node, lost_file), file)
        if wrong:
            raise wrong
        return file
    except Wrong as wrong:
        wrong.look = wrong.look or f"roslaunch --nodes {submission.task.names.package} {name}"
        raise


def name_with_a_gap(file: HandoutLaunch) -> Wrong | None:
    for gap in filter(None, (re.search(pattern, file.text) for pattern in GAPS)):
        whole = gap[0].replace(gap[1], "_".join(gap[1].split()))
        hint = f"a name has no space, the PDF shows _ as a gap: {whole}"
        return Wrong("names in one word", gap[0], file.at(gap[0]), hint)
    return None


def _printed(file: HandoutLaunch) -> str:
    """Return what roslaunch printed while it read a file."""
    return str(file.facts["said"] + " ".join(file.facts.get("errors", [])))


def unknown_word(file: HandoutLaunch) -> Wrong | None:
    words = (match.groups("") for match in UNKNOWN.finditer(_printed(file)))
    tag, name = next((word for word in words if word[0] not in TAGS.split()), ("", ""))
    if not tag and not name:
        return None
    hint = meant(name, ATTRIBUTES.split(), 0.7, "is {}= meant?") or "look at its spelling"
    if tag.lower() in TAGS.split():
        hint = f"lower case: <{tag.lower()}>"
    written = rf"<{tag}\b" if tag else rf"\s{name}\s*="
    for path in (file.submission.source / file.path, *map(Path, file.facts["files"])):
        match = file.submission.is_own(path) and re.search(written, read_xml(path))
        if match:  # otherwise the fault is in a file of the suite
            where = f"{file.inside(path)}:{line_of(read_xml(path), match.end())}"
            expected = "tags and attributes that roslaunch knows"
            return Wrong(expected, f"{tag or name}: ignored by roslaunch", where, hint)
    return None


def tag_within_a_node(file: HandoutLaunch) -> Wrong | None:
    tag = re.search(r"unrecognized '(\w+)' child tag", _printed(file))
    node = rf"<node\b[^<>]*(?<!/)>(?:(?!</node>).)*?<{tag[1]}\b" if tag else "(?!)"
    start = re.search(node, file.text, re.DOTALL)
    if not tag or not start:
        return None
    where = f"{file.where}:{line_of(file.text, start.start())}"
    hint = "the <node> of this line goes on to its </node>: close it first, with /> or </node>"
    expected = "only remap, param, rosparam and env in a <node>"
    return Wrong(expected, f"<{tag[1]}> in it: ignored by roslaunch", where, hint)


def faulty_node(file: HandoutLaunch) -> Wrong | None:
    """Find the first node whose program does not exist, or is no program."""
    diagnoses = (type_with_a_folder, launch_file_as_node, not_located)
    return next(filter(None, (first_of(diagnoses, (file, node)) for node in file.nodes)), None)


def type_with_a_folder(about: tuple[HandoutLaunch, LaunchNode]) -> Wrong | None:
    file, node = about
    if "/" not in node["type"]:
        return None
    expected, hint = "type is the name of a program, without its folder", Path(node["type"]).name
    return Wrong(expected, f'type="{node["type"]}"', file.at_node(node), f'type="{hint}"')


def launch_file_as_node(about: tuple[HandoutLaunch, LaunchNode]) -> Wrong | None:
    file, node = about
    kind = node["type"]
    if not kind.endswith(".launch"):
        return None
    hint = f'<include file="$(find {node["package"]})/launch/{kind}"/>'
    return Wrong("programs in <node>", f'type="{kind}"', file.at_node(node), hint)


def not_located(about: tuple[HandoutLaunch, LaunchNode]) -> Wrong | None:
    file, node = about
    if node["found"] or (node["package"], node["type"]) == ("rviz", "rviz"):
        return None
    if node["package"] == file.student_package:
        return _no_own_program(file, node)
    wrong = file.missing(node)
    if difflib.get_close_matches(node["type"], ["joy_node"], 1, 0.8):
        wrong.hint = JOY_HINT
    return wrong


def _no_own_program(file: HandoutLaunch, node: LaunchNode) -> Wrong:
    """Return the Wrong for a node whose program is not in the student's package."""
    submission, kind, place = file.submission, node["type"], file.at_node(node)
    if submission.is_in_cpp(PACKAGE):
        return _no_compiled_program(file, node)
    files = [path for path in submission.package(PACKAGE).folder.rglob("*") if path.is_file()]
    for path in (path for path in files if path.name == kind):
        hint = f"chmod +x {submission.whole(path, PACKAGE)}"
        return Wrong(f"an executable {kind}", "it is not executable", place, hint)
    if kind == NAME:
        find_script(submission, PACKAGE, NAME)  # raises Wrong with a similar name, if there is one
    hint = meant(kind, sorted(path.name for path in files), 0.7, 'type="{}"')
    hint = JOY_HINT if kind == "joy_node" else hint or "type is the name of the file, with .py"
    seen = f"Cannot locate node of type [{kind}]"
    return Wrong(f"a program {kind} in {submission.task.names.package}", seen, place, hint)


def _no_compiled_program(file: HandoutLaunch, node: LaunchNode) -> Wrong:
    submission, kind = file.submission, node["type"]
    if Path(kind).stem == Path(NAME).stem:
        find_script(submission, PACKAGE, NAME)  # raises Wrong if no target is like it
    paths = submission.cpp_programs(PACKAGE)
    names = [Script(submission, PACKAGE, path).name for path in paths]
    hint = meant(Path(kind).stem, names, 0.7, 'type="{}"')
    hint = JOY_HINT if kind == "joy_node" else hint or "type is the name in add_executable"
    expected = f"the name of a program in {submission.task.names.package}"
    seen = f"Cannot locate node of type [{kind}]"
    return Wrong(expected, seen, file.at_node(node), hint)


def lost_file(file: HandoutLaunch) -> Wrong | None:
    """Find a $(find joy2twist) of a file that is not in the student's package."""
    folder, package = file.submission.package(PACKAGE).folder, file.student_package
    for match in re.finditer(rf"\$\(find\s+{package}\)([^\s\"'<>$]*)", file.text):
        inside, name = match[1].strip("/"), Path(match[1]).name
        if not inside or (folder / inside).exists():
            continue
        hint = f"write {name} in YOUR package"
        hint = copy_bag(file.submission) if name.endswith(".bag") else hint
        there = sorted(path.relative_to(folder) for path in folder.rglob(name))
        hint = f"it is elsewhere: $(find {package})/{there[0]}" if there else hint
        hint += "; roslaunch would take another workspace's file without a warning"
        expected = f"$(find {file.submission.task.names.package}){match[1]} in your package"
        where = f"{file.where}:{line_of(file.text, match.start())}"
        return Wrong(expected, f"no {match[1]} in it", where, hint)
    return None
