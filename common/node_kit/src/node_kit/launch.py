"""Two programs for launch files.

    <param name="names_were_free" command="$(find node_kit)/names_free /fake_turtlebot"/>

names_free: nothing is started while a node of one of these names runs. roslaunch runs the command
while it reads the file, and exits if it fails; roslaunch itself would end the running node.

    <node ... required="true" launch-prefix="$(find node_kit)/ends_launch"/>

ends_launch: the normal end of a node ends the launch, as Ctrl-C does. required="true" alone reports
every end as a process that has died.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

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


def _parent_starts_nodes() -> bool:
    """Return whether the program that reads the launch file starts its nodes."""
    words = Path(f"/proc/{os.getppid()}/cmdline").read_bytes().decode(errors="replace")
    return will_start(words.split("\0"))


def check_names(names: list[str], master_uri: str) -> None:
    """Exit with one line if a node holds one of the names."""
    for name in [re.sub("/+", "/", f"/{given}") for given in names]:
        held = holder(master_uri, name)
        if held:
            sys.exit(
                f"roslaunch: {name} runs already, {held[1]}: end it first (Ctrl-C in its terminal, "
                f"or rosnode kill {name}), or have a master of your own "
                "(export ROS_MASTER_URI=http://localhost:11312)"
            )


def names_free() -> None:
    """Check the names of the command line; the output becomes the value of the parameter."""
    if _parent_starts_nodes():
        check_names(sys.argv[1:], os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER)
    print("true")


def ends_launch() -> None:
    """Run the node of the command line; at its normal end interrupt roslaunch, and wait."""
    command, ended = sys.argv[1:], threading.Event()
    for number in ENDING:  # both go to the node, too, which has its own handlers
        signal.signal(number, lambda *_: ended.set())
    code = subprocess.call(command)
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    if ended.is_set() or code != 0 or not _parent_starts_nodes():
        sys.exit(code if code >= 0 else 128 - code)
    name = next((word[8:] for word in command if word.startswith("__name:=")), command[0])
    print(f"roslaunch: {name} has finished, which ends this launch", file=sys.stderr)
    os.kill(os.getppid(), signal.SIGINT)
    # A node that exits before roslaunch has begun to end is reported as one that has died.
    signal.sigtimedwait(ENDING, LONGEST_END_S)
