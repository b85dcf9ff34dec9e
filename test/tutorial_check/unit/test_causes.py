"""From an error and a line of the program to the cause."""

import re
import subprocess
import sys

import pytest

from tutorial_check.checking.causes import TABLES, advice, explain, explained, is_lacking
from tutorial_check.checking.launch_errors import package_hint
from tutorial_check.submission.python_facts import PythonFacts
from tutorial_check.submission.tracebacks import first_traceback
from tutorial_testing.claims import claim

FORMAT = "TypeError: not enough arguments for format string"


@claim("An error of Python, in a program that fails or cannot be read, has its cause")
@pytest.mark.parametrize(("error", "line", "word"), [
    ("TypeError: unsupported operand type(s) for +: 'function' and 'str'", "", "() is missing"),
    ('TypeError: can only concatenate str (not "function") to str', "", "() is missing"),
    ('TypeError: can only concatenate str (not "float") to str', "", "do not add"),
    ("cannot import name 'Twist' from 'geometry_msgs' (/x)", "", "in .msg: from g"),
    ("ImportError: cannot import name 'Joy' from 'std_msgs.msg' (/x)", "", "Joy is in sensor"),
    ("NameError: name 'Twist' is not defined. Did you mean: 'twist'?", "", "not imported"),
    ("ModuleNotFoundError: No module named 'std_msg'", "", "from std_msgs.msg import"),
    ("ModuleNotFoundError: No module named 'serail'", "", "is serial meant?"),
    ("ModuleNotFoundError: No module named 'tf.foo'", "", "tf has no module foo"),
    ("No module named 'joy.msg'; 'joy' is not a package", "", "since Hydro"),
    ("ROSException: ROS node has not been initialized yet.", "", "before Subscriber and Pub"),
    (FORMAT, 'rospy.loginfo("%.2f %.2f" % data.axes[0])', "leave [ ] out"),
])  # fmt: skip
def test_an_error_of_python_has_a_cause(error, line, word):
    assert word in explain(error, line)
    assert explain("ZeroDivisionError: division by zero", line) == ""


@claim("A program in Python 2 is named as such, and the command of its hint makes it Python 3")
@pytest.mark.parametrize("line", [
    "print 'x'", "if x: print x", "print >>f, 'x'", "print ('%d') % 5", "exec 'x = 1'",
    "raise ValueError, 'x'", "x = `5`", "if 1 <> 2: pass", "x = 10L", "x = ur'x'", "x = 0777",
    "def f(a, (b, c)): pass", "try: pass\nexcept (IOError, OSError), e: pass", "raw_input()",
    "import urllib2", "import ConfigParser as c", "{}.has_key(1)", "{}.iteritems()",
    "import sys; sys.maxint", "from itertools import izip", "iter([]).next()", "unicode('x')",
])  # fmt: skip
def test_a_program_in_python_2_is_named_as_such(line):
    """Each is a separate program, which Python 3 rejects."""
    facts = PythonFacts(line)
    if facts.error:
        hint = explain(facts.error, facts.error_text, "/x.py", "syntax")
    else:
        with pytest.raises(Exception) as caught:
            exec(line, {"f": sys.stderr})
        hint = explain(repr(caught.value) + str(caught.value), line, "/x.py")
    is_legal_now = sys.version_info >= (3, 14) and "except (" in line
    assert hint.startswith("this is Python 2: 2to3 -w /x.py") or is_legal_now


@claim("A program in Python 2 ...", because="the command of the hint")
def test_the_hint_for_python_2_works(tmp_path):
    """Its command converts what Python 3 rejects; Debian 13 has no other converter."""
    pytest.importorskip("fissix")
    program = tmp_path / "old.py"
    program.write_text("try:\n    print 0777\nexcept IOError, error:\n    print `error`\n")
    hint = explain("name 'xrange' is not defined", "", str(program))
    command = re.search(r"python3 (-m fissix -w \S+)\)", hint)[1].split()
    subprocess.run([sys.executable, *command], check=True, capture_output=True)
    assert not PythonFacts(program.read_text()).error


@pytest.mark.parametrize("line", ["x = f(", "rospy.init_node(`talker')", "x y", "print = (5"])
def test_another_error_is_not_called_python_2(line):
    facts = PythonFacts(line)
    assert "Python 2" not in explain(facts.error, facts.error_text, section="syntax")


@claim("An error of Python, in ...", because="a program that cannot be read")
@pytest.mark.parametrize(("text", "line", "word"), [
    ("x = y\u200b\n", 1, "type the line again"),
    ("x = 3 \u2013 2\n", 1, "type - for a dash"),
    ("x = □y\n", 1, "delete it"),
    ("def f():\n    pub = 1\n    global pub\n", 3, "`global pub` is the first line"),
    ("def f():\n    print(pub)\n    global pub\n", 3, "`global pub` is the first line"),
    ("def f(pub):\n    global pub\n", 2, "needs no `global pub`"),
    ("def f():\n    x = 1\nreturn x\n", 3, "return is outside"),
    ("while True:\n    pass\nbreak\n", 3, "break is outside"),
    ("x y", 1, "cannot read"),
])  # fmt: skip
def test_what_python_cannot_read_has_a_hint(text, line, word):
    facts = PythonFacts(text)
    assert facts.error_line in (line, line + 1)
    # Python 3.8 names no characters and fewer causes.
    known = facts.error not in ("invalid syntax", "unexpected EOF while parsing")
    known = known and not facts.error.endswith("identifier")
    assert word in explain(facts.error, facts.error_text, section="syntax") or not known


OUTPUT = """[ERROR] [1.0]: bad callback: <function callback at 0x7f>
Traceback (most recent call last):
  File "/usr/lib/python3/dist-packages/rospy/topics.py", line 750, in _invoke_callback
    cb(msg)
  File "/tmp/ws/joy2twist/scripts/joy2twist.py", line 12, in callback
    msg.linear.x = data.axes(1)
                   ^^^^^^^^^^^^
TypeError: 'tuple' object is not callable

more
"""


@pytest.mark.parametrize("no_mistake", [
    OUTPUT.replace("TypeError: 'tuple'", "rospy.ROSException: publish() to a closed topic"),
    OUTPUT.replace("TypeError:", "ROSException: topic was closed during publish()"),
    "Traceback (most recent call last):\n",  # the output was cut off here
])  # fmt: skip
def test_an_error_at_the_end_of_rospy_is_no_mistake(no_mistake):
    """rospy closes topics shortly before it announces its shutdown."""
    assert first_traceback(no_mistake, "/tmp/ws/joy2twist") is None
    for both in (no_mistake + OUTPUT, OUTPUT + no_mistake):
        assert first_traceback(both, "/tmp/ws/joy2twist").error.startswith("TypeError: 'tuple' ob")


@claim(
    "An error of CMake, compiler or linker has its line and its cause; the student's own comes "
    "before another package's"
)
@pytest.mark.parametrize(("words", "hint"), [
    ('Cannot specify link libraries for target "use" which is not built by this project.',
     "add_executable(use ...) or add_library(use ...) comes before"),
    ('Cannot add target-level dependencies to non-existent target "use".', "comes before"),
    ('cannot create target "use" because another target with the same name', "name of its own"),
    ("DEPENDS on the catkin package 'tf' which must", "<depend>tf</depend>"),
    ("generate_messages() must be called before catkin_package()", "below generate"),
    ("Messages depends on unknown pkg: tf (Missing", "name tf in find_package"),
    ("undefined reference to `main'", "no int main(...)"),
    ("use without libraries: undefined reference to `f(std::string)'", "the .cpp file"),
    ("undefined reference to `tf::T::T()'", "its package into find_package"),
    ("cannot find -lown: No such file or directory", "add_library(own ...)"),
    ("multiple definition of `main'", "its own add_executable"),
    ("multiple definition of `f()'", "inline"),
])  # fmt: skip
def test_an_error_of_catkin_make_has_a_cause(words, hint):
    assert hint in "".join(explained("catkin_make", words))


@claim("A real package that Debian lacks is not called misspelt")
def test_a_real_package_that_debian_lacks_is_not_called_misspelt():
    """Even if its name resembles an installed package's; a misspelt name is called so."""
    assert is_lacking("turtlebot3_bringup") and not is_lacking("turtlebot_brinup")
    assert package_hint("turtlebot3_bringup").startswith("Debian lacks turtlebot3_bringup; that is")
    assert "is turtlebot_bringup meant?" in package_hint("turtlebot_brinup")
    names = TABLES["REAL"].split()
    assert names == sorted(set(names))
    for name in names:
        assert advice(name, "").startswith(f"Debian lacks {name}; ")
