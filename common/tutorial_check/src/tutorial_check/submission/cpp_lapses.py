"""What a program in C++ does too early, too late or never, from its syntax trees."""

from __future__ import annotations

from typing import Iterator, Sequence

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_tree import Node, Tree
from tutorial_check.submission.oddities import Lapses, Place

DISPLAYS = ("printf", "ROS_DEBUG", "ROS_INFO", "ROS_WARN", "ROS_ERROR", "ROS_FATAL")
INNER = ("compound_statement", "field_declaration_list")
LOOPS = ("while_statement", "do_statement", "for_statement")
OUTSIDE = "make it in main, below ros::init: a global variable is made before main"
ABOVE = 'ros::init(argc, argv, "NAME") belongs above it, as the first line of main'


def lapses_of(trees: Sequence[Tree]) -> Lapses:
    """Return the lapses of a program of one or more files."""
    return Lapses(
        early_handle=_early_handle(trees),
        text_as_object=_text_as_object(trees),
        bare_ok=_bare_ok(trees),
        late_subscriber=_late_subscriber(trees),
        late_loop=_late_loop(trees),
        repeated_publisher=_repeated_publisher(trees),
        unended_line=_unended_line(trees),
        looped_spin=_looped_spin(trees),
        empty_loop=_empty_loop(trees),
    )


def _early_handle(trees: Sequence[Tree]) -> Place:
    """Return (line, fix) of the NodeHandle that is made before ros::init, if that is called."""
    handles = list(_handles(trees))
    inits = [line for line, _ in tree.calls(trees, "init")]
    outside = [line for line, node in handles if not tree.above(node, *INNER)]
    early = [line for line, _ in handles if inits and line < inits[0]]
    if outside and inits:
        return outside[0], OUTSIDE
    return (early[0], ABOVE) if early else ()


def _handles(trees: Sequence[Tree]) -> Iterator[tuple[int, Node]]:
    """Yield (line, node) of each NodeHandle that a declaration makes."""
    for line, node in tree.nodes(trees, "declaration", "field_declaration"):
        declarator = tree.field(node, "declarator")
        is_pointer = declarator is not None and declarator.type == "pointer_declarator"
        if tree.last_name(tree.field(node, "type")) == "NodeHandle" and not is_pointer:
            yield line, node


def _text_as_object(trees: Sequence[Tree]) -> Place:
    """Return (line, text) of a std::string that is displayed by %s without c_str()."""
    for line, call in tree.calls(trees, *DISPLAYS):
        form, *words = [*tree.arguments_of(call), call]
        for word in words if "%s" in tree.text_of(form) else ():
            if word.type == "field_expression" and tree.last_name(word) == "data":
                return line, tree.text_of(word)
    return ()


def _bare_ok(trees: Sequence[Tree]) -> int:
    """Return the line of a ros::ok without (), or 0."""
    for line, node in tree.nodes(trees, "qualified_identifier"):
        if tree.text_of(node) == "ros::ok" and node.parent.type != "call_expression":
            return line
    return 0


def _late_subscriber(trees: Sequence[Tree]) -> int:
    """Return the line of the first subscribe if it comes after a spin of its function, or 0."""
    for line, call in tree.calls(trees, "subscribe"):
        return line if _after_spin(line, call) else 0
    return 0


def _late_loop(trees: Sequence[Tree]) -> int:
    """Return the line of the first loop that comes after a spin of its function, or 0."""
    loops = tree.nodes(trees, *LOOPS)
    return next((line for line, loop in loops if _after_spin(line, loop)), 0)


def _after_spin(line: int, node: Node) -> bool:
    function = tree.above(node, "function_definition")
    spins = tree.calls([(line - tree.line_of(node), function)], "spin") if function else ()
    return any(spin < line for spin, _ in spins)


def _repeated_publisher(trees: Sequence[Tree]) -> int:
    """Return the line of the first advertise within a loop, or 0."""
    calls = tree.calls(trees, "advertise")
    return next((line for line, call in calls if tree.above(call, *LOOPS)), 0)


def _unended_line(trees: Sequence[Tree]) -> int:
    """Return the line of the first output to cout, or of printf, if none ends a line; or 0."""
    first = 0
    for line, statement in tree.nodes(trees, "expression_statement"):
        words = {tree.text_of(node) for node in tree.below(statement, "identifier")}
        is_output = bool(words & {"printf", "cout"})
        if words & {"endl", "flush", "fflush"} or (is_output and "\\n" in tree.text_of(statement)):
            return 0
        first = first or (line if is_output else 0)
    return first


def _looped_spin(trees: Sequence[Tree]) -> int:
    """Return the line of the first spin in a loop that does more, or 0."""
    for line, call in tree.calls(trees, "spin"):
        loop = tree.above(call, *LOOPS)
        if loop is not None and len(tree.below(loop, "expression_statement")) > 1:
            return line
    return 0


def _empty_loop(trees: Sequence[Tree]) -> int:
    """Return the line of the first `while (...);`, or 0."""
    for line, loop in tree.nodes(trees, "while_statement"):
        if tree.text_of(tree.field(loop, "body")) == ";":
            return line
    return 0
