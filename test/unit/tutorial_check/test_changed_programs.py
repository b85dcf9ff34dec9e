"""Programs with one thing changed."""

import pytest

from tutorial_check.changed_programs import flipped_anonymous, unmasked, without_name

PROGRAM = """
import rospy
try:
    rospy.init_node("a", anonymous=False)
except:
    pass
"""


def test_unmasked():
    assert unmasked(PROGRAM) == PROGRAM.replace("except:", "except ():")
    assert unmasked("x = 1\n") is None
    assert unmasked("def (") is None


@pytest.mark.parametrize(
    "handler",
    [
        "\texcept:\n\t\tpass\n",
        "\texcept: pass\n",
        "\texcept Exception as error:\n\t\tprint(error)\n",
        "\texcept BaseException: pass\n",
        "\texcept:\n\t\tif True:\n\t\t\tpass\n",
    ],
)
def test_what_is_hidden_by_tabs_or_in_one_line_is_shown(handler):
    with pytest.raises(ZeroDivisionError):
        exec(unmasked(f"if True:\n\ttry:\n\t\t1 / 0\n{handler}"), {})


def test_flipped_anonymous():
    assert 'init_node("a", anonymous=True)' in flipped_anonymous(PROGRAM, True)
    assert (
        flipped_anonymous('rospy.init_node("é")\n', True)
        == 'rospy.init_node("é", anonymous=True)\n'
    )
    assert flipped_anonymous("rospy.init_node(name, anonymous=choice)", True) is None
    assert flipped_anonymous("x = 1", True) is None


def test_without_a_name_it_lacks_what_it_imported():
    text = "if True:\n    from sensor_msgs.msg import (\n        Joy,\n    )\nprint(Joy)\n"
    lines = without_name(text, "Joy").splitlines()
    assert lines[4] == "    del Joy"
    assert lines[:4] + lines[5:] == text.splitlines()
    assert without_name("import sensor_msgs.msg\n", "Joy") is None
    assert without_name("from x import (\n", "Joy") is None


@pytest.mark.parametrize("odd", ["\f", "\v", "\x1c", "\x85", "\u2028"])
def test_what_ends_no_line_for_python(odd):
    """As text has it that was copied out of a PDF."""
    text = f"# a page{odd}and the next\r\n{PROGRAM}"
    assert 'init_node("a", anonymous=True)' in flipped_anonymous(text, True)
    assert "except ():\n    pass" in unmasked(text)
    assert without_name(f"{text}from m import Joy", "Joy").endswith("from m import Joy\ndel Joy\n")
