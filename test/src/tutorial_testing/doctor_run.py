"""Run the doctor as a user does."""

import re
import time
import unittest

from tutorial_testing.nodes import node_path
from tutorial_testing.processes import Program

LONGEST_S = 15.0
LINE = r"^(ok|wrong|unknown) +(\w+) +\S.*$"


class DoctorTest(unittest.TestCase):
    def doctor(self, **environment):
        """Return (exit code, {level: lines}) of a run that exits in time, without a traceback."""
        began_s = time.monotonic()
        with Program(node_path("tutorial_tools", "doctor.py"), **environment) as program:
            code = program.wait()
            took_s = time.monotonic() - began_s
            output = program.output
        *lines, summary = output.splitlines()
        self.assertRegex(summary, r"^doctor: \d+ ok, \d+ wrong, \d+ unknown$", output)
        self.assertNotIn("Traceback", output)
        self.assertLess(took_s, LONGEST_S)
        levels = {"ok": [], "wrong": [], "unknown": []}
        for line in lines:
            said = re.match(LINE, line)
            self.assertTrue(said, line)
            levels[said[1]].append(line)
        return code, levels

    def wrong(self, *words, **environment):
        """Check that one of the lines that are wrong has these words; return all of them."""
        code, levels = self.doctor(**environment)
        self.assertEqual(code, 1)
        found = any(all(word in line for word in words) for line in levels["wrong"])
        self.assertTrue(found, levels)
        return levels["wrong"]
