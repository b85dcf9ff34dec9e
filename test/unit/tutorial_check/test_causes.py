"""From an error to the cause."""

import pytest

from tutorial_check.causes import explain, hider, misspelt, syntax_hint, traced
from tutorial_check.python_facts import read_python


@pytest.mark.parametrize(
    "error, word",
    [
        ("NameError: name 'pub' is not defined", "global"),
        ("NameError: name 'msg' is not defined. Did you mean: 'msq'?", "msq"),
        ("ModuleNotFoundError: No module named 'std_msg'", "std_msgs.msg"),
        ("TypeError: callback() missing 1 required positional argument: 'data'", "without ()"),
        ("TypeError: Twist.serialize() missing 1 required positional argument: 'buff'", "Twist()"),
        ("TypeError: not all arguments converted during string formatting", "one % for each"),
        ("TypeError: unsupported operand type(s) for +: 'function' and 'str'", "() is missing"),
        ("TypeError: unsupported operand type(s) for +: 'int' and 'str'", "do not add"),
        ('TypeError: can only concatenate str (not "function") to str', "() is missing"),
        ('TypeError: can only concatenate str (not "float") to str', "do not add"),
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
        ("field data must be of type bytes or an ascii string", "a String carries text"),
    ],
)
def test_causes(error, word):
    assert word in explain(error)


BESIDE = ("scripts/a.py", "scripts/rospy.py", "scripts/joy2twist.py", "src/std_msgs.py")


@pytest.mark.parametrize(
    ("error", "script", "file", "word"),
    [
        ("module 'rospy' has no attribute 'spin'", "scripts/a.py", "scripts/rospy.py", "rename"),
        ("partially initialized module 'rospy' has no attribute 'spin'", BESIDE[0], BESIDE[1], ""),
        ("cannot import name 'Rate' from 'rospy' (/x/rospy.py)", BESIDE[0], BESIDE[1], "hides"),
        ("No module named 'joy2twist.a'; 'joy2twist' is not a package", BESIDE[2], "", "another"),
        ("module 'rospy' has no attribute 'spin'", "a.py", "", ""),
        ("module 'std_msgs' has no attribute 'msg'", "scripts/a.py", "", ""),
        ("name 'rospy' is not defined", "scripts/a.py", "", ""),
    ],
)
def test_a_file_that_hides_a_package(error, script, file, word):
    found = hider(error, script, BESIDE)
    assert found[0] == file
    assert word in found[1]


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ('rospy.loginfo("%.2f %.2f" % data.axes)', "as many %.2f as there are axes"),
        ('rospy.loginfo("%.2f %.2f" % data.axes[0])', "leave [ ] out"),
        ('rospy.loginfo("I heard", data.data)', "one % for each value"),
    ],
)
@pytest.mark.parametrize(
    "error",
    [
        "TypeError: not all arguments converted during string formatting",
        "TypeError: not enough arguments for format string",
    ],
)
def test_the_programs_line_tells_which_values(error, line, word):
    assert word in explain(error, line)


def test_an_unknown_error_is_not_explained():
    assert explain("ZeroDivisionError: division by zero") == ""


@pytest.mark.parametrize(
    "message, text, word",
    [
        ("invalid syntax", "from std msgs.msg import String", "underscores"),
        ("Missing parentheses in call to 'print'", "print data", "Python 2"),
        ("invalid character", "x = “a”", "curly"),
        ("invalid character '□' (U+25A1)", "□def talker():", "delete it"),
        ("expected ':'", "def f()", "ends with :"),
        ("'(' was never closed", "f(", "bracket"),
        ("unexpected indent", "  x = 1", "indent"),
        ("nonsense", "x", "cannot read"),
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


CLASS = """class Node():
    def __init__(self):
        self.pub = rospy.Publisher('/cmd_vel', Twist)

    def callback(self, data):
        pub.publish(Twist())
{}
if __name__ == '__main__':
    Node()
"""


def test_within_a_class_a_name_needs_self():
    facts = read_python(CLASS.format(""))
    line, hint = traced("NameError: name 'pub' is not defined", 6, facts)
    assert (line, hint) == (6, "within a class it is self.pub")


FALLEN = """def callback(data):
    rospy.loginfo(data)
msg = Twist()
msg.linear.x = data.axes[1]
def listener():
    global pub
    pub = rospy.Publisher('/cmd_vel', Twist)
    print(data)
if __name__ == '__main__':
    print(data)
"""


@pytest.mark.parametrize(
    ("text", "line", "name", "function"),
    [
        (FALLEN, 4, "data", "callback"),
        (FALLEN, 4, "pub", "callback"),
        (FALLEN, 4, "msg", None),
        (FALLEN, 4, "listener", None),
        (FALLEN, 8, "data", None),
        (FALLEN, 10, "data", None),
        (CLASS.format("    msg.linear.x = data.axes[1]"), 7, "data", "callback"),
        (CLASS.format("    self.pub.publish(msg)"), 7, "self", "callback"),
        (CLASS.format("msg.linear.x = data.axes[1]"), 7, "data", "callback"),
    ],
)
def test_a_line_that_fell_out_of_its_function(text, line, name, function):
    _, hint = traced(f"NameError: name '{name}' is not defined", line, read_python(text))
    assert (f"outside of {function}: indent" in hint) if function else "outside" not in hint


VECTOR = """def callback(data):
    msg = Twist()
    msg.linear = {}
    msg.angular.z = data.axes[0]
    pub.publish(msg)
"""


def test_a_number_for_the_three_parts_of_a_velocity():
    facts = read_python(VECTOR.format("data.axes[1]"))
    error = "AttributeError: 'float' object has no attribute 'x'"
    assert traced(error, 5, facts) == (3, "msg.linear has three parts: msg.linear.x = ...")
    assert traced("AttributeError: 'int' object has no attribute 'x'", 5, facts)[0] == 3
    assert traced(error, 5, read_python(VECTOR.format("Vector3(data.axes[1], 0, 0)"))) == (5, "")
    assert traced("IndexError: tuple index out of range", 3, facts) == (3, "")


@pytest.mark.parametrize(
    ("text", "line", "word"),
    [
        ("def f():\n\xa0\xa0\xa0\xa0x = 1\n", 2, "invisible blanks"),
        ("x\xa0= 1\n", 1, "sed -i 's/\\xc2\\xa0/ /g' FILE"),
        ("x = y\u200b\n", 1, "type the line anew"),
        ("x = 3 \u2013 2\n", 1, "type - for a dash"),
        ("def f():\n    pub = 1\n    global pub\n", 3, "`global pub` is the first line"),
        ("def f():\n    print(pub)\n    global pub\n", 3, "`global pub` is the first line"),
        ("def f(pub):\n    global pub\n", 2, "needs no `global pub`"),
        ("def f():\n    x = 1\nreturn x\n", 3, "return stands outside"),
        ("while True:\n    pass\nbreak\n", 3, "break stands outside"),
    ],
)
def test_what_python_refuses(text, line, word):
    facts = read_python(text)
    assert facts.error_line == line
    # Python 3.8 names no characters.
    assert word in syntax_hint(facts.error, facts.error_text) or facts.error.endswith("identifier")
