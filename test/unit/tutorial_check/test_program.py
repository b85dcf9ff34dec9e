"""The command line."""

import pytest

from tutorial_check.program import parse

BEFORE = ["--floor", "setup.bash", "--in", "ws"]


@pytest.mark.parametrize(
    ("words", "exercises"),
    [
        (["4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["6", "2"], ["2", "6.1", "6.2"]),
        (["4.3", "4"], ["4.2", "4.3", "4.4", "4.5"]),
        (["5"], ["5"]),
    ],
)
def test_a_section_is_all_its_exercises(words, exercises):
    assert parse([*BEFORE, *words]).exercises == exercises


@pytest.mark.parametrize("word", ["7", "", ".", "4.9"])
def test_no_such_exercise(word, capsys):
    with pytest.raises(SystemExit):
        parse([*BEFORE, word])
    assert "no exercise" in capsys.readouterr().err
