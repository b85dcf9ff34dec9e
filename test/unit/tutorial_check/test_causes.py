"""From an error to the cause."""

import pytest

from tutorial_check.causes import explain, misspelt, syntax_hint


@pytest.mark.parametrize(
    "error, word",
    [
        ("NameError: name 'pub' is not defined", "global"),
        ("NameError: name 'msg' is not defined. Did you mean: 'msq'?", "msq"),
        ("ModuleNotFoundError: No module named 'std_msg'", "std_msgs.msg"),
        ("TypeError: callback() missing 1 required positional argument: 'data'", "without ()"),
        ("TypeError: not all arguments converted during string formatting", "as many %.2f"),
        (
            "rospy.exceptions.ROSInitException: client code must call rospy.init_node() first",
            "init_node",
        ),
        (
            "ImportError: cannot import name 'Twist' from 'geometry_msgs' (/x/__init__.py)",
            "in .msg: from geometry_msgs.msg import Twist",
        ),
        (
            "ImportError: cannot import name 'Joy' from 'std_msgs.msg' (/x/msg/__init__.py)",
            "Joy is in sensor_msgs: from sensor_msgs.msg import Joy",
        ),
        (
            "ImportError: cannot import name 'twist' from 'geometry_msgs.msg' (/x/msg/__init__.py)",
            "capitals",
        ),
        (
            "NameError: name 'Twist' is not defined. Did you mean: 'twist'?",
            "Twist is not imported: from geometry_msgs.msg import Twist",
        ),
        ("rospkg.common.ResourceNotFound: joy2twst", "joy2twst"),
    ],
)
def test_causes(error, word):
    assert word in explain(error)


def test_an_unknown_error_is_not_explained():
    assert explain("ZeroDivisionError: division by zero") == ""


@pytest.mark.parametrize(
    "message, text, word",
    [
        ("invalid syntax", "from std msgs.msg import String", "underscores"),
        ("Missing parentheses in call to 'print'", "print data", "Python 2"),
        ("invalid character", "x = “a”", "curly"),
        ("expected ':'", "def f()", "ends with :"),
        ("'(' was never closed", "f(", "bracket"),
        ("unexpected indent", "  x = 1", "indent"),
    ],
)
def test_syntax(message, text, word):
    assert word in syntax_hint(message, text)


def test_a_name_like_the_one_that_is_missing():
    names = {"msq": 10, "data": 8, "sub": 20}
    assert "msq in line 10" in misspelt("NameError: name 'msg' is not defined", names)
    assert "data in line 8" in misspelt("NameError: name 'date' is not defined", names)
    assert not misspelt("NameError: name 'Twist' is not defined", {"twist": 9})  # never imported
    for error in ("name 'pub' is not defined", "name 'msq' is not defined", "IndexError: list"):
        assert not misspelt(error, names)
