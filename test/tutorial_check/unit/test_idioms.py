"""What a hint prints a student to write, in Python and in C++."""

import ast

import pytest

from tutorial_check.submission.cpp_tree import below, parsed
from tutorial_check.submission.idioms import CPP, HOMES, PYTHON
from tutorial_testing.claims import claim


@claim("A hint's line has the language of the student's program")
@pytest.mark.parametrize("kind", HOMES)
def test_the_lines_of_hints_are_of_their_language(kind):
    made = ("subscriber", "publisher")
    for way in made:
        ast.parse(getattr(PYTHON, way)("/joy", kind))
        line = getattr(CPP, way)("/joy", kind)
        assert not parsed(f"int main() {{ {line}; }}").has_error, line
    assert "rospy" not in " ".join(getattr(CPP, way)("/joy", kind) for way in made)
    ast.parse(PYTHON.imported(kind))
    assert below(parsed(CPP.imported(kind) + "\n"), "preproc_include")
