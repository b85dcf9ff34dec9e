"""Facts from the text of a program in any language, by the names that rospy has for its calls."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Sequence

from tutorial_check.submission.idioms import PYTHON, Idioms
from tutorial_check.submission.oddities import Lapses, Oddities, Place


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
    unmade: Place = ()  # (line, text) in C++ of what should make an object, and makes none


@dataclass(frozen=True)
class Ending:
    """What a program in C++ does at Ctrl-C; lines, or 0."""

    own_sigint: int = 0  # NoSigintHandler: roscpp leaves Ctrl-C to the program
    replaced: int = 0  # a handler that roscpp replaces, as a NodeHandle comes later
    shutdown_first: int = 0  # ros::shutdown() in the handler, before it publishes
    sleep_first: int = 0  # a sleep in the handler, before it publishes
    late: int = 0  # publishes after ros::spin(), or in a destructor
    late_place: str = ""
    unset_pointer: int = 0  # of the program, that no line sets


class SourceFacts:
    """Facts about a program. What only another language has is empty here."""

    idioms: ClassVar[Idioms] = PYTHON

    def __init__(self) -> None:
        self.error, self.error_line = "", 0  # why its language cannot read it
        self.text: dict[int, str] = {}  # {number: line}
        self.functions: dict[str, int] = {}  # {name: line}
        self.calls: dict[str, list[Call]] = {}  # {last part of the name: its calls, by line}
        self.classes: list[ClassFacts] = []
        self.has_main = False
        self.loops: list[int] = []  # lines
        self.broad_excepts: list[ast.ExceptHandler] = []
        self.imports: set[str] = set()
        self.inner_names: set[str] = set()  # of functions' variables, parameters

    def place(self, path: str, line: int) -> str:
        """Return FILE:LINE, or for line 0 the file. path: of the program within its package."""
        return f"{path}:{line}" if line else path

    @property
    def is_python(self) -> bool:
        return self.idioms is PYTHON

    @property
    def error_text(self) -> str:
        return self.text.get(self.error_line, "").strip(" \t")

    @property
    def globals(self) -> list[int]:
        """The lines of global statements."""
        return []

    @cached_property
    def oddities(self) -> Oddities:
        return Oddities()

    @cached_property
    def lapses(self) -> Lapses:
        return Lapses()

    @property
    def bare_names(self) -> list[tuple[int, str]]:
        """(line, text) of statements without effect, such as rospy.spin without ()."""
        return []

    @property
    def sunken_main(self) -> Place:
        """(line, function) of an `if __name__ == '__main__':` that is inside a function."""
        return ()

    @property
    def odd_main(self) -> Place:
        """(line, text) of `if __name__ == ' main ':` and similar lines."""
        return ()

    @cached_property
    def names(self) -> dict[str, int]:
        """{name: first line} of variables, parameters, functions, classes and imports."""
        return {}

    @property
    def attributes(self) -> dict[str, tuple[int, str]]:
        """{"msg.linear.x": (first line, value assigned)}."""
        return {}

    @property
    def loose(self) -> dict[int, str]:
        """{line that may lack indentation: the function above it}."""
        return {}

    @property
    def unusual_node_name(self) -> Place:
        """(line, name) of a node's name that ROS warns about, such as joy2twist.py."""
        return ()

    @property
    def keyboard(self) -> int:
        """The first line that reads the keyboard, or 0."""
        return 0

    @cached_property
    def ending(self) -> Ending:
        return Ending()

    @cached_property
    def called_back(self) -> dict[str, list[int]]:
        """{name: lines} of calls in callbacks, and in what they call."""
        return self.called_by("Subscriber", 2)

    def called_by(self, name: str, place: int) -> dict[str, list[int]]:
        """Return {name: lines} of calls in the callbacks that are passed to calls of a name."""
        return {}

    def given(self, name: str, place: int) -> list[tuple[int, str]]:
        """Return (line, callback) of each call of a name. place: the callback's position."""
        calls = self.calls.get(name, [])
        return [(c.line, (c.words[place:] or [c.names.get("callback", "")])[0]) for c in calls]

    def catcher(self, lines: Sequence[int]) -> ast.ExceptHandler | None:
        """Return the handler that catches an error. lines: of the traceback, the innermost last."""
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
