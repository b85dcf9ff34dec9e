"""How a program in C++ ends: what roscpp closes at Ctrl-C, and handlers of a student's own."""

from __future__ import annotations

from typing import Callable, Dict, Iterator, List, Tuple

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_tree import Node
from tutorial_check.submission.source_facts import Ending

Part = Tuple[int, Node]  # number of its file's first line, less one; node
CalledIn = Callable[[Part], Dict[str, List[int]]]  # {name: lines} of calls, also indirect ones

WAITS = ("spin", "waitForShutdown")  # until roscpp has closed the topics
HANDLERS = ("sa_handler", "sa_sigaction")


def ending_of(
    roots: list[Part], bodies: dict[str, Part], handlers: list[str], called_in: CalledIn
) -> Ending:
    """Return the Ending of a program. bodies: {function: its definition}."""
    late, place = _late(roots, called_in)
    return Ending(
        own_sigint=_first_line(roots, _no_sigint),
        replaced=_first_line(roots, _replaced),
        shutdown_first=_before_zero("signal_shutdown", bodies, handlers, called_in),
        sleep_first=_before_zero("sleep", bodies, handlers, called_in),
        late=late,
        late_place=place,
        unset_pointer=_first_line(roots, _unset_pointer),
    )


def _first_line(roots: list[Part], find: Callable[[Node], Node | None]) -> int:
    """Return the line of the first node that a search of each file's root returns, or 0."""
    nodes = ((start, find(root)) for start, root in roots)
    return next((start + tree.line_of(node) for start, node in nodes if node is not None), 0)


def _late(roots: list[Part], called_in: CalledIn) -> tuple[int, str]:
    """Return (line, its place) of what publishes when the topics are closed."""
    for start, root in roots:
        for part, place in _late_parts(root):
            if "publish" in called_in((start, part)):
                return start + tree.line_of(part), place
    return 0, ""


def _before_zero(
    first: str, bodies: dict[str, Part], handlers: list[str], called_in: CalledIn
) -> int:
    """Return the line of a call in a handler, before it publishes, or 0. first: of the call."""
    known = [name for name in handlers if name in bodies]
    called = [name for handler in known for name in called_in(bodies[handler]) if name in bodies]
    for name in [*known, *called]:
        start, body = bodies[name]
        line = 0
        for node in tree.below(body, "call_expression"):
            names = called_in((start, node))
            if line and "publish" in names:
                return line
            if "publish" not in names and first in names:
                line = line or start + tree.line_of(node)
    return 0


def _no_sigint(root: Node) -> Node | None:
    names = (node for node in tree.below(root, "identifier"))
    return next((node for node in names if tree.text_of(node) == "NoSigintHandler"), None)


def handler_of(call: Node, given: list[Node]) -> Node | None:
    """Return the handler that signal(SIGINT, handler), or sigaction, installs."""
    if tree.last_name(tree.field(call, "function")) == "signal":
        return given[1] if len(given) > 1 else None
    for node in tree.below(_function_around(call), "assignment_expression"):
        if tree.last_name(tree.field(node, "left")) in HANDLERS:
            return tree.field(node, "right")
    return None


def _function_around(node: Node) -> Node:
    while node.parent is not None and node.type != "function_definition":
        node = node.parent
    return node


def _calls(node: Node, *names: str) -> list[Node]:
    calls = tree.below(node, "call_expression")
    if not names:
        return calls
    return [call for call in calls if tree.last_name(tree.field(call, "function")) in names]


def _late_parts(root: Node) -> Iterator[tuple[Node, str]]:
    """Yield (node, its place) of what runs when roscpp has closed the topics."""
    for function in tree.below(root, "function_definition"):
        for call in _calls(function) if tree.below(function, "destructor_name") else ():
            yield call, "in the destructor"
    for block in tree.below(root, "compound_statement"):
        place = ""
        for statement in block.children:
            if place:
                yield statement, place
            place = _waits(statement) or place


def _waits(statement: Node) -> str:
    """Return the place of what is below a statement that waits for the end, or ""."""
    if statement.type == "expression_statement":
        names = [tree.text_of(tree.field(c, "function")) for c in _calls(statement, *WAITS)]
        return f"after {names[0]}()" if names else ""
    is_loop = statement.type in ("while_statement", "for_statement", "do_statement")
    condition = tree.field(statement, "condition") if is_loop else None
    is_until_end = condition is not None and _calls(condition, "ok")
    return "below the loop of ros::ok()" if is_until_end else ""


def _replaced(root: Node) -> Node | None:
    """Return the call that installs a handler, if a NodeHandle, or an object with one, is below."""
    owners = {"NodeHandle"} | {
        tree.text_of(tree.field(node, "name"))
        for node in tree.below(root, "class_specifier", "struct_specifier")
        if "NodeHandle" in map(tree.text_of, tree.below(node, "type_identifier"))
    }
    for call in _calls(root, "signal", "sigaction"):
        for node in tree.below(_function_around(call), "declaration", "new_expression"):
            is_below = node.start_byte > call.end_byte
            if is_below and tree.last_name(tree.field(node, "type")) in owners:
                return call
    return None


def _unset_pointer(root: Node) -> Node | None:
    """Return a pointer outside of all functions, through which one goes, and that none sets."""

    def texts(kind: str, part: str) -> set[str]:
        return {tree.text_of(tree.field(node, part)) for node in tree.below(root, kind)}

    unset = texts("field_expression", "argument") - texts("assignment_expression", "left")
    for node in (node for node in root.children if node.type == "declaration"):
        declared = tree.below(node, "pointer_declarator")
        name = tree.last_name(tree.field(declared[0], "declarator")) if declared else ""
        value = tree.text_of(tree.field(tree.field(node, "declarator"), "value")) if name else ""
        if name in unset and value in ("", "NULL", "nullptr", "0"):
            return node
    return None
