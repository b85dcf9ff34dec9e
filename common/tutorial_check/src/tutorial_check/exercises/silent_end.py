"""Why a program ends at once without a word, as far as its text tells. Pure."""

import re


def silent_end(facts, script):
    """Why a program ends at once without a word, as far as its text tells: (where, hint)."""
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
                f"nobody makes one: {one.name}() under if __name__ == '__main__':",
            )
    if facts.sunken_main:
        return sunken_main(facts, script)
    if "spin" not in facts.calls:
        return script, "rospy.spin() is missing: without it the program comes to its end"
    if not facts.has_main:
        return script, "nobody calls listener(): if __name__ == '__main__': listener()"
    return script, "is the function called, in the last line, and with ()?"


def sunken_main(facts, script):
    """(where, hint) for a line of __main__ that stands within a function; of empty texts if none does."""
    if not facts.sunken_main:
        return "", ""
    line, function = facts.sunken_main
    return (
        f"{script}:{line}",
        f"line {line} stands within {function}(): move it, and what is below it, to the left margin",
    )
