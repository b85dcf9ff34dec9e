"""Facts from the text of a Python file, which is parsed and never run."""

from __future__ import annotations

import ast
import re
import warnings
from functools import cached_property
from typing import Any, Iterable, Iterator, Sequence

from tutorial_check.submission.oddities import Place
from tutorial_check.submission.python_text import is_broad, last_name, python_lines, text_of
from tutorial_check.submission.source_facts import Call, ClassFacts, SourceFacts
from tutorial_check.submission.student_files import MOST_BYTES, TOO_LARGE

KEYBOARD = ("input", "raw_input", "tcgetattr", "setraw", "setcbreak", "initscr", "getch", "getchar")


class PythonFacts(SourceFacts):
    """Facts about a file; if Python cannot read it, only the error."""

    def __init__(self, text: str) -> None:
        super().__init__()
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
    def globals(self) -> list[int]:
        return [node.lineno for node in self._of(ast.Global)]

    @property
    def bare_names(self) -> list[tuple[int, str]]:
        kinds = (ast.Attribute, ast.Name)
        bare = [node for node in self._of(ast.Expr) if isinstance(node.value, kinds)]
        return [(node.lineno, text_of(node.value)) for node in bare]

    @property
    def sunken_main(self) -> Place:
        functions = self._of(ast.FunctionDef)
        inner = ((n, f.name) for f in functions for n in ast.walk(f) if isinstance(n, ast.If))
        return next(((node.lineno, name) for node, name in inner if _is_main(node)), ())

    @property
    def odd_main(self) -> Place:
        tests = [node.test for node in self._nodes[0].body if isinstance(node, ast.If)]
        for test in (compare for compare in tests if isinstance(compare, ast.Compare)):
            left, right = text_of(test.left), text_of(test.comparators[0])
            is_meant = (left.strip("_"), right.strip(" _")) == ("name", "main")
            if is_meant and left not in self.names and (left, right) != ("__name__", "__main__"):
                return test.lineno, self.text[test.lineno].strip()
        return ()

    @cached_property
    def names(self) -> dict[str, int]:
        names = list(_made(self._nodes))
        names += [(node.lineno, node.name) for node in self._of(ast.FunctionDef, ast.ClassDef)]
        for node in self._of(ast.Import, ast.ImportFrom):
            names += [(node.lineno, alias.asname or alias.name) for alias in node.names]
        return {name: line for line, name in sorted(names, reverse=True)}

    @property
    def attributes(self) -> dict[str, tuple[int, str]]:
        pairs = [(target, node.value) for node in self._of(ast.Assign) for target in node.targets]
        pairs = [both for both in pairs if isinstance(both[0], ast.Attribute)]
        texts = [(target.lineno, text_of(target), text_of(value)) for target, value in pairs]
        return {name: (line, value) for line, name, value in sorted(texts, reverse=True)}

    @property
    def loose(self) -> dict[int, str]:
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
        for node in self._of(ast.Call):
            if last_name(node) == "init_node" and node.args:
                name = getattr(node.args[0], "value", None)
                # rospy refuses a / without a warning.
                if isinstance(name, str) and not re.fullmatch(r"[A-Za-z]\w*|.*/.*|", name):
                    return node.lineno, name
        return ()

    @property
    def keyboard(self) -> int:
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
