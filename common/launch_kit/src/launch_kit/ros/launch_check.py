"""The program that launch files call before anything starts; see README.md."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from launch_kit.command_line import given, starting
from launch_kit.io.parent import command_line, is_first

if TYPE_CHECKING:
    from launch_kit.ros.launch_tree import LaunchTree


def main() -> None:
    """Check what roslaunch will start; the output becomes the parameter's value."""
    words = starting(command_line())
    if words and is_first("launch_kit: the launch files are checked"):
        try:
            _check(words)
        except ValueError as error:
            sys.exit(f"roslaunch: {error}")
    print("true")


def _check(words: list[str]) -> None:
    """Raise ValueError for the first mistake; report what roslaunch ignores."""
    # The other launch files are done by now, and need no ROS.
    from launch_kit.arguments import check_all, without_effect  # noqa: PLC0415
    from launch_kit.names import refusal  # noqa: PLC0415
    from launch_kit.ros.launch_tree import read  # noqa: PLC0415
    from launch_kit.ros.packages import named_files  # noqa: PLC0415
    from launch_kit.ros.running_nodes import held_names, master_uri  # noqa: PLC0415

    files = named_files(words)
    tree = read(files, words)
    check_all(tree.checked_arguments())
    held = held_names(tree.checked_nodes())
    if held:
        raise ValueError(refusal(master_uri(), dict([next(iter(held.items()))])))
    for line in [*unknown(words, tree), *without_effect(tree.checked_arguments())]:
        print(f"roslaunch: {line}", file=sys.stderr)


def unknown(words: list[str], tree: LaunchTree) -> list[str]:
    """Return a line for each argument that roslaunch ignores, as no file has it."""
    from launch_kit.arguments import no_argument  # noqa: PLC0415

    wrong = [word for word in given(words) if word.split(":=")[0] not in tree.known]
    lines = [no_argument(word, tree.files[0], tree.known) for word in wrong if tree.is_whole]
    return [f"{line} (ignored)" for line in lines]
