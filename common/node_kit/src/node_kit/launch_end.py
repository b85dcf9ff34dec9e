"""For launch files: the normal end of a node ends the launch, as Ctrl-C does.

    <node ... required="true" launch-prefix="$(find node_kit)/ends_launch"/>

required="true" alone reports every end as a process that has died; with this only a failure.
"""

import os
import signal
import subprocess
import sys
import threading

from node_kit.launch_check import reader, will_start

ENDING = (signal.SIGINT, signal.SIGTERM)  # what roslaunch ends a node with
LONGEST_END_S = 60.0  # roslaunch kills whatever still runs after some 20 s


def name_of(command: "list[str]") -> str:
    """Return the name that roslaunch gives the node of a command line."""
    names = [word.partition(":=")[2] for word in command if word.startswith("__name:=")]
    return names[0] if names else command[0]


def main() -> None:
    """Run the node of the command line; at its normal end interrupt roslaunch, and wait."""
    command, ended = sys.argv[1:], threading.Event()
    for number in ENDING:  # both go to the node, too, which has its own handlers
        signal.signal(number, lambda *_: ended.set())
    code = subprocess.call(command)
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    if ended.is_set() or code != 0 or not will_start(reader()):
        sys.exit(code if code >= 0 else 128 - code)
    print(f"roslaunch: {name_of(command)} has finished, which ends this launch", file=sys.stderr)
    os.kill(os.getppid(), signal.SIGINT)
    # A node that exits before roslaunch has begun to end is reported as one that has died.
    signal.sigtimedwait(ENDING, LONGEST_END_S)
