"""Programs for launch files.

    <param name="names_were_free" command="$(find node_kit)/names_free --arguments mobile_base"/>

names_free: nothing is started while a node of one of these names runs, in the namespaces that this
launch puts them into. roslaunch runs the command while it reads the file, and exits if it fails;
roslaunch itself would end the running node. --arguments: report arguments that roslaunch ignores,
as no file has them.

    <param name="rest_was_ignored" command="$(find node_kit)/ignored base kobuki '$(arg base)'"/>

ignored: report the arguments that change nothing: name, only value, value given, next name ...

    <node ... required="true" launch-prefix="$(find node_kit)/ends_launch"/>

ends_launch: the normal end of a node ends the launch, as Ctrl-C does. required="true" alone reports
every end as a process that has died.
"""

from __future__ import annotations

import difflib
import os
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from node_kit.questions import holder

DEFAULT_MASTER = "http://localhost:11311"
# With these roslaunch only prints what is in the file.
ONLY_READS = re.compile(r"--(nodes|files|args|find-node|ros-args|dump-params)\b")
ENDING = (signal.SIGINT, signal.SIGTERM)  # what roslaunch ends a node with
LONGEST_END_S = 60.0  # roslaunch kills what still runs after some 20 s


def will_start(command: list[str]) -> bool:
    """Return whether the program of this command line starts nodes on the user's master.

    rostest has a master of its own, roslaunch-check starts nothing.
    """
    names = [Path(word).name for word in command[:2]]
    return "roslaunch" in names and not any(map(ONLY_READS.match, command))


class Launch(NamedTuple):
    """What roslaunch starts by a command line: files, nodes by full name, arguments it can set."""

    files: list[str]
    nodes: list[str]
    arguments: set[str]


def read_launch(command: list[str]) -> Launch:
    """Return what roslaunch makes of its command line; no files if it cannot read all of them."""
    import roslaunch.xmlloader  # noqa: PLC0415 (it takes 0.2 s, which ends_launch need not wait)

    launch, config = Launch([], [], set()), roslaunch.config.ROSLaunchConfig()
    words = command[[Path(word).name for word in command].index("roslaunch") + 1 :]
    try:
        _, words = roslaunch._get_optparse().parse_args(words)
        launch.files.extend(roslaunch.rlutil.resolve_launch_arguments(words))
        for file in launch.files:
            loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
            loader.param_value = lambda *_: ""  # runs no command: this program is one of them
            loader.load(file, config, argv=words, verbose=False)
            launch.arguments.update(loader.root_context.resolve_dict.get("arg_doc", ()))
    except Exception:  # whatever it is, roslaunch meets it, too
        launch.files.clear()
    launch.nodes.extend(f"{node.namespace}{node.name}" for node in config.nodes)
    return launch


def no_argument(given: str, file: str, known: Iterable[str]) -> str:
    """Return a line on NAME:=VALUE whose name is none of a launch file's arguments."""
    names = ", ".join(f"{name}:=" for name in sorted(known)) or "none"
    near = difflib.get_close_matches(re.split(":?=", given)[0], known, 1)
    meant = f"; did you mean {near[0]}:=?" if near else ""
    return f"{given}: not an argument of {Path(file).name}, which has {names}{meant}"


def check_arguments(command: list[str], launch: Launch) -> None:
    """Report the arguments of a command line that roslaunch ignores."""
    for word in command if launch.files else ():
        name, assigned, _ = word.partition(":=")
        if assigned and name not in launch.arguments and not name.startswith("_"):
            line = no_argument(word, launch.files[0], launch.arguments)
            print(f"roslaunch: {line} (ignored)", file=sys.stderr)


def _parent() -> list[str]:
    """Return the command line of the program that reads the launch file."""
    words = Path(f"/proc/{os.getppid()}/cmdline").read_bytes().decode(errors="replace")
    return words.rstrip("\0").split("\0")


def check_names(names: list[str], launch: Launch, master_uri: str) -> None:
    """Exit with one line if a node holds one of the names, wherever this launch has them."""
    for name in [node for node in launch.nodes if node.split("/")[-1] in names]:
        held = holder(master_uri, name)
        if held:
            sys.exit(
                f"roslaunch: {name} runs already, {held[1]}: end it first (Ctrl-C in its terminal, "
                f"or rosnode kill {name}), or have a master of your own "
                "(export ROS_MASTER_URI=http://localhost:11312)"
            )


def names_free() -> None:
    """Check the names of the command line; the output becomes the value of the parameter."""
    command = _parent()
    if will_start(command):
        launch = read_launch(command)
        check_names(sys.argv[1:], launch, os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER)
        if "--arguments" in sys.argv:
            check_arguments(command, launch)
    print("true")


def ignored() -> None:
    """Report what was given in vain; the command line has (name, only value, given value) ..."""
    words, starts = sys.argv[1:], will_start(_parent())
    for name, only, given in zip(words[::3], words[1::3], words[2::3]):
        if starts and given != only:
            why = "it changes nothing about the simulated robot"
            print(f"roslaunch: {name}:={given} is ignored: {why}", file=sys.stderr)
    print("true")


def ends_launch() -> None:
    """Run the node of the command line; at its normal end interrupt roslaunch, and wait."""
    command, ended = sys.argv[1:], threading.Event()
    for number in ENDING:  # both go to the node, too, which has its own handlers
        signal.signal(number, lambda *_: ended.set())
    code = subprocess.call(command)
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    if ended.is_set() or code != 0 or not will_start(_parent()):
        sys.exit(code if code >= 0 else 128 - code)
    name = next((word[8:] for word in command if word.startswith("__name:=")), command[0])
    print(f"roslaunch: {name} has finished, which ends this launch", file=sys.stderr)
    os.kill(os.getppid(), signal.SIGINT)
    # A node that exits before roslaunch has begun to end is reported as one that has died.
    signal.sigtimedwait(ENDING, LONGEST_END_S)
