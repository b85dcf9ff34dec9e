"""Why a program ends at once and prints nothing, as far as its text tells. Pure."""

from __future__ import annotations

import re

from tutorial_check.python_facts import PythonFacts


def silent_end(facts: PythonFacts, script: str) -> tuple[str, str]:
    """Return (where, hint) for a program that ends at once, as far as its text tells."""
    for line, text in facts.bare_names:
        if text.endswith(("spin", "listener")):
            return f"{script}:{line}", f"{text} needs its (): {text}()"
    for one in facts.classes:
        if one.is_node and "__init__" not in one.methods:
            odd = next((each for each in one.methods if re.fullmatch(r"_*init_*", each)), None)
            if odd:
                return (
                    f"{script}:{one.line}",
                    f"`def {odd}`: Python calls `__init__`, two underscores on either side",
                )
        if one.is_node and not one.instantiated:
            return (
                f"{script}:{one.line}",
                f"it is never made: {one.name}() under if __name__ == '__main__':",
            )
    if facts.sunken_main:
        return sunken_main(facts, script)
    if "spin" not in facts.calls:
        return script, "rospy.spin() is missing: without it the program comes to its end"
    if not facts.has_main:
        return script, "listener() is never called: if __name__ == '__main__': listener()"
    return script, "is the function called, in the last line, and with ()?"


def sunken_main(facts: PythonFacts, script: str) -> tuple[str, str]:
    """(where, hint) for a line of __main__ that stands within a function; of empty texts if none does."""
    if not facts.sunken_main:
        return "", ""
    line, function = facts.sunken_main
    return (
        f"{script}:{line}",
        f"line {line} stands within {function}(): move it, and what is below it, to the left margin",
    )
