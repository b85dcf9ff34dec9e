"""What a program says of itself without being run."""

import subprocess
import sys

import pytest

from tutorial_check.python_facts import read_python
from tutorial_check.python_text import unreadable

PROGRAM = """
import rospy
class Node(object):
    def __init__(self):
        rospy.init_node("a", anonymous=False)
        rospy.Subscriber("/joy", Joy, self.callback)
    def callback(self, data): pass
class Odd(Exception): pass
if __name__ == "__main__":
    try:
        Node()
    except:
        pass
    rospy.spin
"""


def test_facts():
    facts = read_python(PROGRAM)
    assert [one.name for one in facts.classes if one.is_node] == ["Node"]
    assert facts.classes[0].instantiated
    assert facts.classes[0].methods == ["__init__", "callback"]
    assert facts.first("Subscriber").words == ["/joy", "Joy", "self.callback"]
    assert facts.first("init_node").names == {"anonymous": "False"}
    assert facts.has_main
    assert facts.broad_excepts == [12]
    assert facts.bare_names == [(14, "rospy.spin")]


def test_a_syntax_error_has_its_line():
    facts = read_python("import rospy\nfrom std msgs.msg import String\n")
    assert facts.error_line == 2
    assert facts.error_text == "from std msgs.msg import String"


def test_null_bytes_are_an_error_and_no_crash():
    assert read_python("a\0b").error


@pytest.mark.parametrize("odd", ["\f", "\v", "\x1c", "\x85", "\u2028"])
def test_what_ends_no_line_for_python(odd):
    """As text has it that was copied out of a PDF."""
    assert read_python(f"# {odd}\nfrom std msgs.msg import String").error_text.startswith(
        "from std"
    )
    assert read_python(f"# {odd}\nif name == ' main ':\n    pass").odd_main[1].startswith("if name")


def test_names_have_their_first_line():
    names = read_python("import rospy\ndef f(data):\n    msq = 1\n    msq = 2\n").names
    assert names == {"rospy": 1, "f": 2, "data": 2, "msq": 3}


@pytest.mark.parametrize(
    ("line", "is_odd"),
    [
        ("if __name__ == '__main__':", False),
        ("if __name__ == ' main ':", True),
        ("if name == ' main ':", True),
        ("if _name_ == '_main_':", True),
        ("name = 'main'\nif name == 'main':", False),
        ("if __name__ == 'joy2twist':", False),
    ],
)
def test_a_line_of_main_that_is_none(line, is_odd):
    assert bool(read_python(f"import rospy\n{line}\n    pass\n").odd_main) == is_odd


@pytest.mark.parametrize(
    ("data", "line"),
    [
        ("#!x\n# Jörg\n".encode(), None),
        ("#!x\n\n# Jörg\n".encode("latin-1"), 3),
        ("# Jörg\n".encode("latin-1"), 1),
        ("# -*- coding: latin-1 -*-\n# Jörg\n".encode("latin-1"), None),
        ("#!x\n# vim: set fileencoding=cp1252 :\n# Jörg\n".encode("latin-1"), None),
        ("\n\n# coding: latin-1\n# Jörg\n".encode("latin-1"), 4),
        ("x = 1\n# coding: latin-1\n# Jörg\n".encode("latin-1"), 3),
        ("# coding: ascii\n\n# Jörg\n".encode(), 3),
        (b"#!x\n# coding: nonsense\n", 2),
        (b"# coding: hex\n", 1),
        (b"", None),
    ],
)
def test_the_first_byte_that_is_not_of_the_files_coding(tmp_path, data, line):
    """As Python itself has it."""
    found = unreadable(data)
    assert (found and found[0]) == line
    (tmp_path / "program.py").write_bytes(data)
    done = subprocess.run(
        [sys.executable, tmp_path / "program.py"], capture_output=True, check=False
    )
    assert (b"SyntaxError" in done.stderr) == (line is not None), done.stderr


def test_a_warning_is_no_error_and_not_shown(recwarn):
    assert not read_python("x = 1 is 1\ny = '\\d'\n").error
    assert not recwarn


@pytest.mark.parametrize(
    "name, odd",
    [
        ("'joy2twist.py'", (1, "joy2twist.py")),
        ("'joy-node'", (1, "joy-node")),
        ("'joy2twist'", ()),
        ("'a/b'", ()),  # an error
        ("self.name", ()),
        ("f'node.{number}'", ()),
    ],
)
def test_a_name_of_which_ros_warns(name, odd):
    assert read_python(f"rospy.init_node({name}, anonymous=True)").odd_node == odd


@pytest.mark.parametrize(
    ("text", "keeps"),
    [
        ("rospy.Publisher('/cmd_vel', Twist, queue_size=1)", True),
        ("rospy.Subscriber('/joy', Joy, callback, queue_size=1)", True),
        ("rospy.Publisher('/cmd_vel', Twist, queue_size=10)", False),
        ("rospy.Publisher('/cmd_vel', Twist)", False),
    ],
)
def test_a_queue_of_one_keeps_the_newest(text, keeps):
    assert read_python(text).keeps_newest == keeps
