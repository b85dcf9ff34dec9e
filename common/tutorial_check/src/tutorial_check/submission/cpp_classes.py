"""The classes of a program in C++."""

from __future__ import annotations

from typing import Iterator, Sequence, Tuple

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_tree import Node
from tutorial_check.submission.oddities import Place
from tutorial_check.submission.source_facts import ClassFacts

OF_A_NODE = {"NodeHandle", "Publisher", "Subscriber", "Timer"}  # roscpp's classes
CALLS_OF_A_NODE = {"advertise", "subscribe", "publish"}
WAITS = ("spin", "spinOnce", "waitForShutdown")
Root = Tuple[int, Node]  # number of its file's first line, less one; root of its tree


def classes_of(roots: Sequence[Root]) -> Iterator[ClassFacts]:
    """Yield the ClassFacts of a program's files."""
    made = {name for _, root in roots for name in _made(root)}
    for start, root in roots:
        for node in tree.below(root, "class_specifier", "struct_specifier"):
            name, body = tree.text_of(tree.field(node, "name")), tree.field(node, "body")
            if name and body is not None:
                unmade = next((place for root in roots for place in _unmade(name, *root)), ())
                yield _class_facts(node, body, start, name in made, unmade)


def _class_facts(node: Node, body: Node, start: int, is_made: bool, unmade: Place) -> ClassFacts:
    methods: set[str] = set()
    attributes: set[str] = set()
    kinds: set[str] = set()
    for member in body.children:
        declared = tree.below(member, "function_declarator")
        if declared:
            methods.add(tree.last_name(tree.field(declared[0], "declarator")))
        elif member.type == "field_declaration":
            attributes |= {tree.text_of(n) for n in tree.below(member, "field_identifier")}
            kinds |= {tree.text_of(n) for n in tree.below(member, "type_identifier")}
    called = {
        tree.last_name(tree.field(call, "function")) for call in tree.below(body, "call_expression")
    }
    bases = {
        tree.last_name(inner)
        for clause in node.children
        if clause.type == "base_class_clause"
        for inner in clause.children
        if inner.type in ("type_identifier", "qualified_identifier")
    }
    return ClassFacts(
        name=tree.text_of(tree.field(node, "name")),
        line=start + tree.line_of(node),
        methods=sorted(methods),
        instantiated=is_made,
        is_node=bool(kinds & OF_A_NODE or called & CALLS_OF_A_NODE),
        attributes=attributes,
        bases=bases,
        unmade=unmade,
    )


def _made(root: Node) -> set[str]:
    """Return the types of which a file makes objects that last."""
    nodes = tree.below(root, "declaration", "new_expression")
    made = [node for node in nodes if not (_is_function(node) or _is_pointer(node))]
    names = {tree.last_name(tree.field(node, "type")) for node in made}
    waiting = _waiting(root)
    for node in tree.below(root, "template_argument_list", "call_expression"):
        is_call = node.type == "call_expression"
        is_alone = is_call and node.parent.type == "expression_statement"
        if not is_alone or tree.last_name(tree.field(node, "function")) in waiting:
            inner = tree.field(node, "function") if is_call else node
            names |= {tree.text_of(n) for n in tree.below(inner, "type_identifier", "identifier")}
    return names


def _waiting(root: Node) -> set[str]:
    """Return the names of functions, such as constructors, in which ROS runs callbacks."""
    return {
        tree.last_name(tree.field(tree.field(function, "declarator"), "declarator"))
        for function in tree.below(root, "function_definition")
        for call in tree.below(function, "call_expression")
        if tree.last_name(tree.field(call, "function")) in WAITS
        and tree.field(function, "declarator") is not None
    }


def _unmade(name: str, start: int, root: Node) -> Iterator[Place]:
    """Yield (line, text) of what should make an object of a class, and makes none that lasts."""
    for node in tree.below(root, "declaration", "expression_statement"):
        kind = tree.field(node, "type")
        if kind is None:
            call = node.children[0]
            kind = tree.field(call, "function") if call.type == "call_expression" else None
        elif not _is_function(node) or node.parent.type != "compound_statement":
            kind = None
        if tree.last_name(kind) == name:
            yield start + tree.line_of(node), tree.text_of(node)


def _is_pointer(node: Node) -> bool:
    """Return whether a declaration makes a pointer or reference, and no object."""
    declarator = tree.field(node, "declarator")
    if declarator is not None and declarator.type == "init_declarator":
        declarator = tree.field(declarator, "declarator")
    return declarator is not None and declarator.type in (
        "pointer_declarator", "reference_declarator"
    )  # fmt: skip


def _is_function(node: Node) -> bool:
    """Return whether a declaration such as `Node node();` declares a function, and no object."""
    declarator = tree.field(node, "declarator")
    if declarator is None or declarator.type != "function_declarator":
        return False
    # `Node node(handle);` looks the same as a function of one unnamed parameter.
    is_inside = node.parent is not None and node.parent.type == "compound_statement"
    return not (is_inside and tree.below(declarator, "parameter_declaration"))
