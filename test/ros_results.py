#!/usr/bin/env python3
"""Tells what the rostests came to, from the JUnit files that catkin's run_tests leaves.

    ros_results.py FOLDER

Exit code 1 if a test failed, if one was skipped without a reason, or if none ran.
"""

import sys
from pathlib import Path
from xml.etree import ElementTree


def cases(folder):
    """Yield (file, name, outcome, message) for every test case below a folder."""
    for path in sorted(folder.rglob("*.xml")):
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            name = f"{case.get('classname', '')}.{case.get('name', '')}"
            outcome, message = "passed", ""
            for kind in ("skipped", "failure", "error"):
                note = case.find(kind)
                if note is not None:
                    outcome = "skipped" if kind == "skipped" else "failed"
                    message = note.get("message") or note.text or ""
            if outcome == "skipped" and not message.strip():
                outcome, message = "failed", "skipped without a reason"
            yield path, name, outcome, message.strip()


def main():
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for path, name, outcome, message in cases(Path(sys.argv[1])):
        count[outcome] += 1
        if outcome != "passed":
            print(f"{outcome}: {path.stem}: {name}\n    {message}")
    print(", ".join(f"{number} {outcome}" for outcome, number in count.items()))
    sys.exit(bool(count["failed"]) or not count["passed"])


if __name__ == "__main__":
    main()
