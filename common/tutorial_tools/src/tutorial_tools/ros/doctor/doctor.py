"""The command: checks what may keep a robot from moving, and prints a line for each finding."""

import signal
import sys

from tutorial_tools.command.subcommands import parser_of
from tutorial_tools.doctor.facts import OK, UNKNOWN, WRONG
from tutorial_tools.doctor.judgement import judge
from tutorial_tools.ros.doctor.collect import collect


def main() -> None:
    """Show the findings; exit code 1 if something is wrong."""
    parser_of("doctor").parse_args()
    try:
        findings = judge(collect())
    except Exception as error:  # one line instead of a traceback
        sys.exit(f"doctor: cannot go on: {type(error).__name__}: {' '.join(str(error).split())}")
    # From here on nothing writes to a socket: `doctor | head` exits quietly.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    for finding in findings:
        print(finding.line(), flush=True)
    count = {level: sum(f.level == level for f in findings) for level in (OK, WRONG, UNKNOWN)}
    print(f"doctor: {count[OK]} ok, {count[WRONG]} wrong, {count[UNKNOWN]} unknown")
    sys.exit(count[WRONG] > 0)
