"""What a terminal may show of text from a file or a program."""

import pytest

from node_kit.parameters.arguments import Parser
from node_kit.printable import LONGEST, printable, quotable
from node_kit.ros.lifecycle.start import run


@pytest.mark.parametrize(("text", "shown"), [
    ("plain, ünïcode \u20ac\tand\nlines", "plain, ünïcode \u20ac\tand\nlines"),
    ("\x1b[31mred\x1b[0m", "red"), ("\x1b[2J\x1b[1;1Hcleared", "cleared"),
    ("\x1b]0;a title\x07here", "here"), ("\x1b]0;a title\x1b\\here", "here"),
    ("rung\x07, back\x08, \x9b31m, \0, \r\ud800", "rung, back, 31m, , "),
])  # fmt: skip
def test_escape_sequences_and_control_characters_are_left_out(text, shown):
    assert printable(text) == shown


def test_a_quoted_text_has_a_bounded_length():
    assert quotable("a" * LONGEST) == "a" * LONGEST
    assert quotable("a" * 10**7) == "a" * LONGEST + " ..."


def test_no_line_on_a_mistake_has_an_escape_sequence(capsys, monkeypatch):
    """Such as that of a world file that contains one."""

    def load(_parameters):
        raise ValueError("~world: \x1b[2Jroom: no such file")

    monkeypatch.setattr("node_kit.ros.lifecycle.start._check_master", lambda: None)
    monkeypatch.setattr("node_kit.ros.lifecycle.start._parameters", lambda _name: ({}, set()))
    assert run("node", load, lambda _parameters: None) == 1
    with pytest.raises(SystemExit):
        Parser(prog="program").error("\x1b[31mred")
    lines = capsys.readouterr().err
    assert "no such file" in lines and "red" in lines and "\x1b" not in lines
