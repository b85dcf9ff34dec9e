"""What an error most often means, and what to do. Pure."""

from __future__ import annotations

import difflib
import re
from typing import Collection, Mapping

from tutorial_check.source.debian_packages import MODULES, advice, package_of_module
from tutorial_check.source.python2 import porting
from tutorial_check.source.python_facts import PythonFacts

# The messages of the handout, and what else its packages are often asked for: the package of each.
HOMES = {
    "Joy": "sensor_msgs",
    "Twist": "geometry_msgs",
    "Vector3": "geometry_msgs",
    "String": "std_msgs",
    "Float32": "std_msgs",
}
UNDEFINED = r"name '(\w+)' is not defined"
NO_VECTOR = r"'(?:float|int)' object has no attribute '[xyz]'"  # where one should be
# Where a name is another module than was meant.
NOT_MEANT = re.compile(
    r"module '(\w+)[\w.]*' has no attribute|from (?:partially initialized module )?'(\w+)[\w.]*'"
    r"|'(\w+)' is not a package"
)
# A pattern, and below it what to do; the first that fits counts. It is looked for in the error and, in
# a line below that, the program's line.
MISSING_IMPORTS = r"""
cannot import name '(?P<m>MESSAGE)' from 'HOME'
    messages are in .msg: from HOME.msg import {m}
cannot import name '(?P<m>MESSAGE)' from
    {m} is in HOME: from HOME.msg import {m}
name '(?P<m>MESSAGE)' is not defined
    {m} is not imported: from HOME.msg import {m}
"""
CAUSES = r"""
No module named 'joy[.']|cannot import name '\w+' from 'joy[.']
    Joy is in sensor_msgs since Hydro: from sensor_msgs.msg import Joy
No module named '(?P<m>std|sensor|geometry|nav)(?:_?(?:msgs?|messages?))?(?:\.\w+)?'
    the module is written with _msgs: from {m}_msgs.msg import ...
No module named '(?P<n>[^']+)\.(?P<m>[^'.]+)'
    {n} has no module {m}: look at the spelling; or the file was not handed in
cannot import name '(?P<m>[^']+)' from '(?P<n>[^']+)'
    {n} has no {m}: look at the spelling, capitals count
client code must call rospy\.init_node|node has not been initialized
    rospy.init_node(...) must come before the first use of ROS: before Subscriber and Publisher
name 'pub' is not defined
    pub belongs to another function: write `global pub` where it is made, before the subscriber
(?:name|local variable) 'data' (?:is not defined|referenced)
    the callback's parameter and what it uses must have one name: data
name '(?P<m>[^']+)' is not defined\. Did you mean: '(?P<n>[^']+)'
    the program knows {n}, not {m}: one name for one thing
name '(?P<m>rospy|roslib)' is not defined
    write `import {m}` at the top
name '(?P<m>callback|shutdown)' is not defined
    within a class it is self.{m}
name '(?P<m>[^']+)' is not defined
    {m} is used but never defined: look at its spelling, and at `self.` or `global`
serialize\(\) missing
    Twist is the kind, Twist() is a message: write the (), and so for String()
(?P<m>\w+)\(\) missing (?P<n>\d+) required positional argument
    hand over {m} without (), with which Python calls it now; a method has self first
(?P<m>\w+)\(\) takes (?P<n>\d+) positional arguments? but
    {m} gets another number of arguments: a method has self first, a callback gets the message
'tuple' object is not callable
    axes is a list of numbers: axes[1], with square brackets
tuple index out of range|list index out of range
    the handout's joystick has 6 axes, 0 to 5, and 12 buttons: look at the number in [ ]
tuple indices must be integers
    axes is a list: axes[1], a number without quotes in square brackets
member_descriptor|type object 'Twist' has no attribute
    Twist is the kind, Twist() is a message: write the ()
expected \[geometry_msgs/Vector3\]|wrong type|field linear must be|invalid .*Twist
    publish the Twist: pub.publish(msg)
'float' object has no attribute|Invalid number of arguments
    publish the Twist message itself: pub.publish(msg)
(?:not all arguments converted|not enough arguments for).*\n.*%\s*\w+\.axes\[
    % data.axes, all of it: leave [ ] out
(?:not all arguments converted|not enough arguments for).*\n.*axes
    as many %.2f as there are axes: 6 with the switch at D, 8 at X
not all arguments converted|not enough arguments for format string
    one % for each value: rospy.loginfo("I heard %s", data.data)
must be real number, not (?:Joy|tuple|list)
    % needs the numbers: % data.axes, with one %.2f for each
field data must be of type bytes or an ascii string
    a String carries text: pub.publish("hello %s" % value)
'(?P<m>Joy|Twist|String|_?Vector3)' object has no attribute '(?P<n>[^']+)'
    a {m} has no field {n}: rosmsg show lists its fields
'(?P<m>\w+)' object has no attribute '(?P<n>[^']+)'
    the object has no {n}: look at its spelling, at `self.`, and at what is made first
module 'rospy[\w.]*' has no attribute '(?P<m>[^']+)'
    rospy has no {m}: look at the spelling, capitals count (rospy.Publisher, rospy.loginfo)
ResourceNotFound: (?P<m>\S+)
    roslib.load_manifest names {m}, which is no package: write your package, or delete the line
unexpected keyword argument '(?P<m>[^']+)'
    {m} is not the name of a parameter: look at its spelling
'NoneType' object
    a value is None. Did you call a function, with (), where you meant to pass it?
ROSInitException
    rospy.init_node(...) is called once, before all else
unsupported operand .*'(?:function|method)'|can only concatenate str \(not \"(?:function|method)
    () is missing: a function is called by them, as in rospy.get_caller_id()
can only concatenate str|unsupported operand
    text and number do not add: use % or a comma in loginfo
PermissionError|Read-only file system|Permission denied
    the program writes where it may not: here it may write in its home folder only
"""
SYNTAX = r"""
\A.*U\+00A0|\n.*\xa0
    invisible blanks came from the PDF: type them again, or sed -i 's/\xc2\xa0/ /g' FILE
\n.*[‘’“”]
    curly quotes came from the PDF: type " or ' instead
\A.*invalid character '(?P<m>[□₽])'
    {m} is a mark of the editor in the PDF: delete it
\A.*invalid character '(?P<m>.)'
    {m} came from the PDF, or a text program: type - for a dash, ' for a quote, * for a cross
\A.*invalid (?:non-printable )?character
    a character of this line only looks right, or like nothing: type the line again
\n.*(?:(?:std|sensor|geometry|nav) msgs|(?:is|on) shutdown|get (?:name|time|caller id))
    the PDF shows underscores as gaps: write _ (sensor_msgs, init_node, queue_size)
\n.*(?:init node|queue size|load manifest|cmd vel|hello str)
    the PDF shows underscores as gaps: write _ (sensor_msgs, init_node, queue_size)
\A.*(?:indent|inconsistent use of tabs)
    indent with four spaces, every line of a block alike, and never with tabs
\A.*expected ':'|\n(?:def|class|if|while|try|except|for|else)\b[^:]*$
    a line with def, class, if, while, try or except ends with :
\A.*(?:never closed|unmatched|EOF)
    a bracket is opened and not closed, here or in the line before
\A.*(?:unterminated|EOL)
    a quote is opened and not closed
\A.*(?:name '(?P<m>\w+)' is (?:assigned to|used prior to) .*global)
    `global {m}` is the first line of the function
\A.*name '(?P<m>\w+)' is parameter and global
    a parameter needs no `global {m}`
\A.*(?:'(?P<m>return|break|continue)' (?:outside|not properly))
    {m} stands outside of its function or loop: indent it as the lines that belong to it
.
    Python cannot read this line; the mistake can also be in the line before
"""


def _rows(text: str) -> list[tuple[str, str]]:
    lines = text.strip("\n").split("\n")
    return [(pattern, words.strip()) for pattern, words in zip(lines[::2], lines[1::2])]


IMPORTS = [MISSING_IMPORTS.replace("MESSAGE", one).replace("HOME", HOMES[one]) for one in HOMES]
NO_KEYBOARD = "there is no keyboard here (stdin is empty): the program has to work without a key"
TYPED = r"termios\.error|Inappropriate ioctl|EOF when reading a line|_curses\.error", NO_KEYBOARD
ROWS = [TYPED, *(row for text in (*IMPORTS, CAUSES) for row in _rows(text))]
# Modules that may have been meant by one that is not there.
COMMON = [*MODULES.split(), *HOMES.values(), "nav_msgs", "rospy", "roslib", "math", "time", "numpy"]


def _explained(rows: list[tuple[str, str]], text: str) -> str:
    for pattern, words in rows:
        found = re.search(pattern, text)
        if found:
            return words.format(**{key: value for key, value in found.groupdict().items() if value})
    return ""


def explain(error: str, text: str = "", file: str = "FILE") -> str:
    """Return what an error most often means here, in a line of that text of a file; or empty."""
    found = re.search(r"No module named '([^'.]+)'", error)
    hint = porting(error, text, file) or _explained(ROWS, f"{error}\n{text}")
    return hint or (_absent(found[1]) if found else "")


def syntax_hint(message: str, text: str, file: str = "FILE") -> str:
    """Return what a SyntaxError most often means here. text: the message's line of the program."""
    return porting(message, text, file) or _explained(_rows(SYNTAX), f"{message}\n{text}")


def _absent(module: str) -> str:
    """Return what to do about a module that is not there."""
    near = difflib.get_close_matches(module, COMMON, 1, 0.75)
    hint = f"there is no {module} here: hand in your own file with the program, or install it"
    if near:
        hint = f"there is no module {module}: is {near[0]} meant?"
    return advice(module, package_of_module(module)) or hint


def with_import(line: str, message: str, facts: PythonFacts) -> str:
    """Return what to write, with the import of the message where the program lacks that."""
    lacks = message not in facts.names
    return f"{line}, and at the top: from {HOMES[message]}.msg import {message}" if lacks else line


def traced(error: str, line: int, facts: PythonFacts) -> tuple[int, str]:
    """Return (line to blame, what to do) as far as the program's text shows it; else (line, "").

    line: where the error came up, or 0.
    """
    for name, (place, value) in facts.attributes.items():
        part = {"linear": "x", "angular": "z"}.get(name.rpartition(".")[2])
        if part and not value.endswith("()") and re.search(NO_VECTOR, error):
            return place, f"{name} has three parts: {name}.{part} = ..."
    found = re.search(UNDEFINED, error)
    if not found:
        return line, ""
    if found[1] in facts.inner_names and line in facts.loose:
        function = facts.loose[line]
        return line, f"this line stands outside of {function}: indent it as those within"
    if f"self.{found[1]}" in facts.attributes:
        return line, f"within a class it is self.{found[1]}"
    return line, misspelt(found[1], facts.names)


def hider(error: str, script: str, others: Collection[str]) -> tuple[str, str]:
    """Return (file, what to do) if a file beside the script hides a package; else ("", "")."""
    found = NOT_MEANT.search(error)
    name = next(filter(None, found.groups()), "") if found else ""
    beside = f"{script.rpartition('/')[0]}/{name}.py".lstrip("/")
    if not name or beside not in others:
        return "", ""
    hint = f"{beside} hides the package {name}: Python looks beside the program first; "
    if beside == script:
        return "", f"{hint}give the program, or what it imports, another name"
    return beside, f"{hint}rename it"


def misspelt(name: str, names: Mapping[str, int]) -> str:
    """Return which of the program's names {name: line} was meant by an undefined one, or empty."""
    known = name in names or name in HOMES
    for near in [] if known else difflib.get_close_matches(name, names, 3, 0.6):
        if near[0].lower() == name[0].lower():
            return f"{near} in line {names[near]}, {name} here: one name for one thing"
    return ""
