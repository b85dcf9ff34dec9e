"""What a Python file says of itself, read as Python reads it and never run. Pure."""

import ast
import re
from dataclasses import dataclass, field

# In which a file is written, from a comment in the first or second line (PEP 263).
CODING = re.compile(rb"(?:[ \t\f]*(?:#[^\n]*)?\n)??[ \t\f]*#[^\n]*?coding[:=][ \t]*([-\w.]+)")


@dataclass
class Call:
    """rospy.Publisher(...), rospy.Subscriber(...) and their like."""

    line: int
    words: list  # the arguments as text, strings without quotes
    names: dict  # the same of keyword arguments


@dataclass
class PythonFacts:
    """What a file contains."""

    error: str = ""
    error_line: int = 0
    error_text: str = ""
    calls: dict = field(default_factory=dict)  # last part of the name -> [Call]
    classes: list = field(default_factory=list)  # [ClassFacts]
    globals: list = field(default_factory=list)  # lines of `global`
    broad_excepts: list = field(default_factory=list)  # lines of except: and except Exception:
    imports: set = field(default_factory=set)
    has_main: bool = False
    odd_main: tuple = ()  # (line, text) of an `if` that is meant to be that of __main__, and is not
    names: dict = field(default_factory=dict)  # what the program makes, or is given -> first line
    functions: dict = field(default_factory=dict)  # of those the functions and methods
    loops: list = field(default_factory=list)  # lines of `while`
    bare_names: list = field(default_factory=list)  # (line, text) of statements that do nothing

    def first(self, name):
        """The first call of that name, or None."""
        return next(iter(self.calls.get(name, [])), None)

    @property
    def deaf(self):
        """The first Subscriber that is given no callback, or None."""
        return next(
            (
                call
                for call in self.calls.get("Subscriber", [])
                if len(call.words) == 2 and "callback" not in call.names
            ),
            None,
        )

    @property
    def is_class_program(self):
        """Whether it has a class that deals with ROS, or is meant to."""
        return any(one.is_node for one in self.classes)


@dataclass
class ClassFacts:
    """A class of the file."""

    name: str
    line: int
    methods: list
    instantiated: bool
    is_node: bool
    attributes_called: set
    attributes: set  # that an object has, besides methods
    bases: set  # but object


def _text(node):
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return f"{_text(node.value)}.{node.attr}"
    if isinstance(node, ast.Call):
        return f"{_text(node.func)}()"
    if isinstance(node, ast.Lambda):
        return "lambda"
    return type(node).__name__


def _last(node):
    return _text(node.func).rsplit(".", 1)[-1]


def unreadable(data):
    """(line, what is there) of the first thing in a file that is not of its coding; None if all is."""
    declared = CODING.match(data)
    coding = declared[1].decode() if declared else "utf-8"
    try:
        data.decode(coding)
    except UnicodeError as error:
        start = getattr(error, "start", 0)
        what = f"the byte 0x{data[start]:02x}, which is not {coding.upper()}"
        return data.count(b"\n", 0, start) + 1, what
    except LookupError:
        return data.count(b"\n", 0, declared.end()) + 1, f"a coding that is none, {coding}"
    return None


def read_python(text):
    """The PythonFacts of a file's text."""
    facts = PythonFacts()
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError) as error:
        facts.error = getattr(error, "msg", None) or str(error)
        facts.error_line = getattr(error, "lineno", 0) or 0
        lines = text.splitlines()
        if 0 < facts.error_line <= len(lines):
            facts.error_text = lines[facts.error_line - 1].strip()
        return facts
    called = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            called.add(_last(node))
            facts.calls.setdefault(_last(node), []).append(
                Call(
                    node.lineno,
                    [_text(word) for word in node.args],
                    {word.arg: _text(word.value) for word in node.keywords if word.arg},
                )
            )
        elif isinstance(node, ast.Global):
            facts.globals.append(node.lineno)
        elif isinstance(node, ast.ExceptHandler):
            if node.type is None or _text(node.type) in ("Exception", "BaseException"):
                facts.broad_excepts.append(node.lineno)
        elif isinstance(node, ast.Import):
            facts.imports.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            facts.imports.update(f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.While):
            facts.loops.append(node.lineno)
        elif isinstance(node, ast.If) and "__name__" in ast.dump(node.test):
            facts.has_main = True
        elif isinstance(node, ast.Expr) and isinstance(node.value, (ast.Attribute, ast.Name)):
            facts.bare_names.append((node.lineno, _text(node.value)))
    facts.names = _names(tree)
    facts.functions = {
        node.name: node.lineno for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)
    }
    facts.odd_main = _odd_main(tree, text, facts.names)
    for calls in facts.calls.values():
        calls.sort(key=lambda call: call.line)
    facts.classes = [
        _class_facts(node, called) for node in ast.walk(tree) if isinstance(node, ast.ClassDef)
    ]
    return facts


def _names(tree):
    """{name: first line} of variables, parameters, functions, classes and imports."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            found.append((node.lineno, node.id))
        elif isinstance(node, ast.arg):
            found.append((node.lineno, node.arg))
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.append((node.lineno, node.name))
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            found += [(node.lineno, each.asname or each.name) for each in node.names]
    return {name: line for line, name in sorted(found, reverse=True)}


def _odd_main(tree, text, names):
    """(line, text) of `if __name__ == ' main ':` and its like; empty if there is none."""
    for node in tree.body:
        if not (isinstance(node, ast.If) and isinstance(node.test, ast.Compare)):
            continue
        left, right = _text(node.test.left), _text(node.test.comparators[0])
        if left in names or left.strip("_") != "name" or right.strip(" _") != "main":
            continue
        if (left, right) != ("__name__", "__main__"):
            return node.lineno, text.splitlines()[node.lineno - 1].strip()
    return ()


def _class_facts(node, called):
    inside = {_text(part.func) for part in ast.walk(node) if isinstance(part, ast.Call)}
    words = {name.rsplit(".", 1)[-1] for name in inside}
    bases = {_text(base) for base in node.bases}
    return ClassFacts(
        name=node.name,
        line=node.lineno,
        methods=[part.name for part in node.body if isinstance(part, ast.FunctionDef)],
        instantiated=node.name in called,
        # A message or an exception of its own is no node.
        is_node=bool(words & {"Subscriber", "Publisher", "init_node", "publish"})
        and not any(base.endswith(("Exception", "Error")) for base in bases),
        attributes_called={name for name in inside if name.startswith("self.")},
        attributes=_stored(node),
        bases=bases - {"object"},
    )


def _stored(node):
    """What is assigned in a class: names as well as attributes."""
    stored = [part for part in ast.walk(node) if isinstance(getattr(part, "ctx", None), ast.Store)]
    return {getattr(part, "attr", getattr(part, "id", "")) for part in stored}


def unmasked(text):
    """The program with every except: that hides all made to show what it hides; or None."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    lines = text.splitlines()
    hidden = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.ExceptHandler)
        and (node.type is None or _text(node.type) in ("Exception", "BaseException"))
        and node.body[0].lineno > node.lineno
    ]
    if not hidden:
        return None
    for handler in sorted(hidden, key=lambda one: -one.body[0].lineno):
        first = handler.body[0]
        lines.insert(first.lineno - 1, " " * first.col_offset + "raise")
    return "\n".join(lines) + "\n"


def without_name(text, name):
    """The program without something that it imports; None if it does not import it by name."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    lines = text.splitlines()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and name in {
            each.asname or each.name for each in node.names
        }:
            line = lines[node.lineno - 1]
            margin = line[: len(line) - len(line.lstrip())]
            lines.insert(node.end_lineno, f"{margin}del {name}")
            return "\n".join(lines) + "\n"
    return None


def flipped_anonymous(text, wanted):
    """The program with anonymous=wanted in its init_node; None if it has none that is plain."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return None
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Call) and _last(node) == "init_node"):
            continue
        lines = text.splitlines(keepends=True)
        for word in node.keywords:
            if word.arg == "anonymous" and isinstance(word.value, ast.Constant):
                return _replaced(lines, word.value, str(wanted))
            if word.arg == "anonymous":
                return None
        if node.args:
            last = node.args[-1]
            segment = ast.get_source_segment(text, last)
            return _replaced(lines, last, f"{segment}, anonymous={wanted}") if segment else None
    return None


def _replaced(lines, node, new):
    if node.lineno != node.end_lineno:
        return None
    line = lines[node.lineno - 1].encode()
    lines[node.lineno - 1] = (
        line[: node.col_offset] + new.encode() + line[node.end_col_offset :]
    ).decode()
    return "".join(lines)
