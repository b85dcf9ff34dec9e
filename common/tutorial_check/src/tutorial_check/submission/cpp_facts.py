"""Facts from the text of a program in C++; its calls of roscpp have the names of rospy's."""

from __future__ import annotations

import re
from functools import cached_property
from typing import ClassVar, Iterator, Mapping

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_classes import classes_of
from tutorial_check.submission.cpp_ending import ending_of, handler_of
from tutorial_check.submission.cpp_lapses import LOOPS, lapses_of
from tutorial_check.submission.cpp_oddities import oddities_of
from tutorial_check.submission.cpp_tree import Node
from tutorial_check.submission.idioms import CPP, Idioms
from tutorial_check.submission.oddities import Lapses, Oddities
from tutorial_check.submission.source_facts import Call, Ending, SourceFacts

NAMES = {  # {of roscpp: of rospy}
    "advertise": "Publisher", "subscribe": "Subscriber", "init": "init_node", "ok": "is_shutdown",
    "createTimer": "Timer", "createWallTimer": "Timer", "createSteadyTimer": "Timer",
    "advertiseService": "Service", "serviceClient": "ServiceProxy", "getParam": "get_param",
    "param": "get_param", "setParam": "set_param", "waitForService": "wait_for_service",
    "waitForExistence": "wait_for_service", "waitForShutdown": "spin", "printf": "print",
    "puts": "print", "cout": "print", "cerr": "print", "sleep_for": "sleep", "usleep": "sleep",
}  # fmt: skip
LOG = re.compile(r"ROS_(DEBUG|INFO|WARN|ERROR|FATAL)(?:_STREAM|_NAMED|_COND|_ONCE)*(_THROTTLE)?")
LEVELS = {"DEBUG": "logdebug", "INFO": "loginfo", "WARN": "logwarn", "ERROR": "logerr"}
MADE_BY_TYPE = {
    "Rate": "Rate", "WallRate": "Rate", "AsyncSpinner": "AsyncSpinner", "Duration": "Duration",
    "WallDuration": "Duration", "NodeHandle": "NodeHandle",
}  # fmt: skip
# What a message's type in a callback may end with.
POINTER = re.compile(r"(?:Const)?Ptr$|^(?:Const)?Ptr$|_$")
NO_MESSAGE = ("const", "boost", "std", "ros", "shared_ptr", "MessageEvent", "Const", "void")


class CppFacts(SourceFacts):
    """Facts about a program of one or more files, whose lines are numbered through."""

    idioms: ClassVar[Idioms] = CPP

    def __init__(self, files: Mapping[str, str]) -> None:
        """files: {path within the package: text}, the one with main first."""
        super().__init__()
        self._starts: dict[str, int] = {}  # {file: number of its first line, less one}
        self._trees: list[tuple[int, Node]] = []  # (that number, root of its tree)
        tokens = 0
        for path, text in files.items():
            self._starts[path] = len(self.text)
            tokens += tree.tokens_of(text)
            root = tree.parsed(text) if tokens <= tree.MOST_TOKENS else None
            if root is not None:
                self._trees.append((len(self.text), root))
            first = len(self.text) + 1
            self.text.update(enumerate(text.split("\n"), first))
        for start, node in self._nodes("function_definition"):
            name = tree.last_name(_declarator(node))
            self.functions.setdefault(name, start + tree.line_of(node))
        self.has_main = "main" in self.functions
        for call in sorted(self._found_calls(), key=lambda pair: pair[1].line):
            self.calls.setdefault(call[0], []).append(call[1])
        self.loops = [
            start + tree.line_of(node)
            for start, node in self._nodes(*LOOPS)
            if node.type != "for_statement" or tree.field(node, "condition") is None
        ]
        self.classes = list(classes_of(self._trees))
        self.imports = {name for _, root in self._trees for name in tree.included(root)}

    def place(self, path: str, line: int) -> str:
        """Return FILE:LINE, of the file that a numbered line is in; for line 0 the program."""
        for file, start in reversed(self._starts.items()):
            if line > start:
                return f"{file}:{line - start}"
        return path

    @cached_property
    def oddities(self) -> Oddities:
        return oddities_of(self._trees)

    @cached_property
    def lapses(self) -> Lapses:
        return lapses_of(self._trees)

    @property
    def attributes(self) -> dict[str, tuple[int, str]]:
        texts = []
        for start, node in self._nodes("assignment_expression"):
            left, right = (tree.text_of(tree.field(node, side)) for side in ("left", "right"))
            if "." in left or "->" in left:
                texts.append((start + tree.line_of(node), left.replace("->", "."), right))
        return {name: (line, value) for line, name, value in sorted(texts, reverse=True)}

    def line_in(self, file: str, line: int) -> int:
        """Return the number of a line of a file of the program, by its whole path; else 0."""
        starts = (start for path, start in self._starts.items() if file.endswith(f"/{path}"))
        return next((start + line for start in starts), 0)

    def line_of_text(self, text: str) -> int:
        """Return the line of the first string literal with a text, or 0."""
        literals = tree.nodes(self._trees, "string_literal")
        return next((line for line, node in literals if tree.text_of(node) == text), 0)

    def _nodes(self, *kinds: str) -> Iterator[tuple[int, Node]]:
        """Yield (number of its file's first line, less one; node) of these kinds."""
        for start, root in self._trees:
            for node in tree.below(root, *kinds):
                yield start, node

    def _found_calls(self) -> Iterator[tuple[str, Call]]:
        """Yield (name, Call) of all calls, and of objects that are made by a declaration."""
        for start, node in self._nodes("call_expression"):
            yield self._call(node, start)
        for start, node in self._nodes("init_declarator", "declaration", "field_declaration"):
            above = node.parent if node.type == "init_declarator" else node
            name = MADE_BY_TYPE.get(tree.last_name(tree.field(above, "type")), "")
            is_whole = node.type == "init_declarator" or not tree.below(node, "init_declarator")
            if name and is_whole:
                words = [tree.text_of(word) for word in tree.arguments_of(node)]
                yield name, Call(start + tree.line_of(node), words, {})
        for start, node in self._nodes("identifier"):
            if tree.text_of(node) in ("cout", "cerr"):
                yield "print", Call(start + tree.line_of(node), [], {})

    def _call(self, node: Node, start: int) -> tuple[str, Call]:
        """Return (name, Call) by rospy's names, and rospy's order of arguments."""
        written = tree.last_name(tree.field(node, "function"))
        given = tree.arguments_of(node)
        words, line = [tree.text_of(word) for word in given], start + tree.line_of(node)
        log = LOG.fullmatch(written)
        name = LEVELS.get(log[1], "logfatal") if log else NAMES.get(written, written)
        name += "_throttle" if log and log[2] else ""
        names: dict[str, str] = {}
        if written == "init":
            texts = [tree.text_of(word) for word in given if word.type == "string_literal"]
            is_plain = len(given) < 4 and bool(texts)  # else it may be in a variable
            is_anonymous = "AnonymousName" in tree.text_of(node)
            names["anonymous"] = "True" if is_anonymous else "False" if is_plain else ""
            words = texts[:1]
        elif written in ("advertise", "subscribe"):
            names["queue_size"] = words[1] if len(words) > 1 else ""
            callback = _callback(given[2]) if len(given) > 2 else ""
            kind = tree.template_of(node) or self._kind_of(given[2] if len(given) > 2 else None)
            latch = words[2:3] == ["true"] and written == "advertise"
            names.update(latch="True") if latch else None
            words = [*words[:1], kind, callback] if written == "subscribe" else [*words[:1], kind]
        elif written in ("signal", "sigaction") and words[:1] == ["SIGINT"]:
            name, words = "on_shutdown", [_callback(handler_of(node, given))]
        elif tree.text_of(tree.field(node, "function")) == "ros::shutdown":
            name = "signal_shutdown"
        elif written in ("advertiseService", "createTimer", "createWallTimer"):
            words = [*words[:1], _callback(given[1]) if len(given) > 1 else ""]
        return name, Call(line, words, names)

    def _kind_of(self, given: Node | None) -> str:
        """Return the message of a callback's parameter, such as Joy; or ""."""
        if given is None:
            return ""
        function = given if given.type == "lambda_expression" else None
        name = _callback(given)
        if function is None:
            _, function = self._bodies.get(name, (0, None))
        if function is None:
            return ""
        parameters = tree.below(function, "parameter_declaration")
        return message_of(parameters[0]) if parameters else ""

    @cached_property
    def _bodies(self) -> dict[str, tuple[int, Node]]:
        """{function: (number of its file's first line, less one; its definition)}."""
        definitions = self._nodes("function_definition")
        return {tree.last_name(_declarator(node)): (start, node) for start, node in definitions}

    def called_by(self, name: str, place: int) -> dict[str, list[int]]:
        """Return {name: lines} of calls in the callbacks that are passed to calls of a name."""
        inner = [
            (start, function)
            for start, node in self._nodes("call_expression")
            if self._call(node, start)[0] == name
            for function in tree.below(node, "lambda_expression")
        ]
        named = (self._bodies.get(word) for _, word in self.given(name, place))
        return self.called_in(*inner, *filter(None, named))

    def called_in(self, *parts: tuple[int, Node]) -> dict[str, list[int]]:
        """Return {name: lines} of calls in parts, and in the program's functions that they call.

        parts: (number of the file's first line, less one; node)
        """
        bodies, waiting = dict(self._bodies), list(parts)
        lines: dict[str, set[int]] = {}
        while waiting:
            start, part = waiting.pop()
            for node in tree.below(part, "call_expression"):
                called, call = self._call(node, start)
                lines.setdefault(called, set()).add(call.line)
                body = bodies.pop(called, None)
                waiting += [body] if body else []
        return {called: sorted(numbers) for called, numbers in lines.items()}

    @cached_property
    def ending(self) -> Ending:
        handlers = [name for _, name in self.given("on_shutdown", 0)]
        return ending_of(self._trees, self._bodies, handlers, self.called_in)

    @property
    def globals(self) -> list[int]:
        """The lines of Publishers and Subscribers outside of all functions and classes."""
        return [
            start + tree.line_of(node)
            for start, root in self._trees
            for node in root.children
            if node.type == "declaration"
            and tree.last_name(tree.field(node, "type")) in ("Publisher", "Subscriber")
        ]


def message_of(parameter: Node) -> str:
    """Return the message of a parameter: String of `const std_msgs::String::ConstPtr& msg`."""
    kinds = ("type_identifier", "namespace_identifier")
    words = [tree.text_of(node) for node in tree.below(parameter, *kinds)]
    names = [POINTER.sub("", word) for word in words if word not in NO_MESSAGE]
    names = [name for name in names if name and not name.endswith("_msgs")]
    return names[-1] if names else ""


def _declarator(node: Node) -> Node | None:
    """Return the name that a function definition has, below pointers and references."""
    inner = tree.field(node, "declarator")
    while inner is not None and tree.field(inner, "declarator") is not None:
        inner = tree.field(inner, "declarator")
    return inner


def _callback(node: Node) -> str:
    """Return the function that is passed: callback of &Node::callback, boost::bind(...)."""
    if node.type == "call_expression":  # boost::bind(&Node::callback, this, _1)
        given = tree.arguments_of(node)
        return _callback(given[0]) if given else ""
    if node.type == "lambda_expression":
        return "lambda"
    inner = tree.field(node, "argument") if node.type == "pointer_expression" else node
    return tree.last_name(inner)
