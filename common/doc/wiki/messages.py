"""Exercise 1: Num.msg and AddTwoInts.srv, and what catkin_make generates from them."""

import difflib
from dataclasses import dataclass
from typing import Tuple

from tutorial_course.common import PACKAGE, Blame

from tutorial_check.course import check
from tutorial_check.course_kit.client import Client
from tutorial_check.handout.s2.packages import must_build
from tutorial_check.judge.packages import package_of
from tutorial_check.model import Wrong

MESSAGE, SERVICE = ("Num", "msg/Num.msg"), ("AddTwoInts", "srv/AddTwoInts.srv")
WANTED = {MESSAGE: ["int64 num"], SERVICE: ["int64 a", "int64 b", "---", "int64 sum"]}
MACROS = {MESSAGE: "add_message_files", SERVICE: "add_service_files"}


@dataclass(frozen=True)
class Fields:
    """What was generated: "TYPE NAME" of each field."""

    fields: Tuple[str, ...]


def generated(ground, kind) -> Fields:
    """Record the fields of a type."""
    with ground.stage() as stage:
        return Fields(Client(stage).fields(kind))


def check_text(session, what):
    """Look at the file of a type: other fields may stand beside those that are wanted."""
    folder, wanted, (_, path) = package_of(session, PACKAGE).folder, WANTED[what], what
    if not (folder / path).is_file():
        names = [str(each.relative_to(folder)) for each in folder.rglob(f"*{path[-4:]}")]
        found = ", ".join(names) or "none"
        raise Wrong(f"{PACKAGE}/{path}", found, names[0] if names else "", "capitals count")
    lines = [line.partition("#")[0].split() for line in session.text(PACKAGE, path).splitlines()]
    given = [" ".join(line) for line in lines]
    kept = [line for line in given if line in wanted]
    if kept != wanted:
        missing = next((line for line in wanted if line not in given), wanted[-1])
        others = [line for line in given if line and (line not in wanted or line == missing)]
        near = difflib.get_close_matches(missing, others, 1, 0.0)
        where = f"{path}:{given.index(near[0]) + 1}" if near else path
        raise Wrong(" / ".join(wanted), " / ".join(filter(None, given)), where, f"write {missing}")


@check("W1", "Num.msg", "1", look=f"rosmsg show {PACKAGE}/Num", timeless=True)
def message(session):
    """Look at the text."""
    check_text(session, MESSAGE)


@check("W2", "AddTwoInts.srv", "1", look=f"rossrv show {PACKAGE}/AddTwoInts", timeless=True)
def service(session):
    """Look at the text."""
    check_text(session, SERVICE)


@check("W3", "package.xml: message_generation, message_runtime", "1", timeless=True)
def manifest(session):
    """Look at the dependencies."""
    depends, file = package_of(session, PACKAGE).depends, Blame(session, PACKAGE, "package.xml")
    for name, kind in (("message_generation", "build"), ("message_runtime", "exec")):
        if name not in depends:
            hint = f"<{kind}_depend>{name}</{kind}_depend>, and not in a comment"
            raise file.wrong(f"{name} message_ depend>", f"a dependency on {name}", "none", hint)


@check("W4", "catkin_make builds", "1", "W1 W2", look="catkin_make")
def builds(session):
    """Build."""
    must_build(session)


@check("W5", "both are generated", "1", "W4", look=f"rosmsg show {PACKAGE}/Num")
def are_generated(session):
    """Look for what CMakeLists.txt has left out."""
    for (name, path), macro in MACROS.items():
        try:
            session.recording(generated, f"{PACKAGE}/{name}")
        except Wrong as wrong:
            if "there is no" not in wrong.seen:
                raise
            file = path.rpartition("/")[2]
            listed = file in (package_of(session, PACKAGE).cmake or "")
            words, hint = f"{file} {macro} catkin_package", f"{macro}(FILES {file})"
            if listed:
                words, hint = "generate_messages catkin_package", "generate_messages()"
            text = Blame(session, PACKAGE, "CMakeLists.txt")
            raise text.wrong(words, f"{path} is generated", wrong.seen, hint) from None
