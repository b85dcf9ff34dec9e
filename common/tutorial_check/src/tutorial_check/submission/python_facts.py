"""Facts from the text of a Python file, which is parsed and never run."""

from __future__ import annotations

import ast
import re
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Iterable, Iterator, Sequence, Tuple, Union

from tutorial_check.submission.python_text import is_broad, last_name, python_lines, text_of
from tutorial_check.submission.student_files import MOST_BYTES, TOO_LARGE

KEYBOARD = ("input", "raw_input", "tcgetattr", "setraw", "setcbreak", "initscr", "getch", "getchar")
Place = Union[Tuple[int, str], Tuple[()]]  # (line, text), or empty


@dataclass
class Call:
    """A call, such as rospy.Publisher(...)."""

    line: int
    words: list[str]  # the positional arguments as text, without quotes
    names: dict[str, str]  # the keyword arguments, likewise


@dataclass
class ClassFacts:
    """A class of the file."""

    name: str
    line: int
    methods: list[str]
    instantiated: bool
    is_node: bool
    attributes: set[str]  # of an object, without methods
    bases: set[str]  # except object


class PythonFacts:
    """Facts about a file; if Python cannot read it, only the error."""

    def __init__(self, text: str) -> None:
        self.error, self.error_line = "", 0
        if len(text) > MOST_BYTES:
            text, self.error, self.error_line = "", f"the file is {TOO_LARGE}", 1
        self.text = dict(enumerate(python_lines(text), 1))  # {number: line}
        tree = ast.Module([], [])
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                compile(text, "program", "exec")  # refuses more: a late `global`, a lone `return`
                tree = ast.parse(text)
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            self.error = getattr(error, "msg", None) or str(error) or "nested too deeply"
            self.error_line = getattr(error, "lineno", 0) or 0
        self._nodes: list[Any] = list(ast.walk(tree))
        self.functions = {node.name: node.lineno for node in self._of(ast.FunctionDef)}
        self.calls: dict[str, list[Call]] = {}  # {last part of the name: its calls, by line}
        for node in sorted(self._of(ast.Call), key=lambda call: call.lineno):
            words = [text_of(word) for word in node.args]
            names = {word.arg: text_of(word.value) for word in node.keywords if word.arg}
            self.calls.setdefault(last_name(node), []).append(Call(node.lineno, words, names))
        self.classes = [_class_facts(node, set(self.calls)) for node in self._of(ast.ClassDef)]
        inner = [node for function in self._of(ast.FunctionDef) for node in ast.walk(function)]
        self.inner_names = {name for _, name in _made(inner)}  # of functions' variables, parameters
        self.has_main = any(map(_is_main, self._nodes))
        self.loops = [node.lineno for node in self._of(ast.While)]
        self.broad_excepts = list(filter(is_broad, self._of(ast.ExceptHandler)))
        self.imports = {
            f"{node.module}.{alias.name}" if isinstance(node, ast.ImportFrom) else alias.name
            for node in self._of(ast.Import, ast.ImportFrom)
            for alias in node.names
        }

    def _of(self, *kinds: type[ast.AST]) -> list[Any]:
        return [node for node in self._nodes if isinstance(node, kinds)]

    @property
    def error_text(self) -> str:
        return self.text.get(self.error_line, "").strip(" \t")

    @property
    def globals(self) -> list[int]:
        return [node.lineno for node in self._of(ast.Global)]

    @property
    def bare_names(self) -> list[tuple[int, str]]:
        """(line, text) of statements without effect, such as rospy.spin without ()."""
        kinds = (ast.Attribute, ast.Name)
        bare = [node for node in self._of(ast.Expr) if isinstance(node.value, kinds)]
        return [(node.lineno, text_of(node.value)) for node in bare]

    @property
    def sunken_main(self) -> Place:
        """(line, function) of an `if __name__ == '__main__':` that is inside a function."""
        functions = self._of(ast.FunctionDef)
        inner = ((n, f.name) for f in functions for n in ast.walk(f) if isinstance(n, ast.If))
        return next(((node.lineno, name) for node, name in inner if _is_main(node)), ())

    @property
    def odd_main(self) -> Place:
        """(line, text) of `if __name__ == ' main ':` and similar lines."""
        tests = [node.test for node in self._nodes[0].body if isinstance(node, ast.If)]
        for test in (compare for compare in tests if isinstance(compare, ast.Compare)):
            left, right = text_of(test.left), text_of(test.comparators[0])
            is_meant = (left.strip("_"), right.strip(" _")) == ("name", "main")
            if is_meant and left not in self.names and (left, right) != ("__name__", "__main__"):
                return test.lineno, self.text[test.lineno].strip()
        return ()

    @cached_property
    def names(self) -> dict[str, int]:
        """{name: first line} of variables, parameters, functions, classes and imports."""
        names = list(_made(self._nodes))
        names += [(node.lineno, node.name) for node in self._of(ast.FunctionDef, ast.ClassDef)]
        for node in self._of(ast.Import, ast.ImportFrom):
            names += [(node.lineno, alias.asname or alias.name) for alias in node.names]
        return {name: line for line, name in sorted(names, reverse=True)}

    @property
    def attributes(self) -> dict[str, tuple[int, str]]:
        """{"msg.linear.x": (first line, value assigned)}."""
        pairs = [(target, node.value) for node in self._of(ast.Assign) for target in node.targets]
        pairs = [both for both in pairs if isinstance(both[0], ast.Attribute)]
        texts = [(target.lineno, text_of(target), text_of(value)) for target, value in pairs]
        return {name: (line, value) for line, name, value in sorted(texts, reverse=True)}

    @property
    def loose(self) -> dict[int, str]:
        """{line that may lack indentation: the function above it}."""
        functions: dict[int, str] = {}
        for block in self._of(ast.Module, ast.ClassDef):
            above = ""
            for node in block.body:
                inner = [f.name for f in ast.walk(node) if isinstance(f, ast.FunctionDef)]
                if inner:
                    above = inner[-1]
                elif above and not _is_main(node):
                    lines = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                    functions.update(dict.fromkeys(lines, above))
        return functions

    @cached_property
    def called_back(self) -> dict[str, list[int]]:
        """{name: lines} of calls in callbacks, and in what they call."""
        return self.called_by("Subscriber", 2)

    def given(self, name: str, place: int) -> list[tuple[int, str]]:
        """Return (line, callback) of each call of a name. place: the callback's position."""
        calls = self.calls.get(name, [])
        return [(c.line, (c.words[place:] or [c.names.get("callback", "")])[0]) for c in calls]

    def called_by(self, name: str, place: int) -> dict[str, list[int]]:
        """Return {name: lines} of calls in the callbacks that are passed to calls of a name."""
        functions = {node.name: node for node in self._of(ast.FunctionDef)}
        waiting = [word.rsplit(".", 1)[-1] for _, word in self.given(name, place)]
        lines: dict[str, set[int]] = {}
        while waiting:
            function = functions.pop(waiting.pop(), None)
            for node in ast.walk(function) if function else ():
                if isinstance(node, ast.Call):
                    lines.setdefault(last_name(node), set()).add(node.lineno)
                    waiting.append(last_name(node))
        return {name: sorted(numbers) for name, numbers in lines.items()}

    @property
    def unusual_node_name(self) -> Place:
        """(line, name) of an init_node whose name ROS warns about, such as joy2twist.py."""
        for node in self._of(ast.Call):
            if last_name(node) == "init_node" and node.args:
                name = getattr(node.args[0], "value", None)
                # rospy refuses a / without a warning.
                if isinstance(name, str) and not re.fullmatch(r"[A-Za-z]\w*|.*/.*|", name):
                    return node.lineno, name
        return ()

    @property
    def keyboard(self) -> int:
        """The first line that reads the keyboard, or 0."""
        stdin = [node.lineno for node in self._of(ast.Attribute) if text_of(node) == "sys.stdin"]
        return min(sum(map(self.lines, KEYBOARD), stdin), default=0)

    def catcher(self, lines: Sequence[int]) -> ast.ExceptHandler | None:
        """Return the handler that catches an error. lines: of the traceback, the innermost last."""
        blocks = [block for block in self._of(ast.Try) if any(map(is_broad, block.handlers))]
        for line in lines[::-1]:
            # ast.walk yields outer blocks first.
            around = [block for block in blocks if block.lineno <= line < block.handlers[0].lineno]
            if around:
                return around[-1].handlers[-1]
        return None

    def first(self, name: str) -> Call | None:
        return next(iter(self.calls.get(name, [])), None)

    def lines(self, *names: str) -> list[int]:
        return [call.line for name in names for call in self.calls.get(name, [])]

    @property
    def without_callback(self) -> Call | None:
        calls = self.calls.get("Subscriber", [])
        return next((c for c in calls if len(c.words) == 2 and "callback" not in c.names), None)

    @property
    def publishing_loops(self) -> list[int]:
        """Lines that publish in a loop outside callbacks."""
        outside = set(self.lines("publish")) - set(self.called_back.get("publish", []))
        return [line for line in sorted(outside) if any(loop <= line for loop in self.loops)]

    @property
    def keeps_newest(self) -> bool:
        """Whether a Publisher or Subscriber has a queue of one message."""
        made = self.calls.get("Publisher", []) + self.calls.get("Subscriber", [])
        return any(call.names.get("queue_size") == "1" for call in made)


def _made(nodes: Iterable[ast.AST]) -> Iterator[tuple[int, str]]:
    """Yield (line, name) of each variable and parameter."""
    for node in nodes:
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg


def shows(handler: ast.ExceptHandler) -> bool:
    """Return whether a handler displays anything."""
    calls = (node for node in ast.walk(handler) if isinstance(node, ast.Call))
    return any(re.match("print|log|write|error|warn|exception", last_name(call)) for call in calls)


def _is_main(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and "__name__" in ast.dump(node.test)


def _class_facts(node: ast.ClassDef, called: set[str]) -> ClassFacts:
    parts = list(ast.walk(node))
    words = {last_name(part) for part in parts if isinstance(part, ast.Call)}
    bases = {text_of(base) for base in node.bases}
    stored = [part for part in parts if isinstance(getattr(part, "ctx", None), ast.Store)]
    return ClassFacts(
        name=node.name,
        line=node.lineno,
        methods=[part.name for part in node.body if isinstance(part, ast.FunctionDef)],
        instantiated=node.name in called,
        # The student's own message or exception is no node.
        is_node=bool(words & {"Subscriber", "Publisher", "init_node", "publish"})
        and not any(base.endswith(("Exception", "Error")) for base in bases),
        attributes={getattr(part, "attr", getattr(part, "id", "")) for part in stored},
        bases=bases - {"object"},
    )


def with_bases(classes: list[ClassFacts]) -> list[ClassFacts]:
    """Return the ClassFacts, each with what it inherits from the others."""
    by_name = {facts.name: facts for facts in classes}

    def whole(facts: ClassFacts, below: tuple[str, ...] = ()) -> ClassFacts:
        for base in sorted(facts.bases):
            parent = by_name.get(base.rpartition(".")[2])
            if parent and parent.name not in (facts.name, *below):
                parent = whole(parent, (facts.name, *below))
                facts = replace(
                    facts,
                    methods=[*facts.methods, *parent.methods],
                    is_node=facts.is_node or parent.is_node,
                    attributes=facts.attributes | parent.attributes,
                    bases=(facts.bases - {base}) | parent.bases,
                )
        return facts

    return list(map(whole, classes))
