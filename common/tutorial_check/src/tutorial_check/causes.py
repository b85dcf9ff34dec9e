"""What an error most often means, and what to do. Pure."""

import difflib
import re

# The messages of the handout, and what else its packages are often asked for: the package of each.
HOMES = {
    "Joy": "sensor_msgs",
    "Twist": "geometry_msgs",
    "Vector3": "geometry_msgs",
    "String": "std_msgs",
    "Float32": "std_msgs",
}


def _imports(message, home):
    """What the lack of a message's import leads to."""
    line = f"from {home}.msg import {message}"
    return (
        (rf"cannot import name '{message}' from '{home}'", f"messages are in .msg: {line}"),
        (rf"cannot import name '{message}' from", f"{message} is in {home}: {line}"),
        (rf"name '{message}' is not defined", f"{message} is not imported: {line}"),
    )


def with_import(line, message, facts):
    """Return what to write, with the import of the message where the program lacks that."""
    lacks = message not in facts.names
    return f"{line}, and at the top: from {HOMES[message]}.msg import {message}" if lacks else line


UNDEFINED = r"name '(\w+)' is not defined"
NO_VECTOR = r"'(?:float|int)' object has no attribute '[xyz]'"  # where one should be
# What an error most often means here: (pattern, what to do). The first that fits counts. It is looked
# for in the error and, in a line of its own, the program's line.
CAUSES = (
    *(row for message, home in HOMES.items() for row in _imports(message, home)),
    (
        r"No module named '(?P<m>std|sensor|geometry|nav)\w*'",
        "the module is written with _msgs: from {m}_msgs.msg import ...",
    ),
    (
        r"No module named '(?P<m>[^']+)'",
        "nothing is called {m}: look at the spelling in the import line",
    ),
    (
        r"cannot import name '(?P<m>[^']+)'",
        "no message is called {m}: look at the spelling, capitals count",
    ),
    (
        r"client code must call rospy\.init_node",
        "rospy.init_node(...) must come before the first use of ROS",
    ),
    (
        r"name 'pub' is not defined",
        "pub belongs to another function: write `global pub` where it is made, and make it before the subscriber",
    ),
    (
        r"(?:name|local variable) 'data' (?:is not defined|referenced)",
        "the callback's parameter and what it uses must have one name: data",
    ),
    (
        r"name '(?P<m>[^']+)' is not defined\. Did you mean: '(?P<n>[^']+)'",
        "the program knows {n}, not {m}: one name for one thing",
    ),
    (r"name '(?P<m>rospy|roslib)' is not defined", "write `import {m}` at the top"),
    (r"name '(?P<m>callback|shutdown)' is not defined", "within a class it is self.{m}"),
    (
        r"name '(?P<m>[^']+)' is not defined",
        "{m} is used but never made: look at its spelling, and at `self.` or `global`",
    ),
    (
        r"serialize\(\) missing",
        "Twist is the kind, Twist() is a message: write the (), and so for String()",
    ),
    (
        r"(?P<m>\w+)\(\) missing (?P<n>\d+) required positional argument",
        "hand over {m} without (): with them Python calls it now; within a class the first parameter is self",
    ),
    (
        r"(?P<m>\w+)\(\) takes (?P<n>\d+) positional arguments? but",
        "{m} gets another number of arguments: in a class the first parameter is self, and a callback gets the message",
    ),
    (r"'tuple' object is not callable", "axes is a list of numbers: axes[1], with square brackets"),
    (
        r"tuple index out of range|list index out of range",
        "the handout's joystick has 6 axes, 0 to 5, and 12 buttons: look at the number in [ ]",
    ),
    (
        r"tuple indices must be integers",
        "axes is a list: axes[1], a number without quotes in square brackets",
    ),
    (
        r"member_descriptor|type object 'Twist' has no attribute",
        "Twist is the kind, Twist() is a message: write the ()",
    ),
    (
        r"expected \[geometry_msgs/Vector3\]|wrong type|field linear must be|invalid .*Twist",
        "publish the Twist: pub.publish(msg)",
    ),
    (
        r"'float' object has no attribute|Invalid number of arguments",
        "publish the Twist message itself: pub.publish(msg)",
    ),
    (
        r"(?:not all arguments converted|not enough arguments for).*\n.*%\s*\w+\.axes\[",
        "% data.axes, all of it: leave [ ] out",
    ),
    (
        r"(?:not all arguments converted|not enough arguments for).*\n.*axes",
        "as many %.2f as there are axes: 6 with the switch at D, 8 at X",
    ),
    (
        r"not all arguments converted|not enough arguments for format string",
        'one % for each value: rospy.loginfo("I heard %s", data.data)',
    ),
    (
        r"must be real number, not (?:Joy|tuple|list)",
        "% needs the numbers: % data.axes, with one %.2f for each",
    ),
    (
        r"field data must be of type bytes or an ascii string",
        'a String carries text: pub.publish("hello %s" % value)',
    ),
    (
        r"'(?P<m>Joy|Twist|String|_?Vector3)' object has no attribute '(?P<n>[^']+)'",
        "a {m} has no field {n}: rosmsg show lists its fields",
    ),
    (
        r"'(?P<m>\w+)' object has no attribute '(?P<n>[^']+)'",
        "the object has no {n}: look at its spelling, at `self.`, and whether it is made before it is used",
    ),
    (
        r"module 'rospy[\w.]*' has no attribute '(?P<m>[^']+)'",
        "rospy has no {m}: look at the spelling, capitals count (rospy.Publisher, rospy.loginfo)",
    ),
    (
        r"ResourceNotFound: (?P<m>\S+)",
        "roslib.load_manifest names {m}, which is no package: write your package's name, or leave the line out",
    ),
    (
        r"unexpected keyword argument '(?P<m>[^']+)'",
        "{m} is not the name of a parameter: look at its spelling",
    ),
    (
        r"'NoneType' object",
        "something that should be a thing is None: was () written where none belongs?",
    ),
    (r"ROSInitException", "rospy.init_node(...) is called once, before all else"),
    (
        r"unsupported operand .*'(?:function|method)'|can only concatenate str \(not \"(?:function|method)",
        "() is missing: a function is called by them, as in rospy.get_caller_id()",
    ),
    (
        r"can only concatenate str|unsupported operand",
        "text and number do not add: use % or a comma in loginfo",
    ),
    (
        r"PermissionError|Read-only file system|Permission denied",
        "the program writes where it may not; the checker lets it write in its own home folder only",
    ),
)


def explain(error, text=""):
    """What an error most often means here, in a line of that text; empty if nothing is known."""
    for pattern, words in CAUSES:
        found = re.search(pattern, f"{error}\n{text}")
        if found:
            return words.format(**{key: value for key, value in found.groupdict().items() if value})
    return ""


def traced(error, line, facts):
    """(line to blame, what to do) as far as the program's text tells; (line, "") if it does not.

    line: where the error came up, or 0; facts: the PythonFacts.
    """
    for name, (place, value) in facts.attributes.items():
        part = {"linear": "x", "angular": "z"}.get(name.rpartition(".")[2])
        if part and not value.endswith("()") and re.search(NO_VECTOR, error):
            return place, f"{name} has three parts: {name}.{part} = ..."
    found = re.search(UNDEFINED, error)
    if not found:
        return line, ""
    name = found[1]
    if name in facts.inner_names and line in facts.loose:
        return (
            line,
            f"this line stands outside of {facts.loose[line]}: indent it as those within",
        )
    if f"self.{name}" in facts.attributes:
        return line, f"within a class it is self.{name}"
    return line, misspelt(error, facts.names)


# What is said of a name that is another module than was meant.
NOT_MEANT = re.compile(
    r"module '(\w+)[\w.]*' has no attribute|from (?:partially initialized module )?'(\w+)[\w.]*'"
    r"|'(\w+)' is not a package"
)


def hider(error, script, others):
    """(file, what to do) if one of the others, beside the script, hides a package; or ("", "")."""
    found = NOT_MEANT.search(error)
    name = next(filter(None, found.groups()), "") if found else ""
    beside = f"{script.rpartition('/')[0]}/{name}.py".lstrip("/")
    if not name or beside not in others:
        return "", ""
    hint = f"{beside} hides the package {name}: Python looks beside the program first; "
    if beside == script:
        return "", f"{hint}give the library in src another name than the program"
    return beside, f"{hint}rename it"


def misspelt(error, names):
    """Which name was meant by one that is not defined; empty if none is like it.

    names: {name: line} of what the program makes.
    """
    found = re.search(UNDEFINED, error)
    if not found or found[1] in names or found[1] in HOMES:
        return ""
    near = difflib.get_close_matches(found[1], names, 3, 0.6)
    near = [each for each in near if each[0].lower() == found[1][0].lower()]
    if not near:
        return ""
    return f"{near[0]} in line {names[near[0]]}, {found[1]} here: one name for one thing"


NOWHERE = r"(?!)"
# What a SyntaxError most often means: (pattern of its message, of the program's line, what to do). The
# first of which either fits counts.
SYNTAX = (
    (
        r"U\+00A0",
        "\xa0",
        "invisible blanks came from the PDF: type those of this line anew, or sed -i 's/\\xc2\\xa0/ /g' FILE",
    ),
    (
        r"call to 'print'",
        r"^\s*print\s+[^(=]",
        "that is Python 2: print(...) has parentheses",
    ),
    (NOWHERE, "[‘’“”]", "curly quotes came from the PDF: type \" or ' instead"),
    (
        r"invalid character '(?P<m>[□₽])'",
        NOWHERE,
        "{m} is a mark of the editor in the PDF: delete it",
    ),
    (
        r"invalid character '(?P<m>.)'",
        NOWHERE,
        "{m} came from the PDF, or a text program: type - for a dash, ' for a quote, * for a cross",
    ),
    (
        r"invalid (?:non-printable )?character",
        NOWHERE,
        "a character of this line only looks right, or like nothing: type the line anew",
    ),
    (
        NOWHERE,
        r"\b(?:std|sensor|geometry|nav) msgs|init node|queue size|load manifest|cmd vel|is shutdown"
        r"|get time|on shutdown|get name|get caller id|hello str",
        "the PDF shows underscores as gaps: write _ (sensor_msgs, init_node, queue_size)",
    ),
    (
        r"indent|inconsistent use of tabs",
        NOWHERE,
        "indent with four spaces, every line of a block alike, and never with tabs",
    ),
    (
        r"expected ':'",
        r"^(?:def|class|if|while|try|except|for|else)\b[^:]*$",
        "a line with def, class, if, while, try or except ends with :",
    ),
    (
        r"never closed|unmatched|EOF",
        NOWHERE,
        "a bracket is opened and not closed, here or in the line before",
    ),
    (r"unterminated|EOL", NOWHERE, "a quote is opened and not closed"),
    (
        r"name '(?P<m>\w+)' is (?:assigned to|used prior to) .*global",
        NOWHERE,
        "`global {m}` is the first line of the function",
    ),
    (r"name '(?P<m>\w+)' is parameter and global", NOWHERE, "a parameter needs no `global {m}`"),
    (
        r"'(?P<m>return|break|continue)' (?:outside|not properly)",
        NOWHERE,
        "{m} stands outside of its function or loop: indent it as the lines that belong to it",
    ),
)


def syntax_hint(message, text):
    """What a SyntaxError most often means here. text: the message's line of the program."""
    for in_message, in_text, words in SYNTAX:
        found = re.search(in_message, message) or re.search(in_text, text)
        if found:
            return words.format(**found.groupdict())
    return "Python cannot read this line; the mistake can also be in the line before"
