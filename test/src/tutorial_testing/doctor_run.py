"""Runs the doctor as a user does."""

import re
import time

from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program

LONGEST_S = 15.0
LINE = r"^(ok|wrong|unknown) +(\w+) +\S.*$"


def doctor(test, **environment):
    """Return (exit code, {level: lines}) of a run, which exits in time and without a traceback."""
    began_s = time.monotonic()
    with Program(node_path("tutorial_tools", "doctor.py"), **environment) as program:
        code = program.wait()
        took_s = time.monotonic() - began_s
        output = program.output
    *lines, summary = output.splitlines()
    test.assertRegex(summary, r"^doctor: \d+ ok, \d+ wrong, \d+ unknown$", output)
    test.assertNotIn("Traceback", output)
    test.assertLess(took_s, LONGEST_S)
    levels = {"ok": [], "wrong": [], "unknown": []}
    for line in lines:
        said = re.match(LINE, line)
        test.assertTrue(said, line)
        levels[said[1]].append(line)
    return code, levels
