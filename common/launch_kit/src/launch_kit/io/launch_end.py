"""The normal end of a node ends the launch, as Ctrl-C does; see README.md."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

from launch_kit.command_line import starting
from launch_kit.io.parent import command_line

ENDING = (signal.SIGINT, signal.SIGTERM)  # what roslaunch ends a node with
LONGEST_END_S = 60.0  # roslaunch kills what still runs after some 20 s


def main() -> None:
    """Run the node of the command line; at its normal end interrupt roslaunch, and wait."""
    command, ended = sys.argv[1:], threading.Event()
    for number in ENDING:  # both go to the node, too, which has its own handlers
        signal.signal(number, lambda *_: ended.set())
    code = subprocess.call(command)
    signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    if ended.is_set() or code != 0 or not starting(command_line()):
        sys.exit(code if code >= 0 else 128 - code)
    name = next((word[8:] for word in command if word.startswith("__name:=")), command[0])
    print(f"roslaunch: {name} has finished, which ends this launch", file=sys.stderr)
    os.kill(os.getppid(), signal.SIGINT)
    # A node that exits before roslaunch starts to end is reported as one that has died.
    signal.sigtimedwait(ENDING, LONGEST_END_S)
