"""The command: looks at all that may keep a robot from moving, one line for each finding."""

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
    except Exception as error:  # one line in place of a traceback, whatever a network does
        sys.exit(f"doctor: cannot go on: {type(error).__name__}: {' '.join(str(error).split())}")
    # No socket is written to from here on: `doctor | head` ends quietly.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    for finding in findings:
        print(finding.line(), flush=True)
    count = {level: sum(f.level == level for f in findings) for level in (OK, WRONG, UNKNOWN)}
    print(f"doctor: {count[OK]} ok, {count[WRONG]} wrong, {count[UNKNOWN]} unknown")
    sys.exit(count[WRONG] > 0)
