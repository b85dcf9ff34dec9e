"""From what the compiler printed to the student's line and the usual cause."""

import re
from pathlib import Path

import pytest

from tutorial_check.checking.build_errors import build_error
from tutorial_check.checking.compiler_errors import plain
from tutorial_testing.claims import claim

OUTPUTS = Path(__file__).with_name("compiler_outputs.txt").read_text(encoding="utf-8")
ROWS = [block.splitlines() for block in OUTPUTS.strip().split("\n\n")[1:]]
FAILS = (
    "make[2]: *** [mine/CMakeFiles/talker.dir/build.make:76: "
    "mine/CMakeFiles/talker.dir/src/talker.cpp.o] Error 1\n"
)


@claim("An error of the C++ compiler has the student's line, a plain sentence and its usual cause")
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_an_error_of_the_compiler_has_its_line_and_cause(row, workspace):
    texts = dict(line.split("|", 1) for line in row[1:] if re.match(r"\d+\|", line))
    program = [texts.get(str(number), "") for number in range(1, 50)]
    session = workspace({"src/talker.cpp": "\n".join(program)})
    printed = "\n".join(row[1 + len(texts) : -1])
    source = str(session.source / "mine/src/talker.cpp")
    wrong = build_error(session, f"{printed}\n".replace("@", source) + FAILS)
    line, words = row[-1][2:].split(" ", 1)
    assert (wrong.where, wrong.hint) == (f"mine/src/talker.cpp:{line}", wrong.hint)
    assert words in wrong.hint
    assert not re.search(r"allocator|__cxx11|\[with|\{aka|root", wrong.seen)
