"""C29 and C30: the program as a class."""

import re
from pathlib import Path

from tutorial_check.class_facts import with_bases
from tutorial_check.exercises import check, conversation
from tutorial_check.exercises.driving import PACKAGE, drive
from tutorial_check.exercises.files import check_file, must_be_one
from tutorial_check.exercises.joy2twist import NAME, check_manifest
from tutorial_check.model import Note, Wrong


def _class_files(session):
    """{path: ClassFacts} of the classes that deal with ROS; of several the likeliest first."""
    scripts = session.scripts(PACKAGE)
    owned = [(path, one) for path, facts in scripts.items() for one in facts.classes]
    bases = {base.rpartition(".")[2] for _, one in owned for base in one.bases}
    found = {}
    for (path, _), one in zip(owned, with_bases([one for _, one in owned])):
        better = path not in found or (found[path].name in bases and one.name not in bases)
        if one.is_node and better and "checked_" not in path:
            found[path] = one
    folder = session.package(PACKAGE).folder

    def unlikely(path):
        """The step before, under joy2twist.py, may be a class already; and there are old copies."""
        return (
            found[path].name in bases,
            not _fits(found[path].name + path),
            bool(re.search(r"(^|/)(old|backup|copy)[^/]*/", path, re.IGNORECASE)),
            "on_shutdown" not in scripts[path].calls,
            not (folder / path).stat().st_mode & 0o100,
            Path(path).name == NAME,
            path,
        )

    return {path: found[path] for path in sorted(found, key=unlikely)}


def _fits(words):
    return bool(re.search(r"joy.*twist", words, re.IGNORECASE))


def program(session):
    """(the program to start, the file with the class, its ClassFacts). Raises Wrong."""
    scripts = session.scripts(PACKAGE)
    files = _class_files(session)
    if not files:
        broken = [path for path, facts in scripts.items() if facts.error and _fits(path)]
        for path in broken:
            check_file(session, PACKAGE, path)
        named = [path for path in scripts if re.search(r"new|class", path, re.IGNORECASE)]
        raise Wrong(
            "a class that subscribes to /joy and publishes on /cmd_vel",
            "no class in any program of joy2twist",
            where=named[0] if named else "",
            hint="class NewJoy2Twist: with __init__(self), callback(self, data), shutdown(self)",
        )
    path, one = next(iter(files.items()))
    folder = session.package(PACKAGE).folder
    if scripts[path].has_main or (folder / path).stat().st_mode & 0o100 or "src/" not in path:
        return path, path, one
    stem = Path(path).stem
    for other, facts in scripts.items():
        if any(stem in word.split(".") for word in facts.imports):
            return other, path, one
    return path, path, one


@check(
    "C29", "the program is a class", "6.2", "C12", look="rosrun joy2twist THE_CLASS", timeless=True
)
def is_class(session):
    """The program is a class."""
    script, path, one = program(session)
    must_be_one(session.package(PACKAGE).folder, Path(script).name)
    check_file(session, PACKAGE, script)
    check_manifest(session, script)
    facts = session.scripts(PACKAGE)[path]
    where = f"{path}:{one.line}"
    expected = "a class with __init__, its callback bound to self, made under __main__"
    odd = next((each for each in one.methods if re.fullmatch(r"_*init_*", each)), None)
    if "__init__" not in one.methods and (odd or not one.bases):
        seen = f"`def {odd}`: Python calls `__init__`" if odd else f"{one.name} has no __init__"
        raise Wrong(
            expected,
            seen,
            where=where,
            hint="def __init__(self): with two underscores on either side",
        )
    made_elsewhere = any(
        one.name in other.calls or script != path for other in session.scripts(PACKAGE).values()
    )
    if not one.instantiated and not made_elsewhere:
        bare = next((line for line, text in facts.bare_names if text == one.name), None)
        raise Wrong(
            expected,
            f"{one.name} is never made",
            where=f"{path}:{bare}" if bare else where,
            hint=f"{one.name}() with (), under if __name__ == '__main__':",
        )
    for call in facts.calls.get("on_shutdown", []):
        word = call.words[0] if call.words else ""
        _check_method(facts, one, word, "rospy.on_shutdown", f"{path}:{call.line}")
    for call in facts.calls.get("Subscriber", []):
        callback = call.words[2] if len(call.words) > 2 else call.names.get("callback", "")
        if callback in one.methods:
            raise Wrong(
                "the callback is bound to the object",
                f"{callback} alone: within a class that is no name",
                where=f"{path}:{call.line}",
                hint=f"self.{callback}",
            )
        _check_method(facts, one, callback, "the Subscriber", f"{path}:{call.line}")
    if facts.globals:
        return Note(
            "a class needs no `global`: self. keeps what its methods share",
            f"{path}:{facts.globals[0]}",
        )
    early = facts.first("on_shutdown")
    if early and early.line < min(
        (call.line for call in facts.calls.get("Publisher", [])), default=0
    ):
        return Note(
            "on_shutdown comes before the publisher: a Ctrl-C in between finds none to stop the robot with"
            " (the handout has it so)",
            f"{path}:{early.line}",
            "first the Publisher, then rospy.on_shutdown",
        )
    return f"{one.name} in {path}"


def _check_method(facts, one, word, taker, where):
    """What is given in place of a method is one, as far as can be told. Raises Wrong."""
    name = word.rsplit(".", 1)[-1]
    if name.endswith("()") and name[:-2] in facts.functions:
        raise Wrong(
            f"{taker} gets the method itself",
            f"{word} is called at once",
            where=where,
            hint=f"without (): {word[:-2]}",
        )
    # Another object's, or an inherited one, is not known here.
    known = any(name in {*each.methods, *each.attributes} or each.bases for each in facts.classes)
    if word != f"self.{name}" or name.endswith("()") or known:
        return
    seen, hint = f"the class has no {name}", f"one name: def {name}(self), or one of "
    hint += ", ".join(one.methods)
    if name in facts.functions:
        seen = f"`def {name}` in line {facts.functions[name]} is no method of the class"
        hint = "indent it like `def __init__`: neither further, nor less"
    raise Wrong(f"{taker} gets a method that exists", seen, where=where, hint=hint)


@check("C30", "the class does what the functions did", "6.2", "C29", look="rostopic echo /cmd_vel")
def behaves(session):
    """As C14 to C17."""
    script, _, _ = program(session)
    seen = drive(session, script)
    notes = [
        conversation.check_displays(session, seen, few_are_enough=True),
        conversation.check_topics(session, seen),
        conversation.check_mapping(session, seen),
        conversation.check_rate(session, seen),
    ]
    return next((note for note in notes if isinstance(note, Note)), None)
