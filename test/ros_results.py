#!/usr/bin/python3
"""Tells what the rostests came to, from the JUnit files that catkin's run_tests leaves.

    ros_results.py FOLDER
    ros_results.py FOLDER TESTS

Exit code 1 if a test failed, if one was skipped without a reason, or if none ran. With TESTS, where
the .test files are, only those files are told in which something failed.
"""

import re
import sys
from pathlib import Path
from xml.etree import ElementTree

TEST_NAME = re.compile(r'test-name="(\w+)"')


def outcome(case):
    """(passed, failed or skipped, message) of one JUnit test case."""
    for kind, meaning in (("error", "failed"), ("failure", "failed"), ("skipped", "skipped")):
        note = case.find(kind)
        if note is not None:
            message = (note.get("message") or note.text or "").strip()
            if meaning == "skipped" and not message:
                return "failed", "skipped without a reason"
            return meaning, message
    return "passed", ""


def results(folder):
    """Yield (name, outcome, message) for every test below a folder."""
    for path in sorted(folder.rglob("*.xml")):
        suite = ElementTree.parse(path).getroot()
        cases = [(case.get("name"), *outcome(case)) for case in suite.iter("testcase")]
        counted = sum(int(suite.get(kind, 0)) for kind in ("errors", "failures"))
        if counted > sum(result == "failed" for _, result, _ in cases):
            # rosunit counts a failure outside of a test method, or in a subTest, but names none.
            cases.append(("?", "failed", f"{counted} failures counted; see the log"))
        for name, result, message in cases:
            # rostest's own file of a .test only repeats what the tests in it report themselves.
            if not (path.name.startswith("rostest-") and result == "passed"):
                yield f"{path.stem}: {name}", result, message


def failed(folder, tests):
    """The .test files, sorted, below the folder `tests` in which something failed."""
    names = {name.split(":")[0] for name, result, _ in results(folder) if result == "failed"}
    for path in sorted(tests.rglob("*.test")):
        # A test in the file has its own name; the file itself one that catkin makes of its path.
        own = {f"rosunit-{name}" for name in TEST_NAME.findall(path.read_text(encoding="utf-8"))}
        if names & {*own, f"rostest-ros_{path.parent.name}_{path.stem}"}:
            yield path


def main():
    if len(sys.argv) > 2:
        for path in failed(Path(sys.argv[1]), Path(sys.argv[2])):
            print(path)
        return
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for name, result, message in results(Path(sys.argv[1])):
        count[result] += 1
        if result != "passed":
            print(f"{result}: {name}\n    {message}")
    print(", ".join(f"{number} {result}" for result, number in count.items()))
    sys.exit(bool(count["failed"]) or not count["passed"])


if __name__ == "__main__":
    main()
