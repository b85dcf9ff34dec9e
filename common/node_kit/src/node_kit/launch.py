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

import contextlib
import difflib
import os
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Iterable
from pathlib import Path

from node_kit.ros.graph.ros_api import holder, known_nodes

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


def read_launch(command: list[str]) -> tuple[list[str], list[str]]:
    """Return the nodes that roslaunch starts by its command line, and a line for each argument
    that it ignores; as far as it can read the files, as it reports what is wrong in them.
    """
    import roslaunch.xmlloader  # noqa: PLC0415 (it takes 0.2 s, which ends_launch need not wait)

    config, known, ignored = roslaunch.config.ROSLaunchConfig(), set(), []
    words = command[[Path(word).name for word in command].index("roslaunch") + 1 :]
    with contextlib.suppress(Exception):  # whatever it is, roslaunch meets it, too
        words = roslaunch._get_optparse().parse_args(words)[1]
        files = roslaunch.rlutil.resolve_launch_arguments(words)
        for file in files:
            loader = roslaunch.xmlloader.XmlLoader(resolve_anon=False)
            loader.param_value = lambda *_: ""  # runs no command: this program is one of them
            loader.load(file, config, argv=words, verbose=False)
            known.update(loader.root_context.resolve_dict.get("arg_doc", ()))
        given = [word for word in words if ":=" in word and not word.startswith("_")]
        wrong = [word for word in given if word.split(":=")[0] not in known]
        ignored = [f"{no_argument(word, files[0], known)} (ignored)" for word in wrong]
    return [f"{node.namespace}{node.name}" for node in config.nodes], ignored


def no_argument(given: str, file: str, known: Iterable[str]) -> str:
    """Return a line on NAME:=VALUE whose name is none of a launch file's arguments."""
    names = ", ".join(f"{name}:=" for name in sorted(known)) or "none"
    near = difflib.get_close_matches(re.split(":?=", given)[0], known, 1)
    meant = f"; did you mean {near[0]}:=?" if near else ""
    return f"{given}: not an argument of {Path(file).name}, which has {names}{meant}"


def _parent() -> list[str]:
    """Return the command line of the program that reads the launch file."""
    words = Path(f"/proc/{os.getppid()}/cmdline").read_bytes().decode(errors="replace")
    return words.rstrip("\0").split("\0")


def named(names: Iterable[str], nodes: Iterable[str]) -> list[str]:
    """Return the nodes that have one of these names, in any namespace."""
    return [node for node in nodes if node.split("/")[-1] in names]


def check_names(names: list[str], started: list[str], master_uri: str) -> None:
    """Exit with one line if a node of such a name runs already, in the namespace of one of ours."""
    for name in named(names, started):
        held = holder(master_uri, name)
        if held:
            sys.exit(
                f"roslaunch: {name} runs already, {held[1]}: end it first (Ctrl-C in its terminal, "
                f"or rosnode kill {name}), or have a master of your own "
                "(export ROS_MASTER_URI=http://localhost:11312)"
            )


def names_free() -> None:
    """Check the names of the command line; the output becomes the value of the parameter."""
    command, names = _parent(), sys.argv[1:]
    master_uri = os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER
    arguments = "--arguments" in names and any(":=" in word for word in command)
    # To read the files takes longer than all else here.
    if will_start(command) and (arguments or named(names, known_nodes(master_uri))):
        started, ignored = read_launch(command)
        check_names(names, started, master_uri)
        for line in ignored if arguments else ():
            print(f"roslaunch: {line}", file=sys.stderr)
    print("true")


def ignored() -> None:
    """Report what was given in vain; the command line has (name, only value, given value) ..."""
    words = sys.argv[1:] if will_start(_parent()) else []
    for name, only, given in zip(words[::3], words[1::3], words[2::3]):
        if given != only:
            line = f"{name}:={given} is ignored: it changes nothing about the simulated robot"
            print(f"roslaunch: {line}", file=sys.stderr)
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
    # A node that exits before roslaunch starts to end is reported as one that has died.
    signal.sigtimedwait(ENDING, LONGEST_END_S)
