"""The program that turns Joys into Twists, and its load_manifest."""

from __future__ import annotations

from tutorial_check import Submission, Wrong, find_script

from ..task import NAME, PACKAGE
from .record import known_package


def main_script(submission: Submission) -> str:
    """Return the Joy-to-Twist program; it is not joy2twist.py if that is the first version."""
    script, scripts = find_script(submission, PACKAGE, NAME), submission.programs(PACKAGE)
    facts = submission.facts_of(PACKAGE, script)
    if facts is None:
        return script  # not Python, which C13 reports
    is_first = "Subscriber" in facts.calls and not {"Publisher", "publish"} & set(facts.calls)
    is_whole = any(name.startswith("sensor_msgs") for name in facts.imports)
    if is_first and is_whole and not any("Twist" in name for name in facts.imports):
        both = [p for p, f in scripts.items() if {"Publisher", "Subscriber"} <= set(f.calls)]
        # A class, of section 6.2, comes last.
        return min(both, key=lambda p: any(c.is_node for c in scripts[p].classes), default=script)
    return script


def check_manifest(submission: Submission, script: str) -> None:
    """Check that roslib.load_manifest names a package that exists. Raises Wrong."""
    facts = submission.scripts(PACKAGE).get(script)
    call = facts.first("load_manifest") if facts else None
    name = call.words[0] if call and call.words else ""
    # The value of a variable, as in PKG = "joy2twist", shows only when the program runs.
    packages = [package.name for package in submission.packages]
    is_known = not facts or name in ("", *facts.names, *packages)
    if call and not is_known and not submission.recording(known_package, name).is_known:
        expected = "roslib.load_manifest names a package that exists"
        named = submission.task.name_of(PACKAGE)
        hint = f"load_manifest('{named}'); or delete the line: catkin no longer needs it"
        raise Wrong(expected, f"ResourceNotFound: {name}", f"{script}:{call.line}", hint)
