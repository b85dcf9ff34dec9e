#!/usr/bin/python3
"""Reports the outcome of tests from the JUnit files of rostest and catkin's run_tests.

    ros_results.py FOLDER

Exit code 1 if a test failed, if one was skipped without a reason, or if none ran.
"""

import sys
from pathlib import Path
from xml.etree import ElementTree


def outcome(case):
    """Return (passed, failed or skipped, message) of one JUnit test case."""
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
        try:
            suite = ElementTree.parse(path).getroot()
        except ElementTree.ParseError:  # the test was killed while it wrote, or before
            yield path.stem, "failed", "its results are not whole: it was ended from outside"
            continue
        cases = [(case.get("name"), *outcome(case)) for case in suite.iter("testcase")]
        counted = sum(int(suite.get(kind, 0)) for kind in ("errors", "failures"))
        if counted > sum(result == "failed" for _, result, _ in cases):
            # rosunit counts a failure outside of a test method, or in a subTest, but names none.
            cases.append(("?", "failed", f"{counted} failures counted; see the log"))
        for name, result, message in cases:
            # rostest's own file of a .test only repeats what the tests in it report themselves.
            if not (path.name.startswith("rostest-") and result == "passed"):
                yield f"{path.stem}: {name}", result, message


def main():
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for name, result, message in results(Path(sys.argv[1])):
        count[result] += 1
        if result != "passed":
            print(f"{result}: {name}\n    {message}")
    print(", ".join(f"{number} {result}" for result, number in count.items()))
    sys.exit(bool(count["failed"]) or not count["passed"])


if __name__ == "__main__":
    main()
