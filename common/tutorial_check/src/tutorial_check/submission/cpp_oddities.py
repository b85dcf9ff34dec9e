"""The oddities of a program in C++, from its syntax trees."""

from __future__ import annotations

import re
from typing import Iterator, Sequence

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_tree import Node, Tree
from tutorial_check.submission.oddities import LostSubscriber, OddIndex, Oddities, Place

KEEPING = ("spin", "spinOnce", "waitForShutdown", "callOne", "callAvailable")
WHOLE = re.compile(r"(unsigned |signed )?(int|long|short|char)\b|u?int\d+_t")
FUNCTIONS = ("function_definition", "lambda_expression")
MAKERS = {"advertise": "Publisher", "subscribe": "Subscriber"}
POINTER = re.compile(r"(Ptr|shared_ptr(<.*>)?|unique_ptr(<.*>)?)$")


def oddities_of(trees: Sequence[Tree]) -> Oddities:
    """Return the oddities of a program of one or more files."""
    outer = {name for _, root in trees for name in _outer_names(root)}
    return Oddities(
        lost_subscriber=next(_lost_subscribers(trees, outer), None),
        hidden_publisher=next(_hidden_publishers(trees, outer), ()),
        unmade_publisher=next(_unmade_publishers(trees), ()),
        function_declared=next(_function_declarations(trees), ()),
        private=tuple(_private(trees)),
        whole_division=next(_whole_divisions(trees), ()),
        whole_axis=next(_whole_axes(trees), ()),
        indices=tuple(_indices(trees)),
        unset_pointer=next(_unset_pointers(trees), ()),
    )


def _type_of(node: Node) -> str:
    """Return the last name of the type that a declaration has."""
    return tree.last_name(tree.field(node, "type"))


def _name_of(declarator: Node | None) -> str:
    """Return the variable of a declarator, below pointers, references and its value."""
    while declarator is not None and tree.field(declarator, "declarator") is not None:
        declarator = tree.field(declarator, "declarator")
    return tree.text_of(declarator)


def _outer_names(root: Node) -> Iterator[str]:
    """Yield the Publishers and Subscribers that are members or global variables."""
    for node in tree.below(root, "declaration", "field_declaration"):
        if not tree.above(node, "compound_statement") and _type_of(node) in MAKERS.values():
            yield from (_name_of(inner) for inner in node.children_by_field_name("declarator"))


def _local(call: Node) -> Node | None:
    """Return the declaration of the local variable that a call makes, or None."""
    made = call.parent if call.parent is not None else call
    declaration = made.parent if made.type == "init_declarator" else None
    block = declaration.parent if declaration is not None else None
    is_local = block is not None and block.type == "compound_statement"
    is_static = declaration is not None and tree.text_of(declaration).startswith("static ")
    return declaration if is_local and not is_static else None


def _function_of(node: Node) -> str:
    function = tree.above(node, *FUNCTIONS)
    return _function_name(function) if function is not None else ""


def _function_name(function: Node) -> str:
    declarator = tree.field(function, "declarator")
    return tree.last_name(tree.field(declarator, "declarator") if declarator else None)


def _lost_subscribers(trees: Sequence[Tree], outer: set[str]) -> Iterator[LostSubscriber]:
    for line, call in tree.calls(trees, "subscribe"):
        first = next((word.type for word in tree.arguments_of(call)), "")
        # message_filters takes a NodeHandle first.
        if call.parent.type == "expression_statement" and first == "string_literal":
            yield LostSubscriber(line, "", "", False)
        declaration = _local(call)
        if declaration is None or _is_kept(declaration, _name_of(call.parent)):
            continue
        is_inner = declaration.parent.parent.type not in (
            "function_definition",
            "lambda_expression",
        )
        place = "its block" if is_inner else f"{_function_of(call)}()"
        name = _name_of(call.parent)
        yield LostSubscriber(line, name, place, name in outer)


def _is_kept(declaration: Node, name: str) -> bool:
    """Return whether a local variable lives while the node spins, or is used again."""
    block = declaration.parent
    if block.parent.type == "function_definition" and _function_of(declaration) == "main":
        return True
    calls = tree.below(block, "call_expression")
    spins = any(tree.last_name(tree.field(call, "function")) in KEEPING for call in calls)
    uses = sum(tree.text_of(node) == name for node in tree.below(block, "identifier"))
    return spins or uses > 1 or bool(tree.below(block, "while_statement"))


def _hidden_publishers(trees: Sequence[Tree], outer: set[str]) -> Iterator[Place]:
    for line, call in tree.calls(trees, "advertise"):
        name = _name_of(call.parent)
        if _local(call) is not None and name in outer:
            yield line, name


def _unmade_publishers(trees: Sequence[Tree]) -> Iterator[Place]:
    made = set()
    for _, call in tree.calls(trees, "advertise"):
        outer = tree.above(call, "assignment_expression", "init_declarator", "field_initializer")
        if outer is None or outer.type == "field_initializer":
            made.add(tree.text_of(outer.children[0]) if outer is not None else "")
        else:
            left = tree.field(outer, "left")
            made.add(tree.last_name(left) if left is not None else _name_of(outer))
    for line, call in tree.calls(trees, "publish"):
        name = tree.last_name(tree.field(tree.field(call, "function"), "argument"))
        if name not in made:
            yield line, name


def _function_declarations(trees: Sequence[Tree]) -> Iterator[Place]:
    kinds = ("class_specifier", "struct_specifier")
    classes = {tree.text_of(tree.field(node, "name")) for _, node in tree.nodes(trees, *kinds)}
    for line, node in tree.nodes(trees, "declaration"):
        declarator = tree.field(node, "declarator")
        if declarator is None or declarator.type != "function_declarator":
            continue
        is_empty = tree.text_of(tree.field(declarator, "parameters")) == "()"
        is_local = node.parent.type == "compound_statement"
        if is_empty and is_local and _type_of(node) in classes:
            yield line, tree.text_of(node)


def _private(trees: Sequence[Tree]) -> Iterator[tuple[str, int]]:
    """Yield (what a private NodeHandle makes, line of its "~")."""
    handles = {}
    for line, node in tree.nodes(trees, "string_literal"):
        if tree.text_of(node).startswith("~"):
            made = tree.above(node, "init_declarator", "field_initializer", "call_expression")
            if made is not None and made.type == "field_initializer":
                handles[tree.text_of(made.children[0])] = line
            elif made is not None:
                handles[_name_of(made)] = line
    for _, call in tree.calls(trees, *MAKERS):
        function, given = tree.field(call, "function"), tree.arguments_of(call)
        handle = tree.field(function, "argument")
        is_relative = given and not tree.text_of(given[0]).startswith("/")
        if handle is not None and is_relative and tree.last_name(handle) in handles:
            yield MAKERS[tree.last_name(function)], handles[tree.last_name(handle)]


def _whole_divisions(trees: Sequence[Tree]) -> Iterator[Place]:
    for line, node in tree.nodes(trees, "binary_expression"):
        sides = [tree.text_of(tree.field(node, side)).strip("()") for side in ("left", "right")]
        is_division = tree.text_of(tree.field(node, "operator")) == "/"
        numbers = [int(side) for side in sides if side.isdecimal() and len(side) < 10]
        if is_division and len(numbers) == 2 and numbers[1] and numbers[0] % numbers[1]:
            yield line, " / ".join(sides)


def _whole_axes(trees: Sequence[Tree]) -> Iterator[Place]:
    whole = set()
    for _, node in tree.nodes(trees, "declaration", "field_declaration"):
        if WHOLE.match(tree.text_of(tree.field(node, "type"))):
            whole |= {_name_of(inner) for inner in node.children_by_field_name("declarator")}
    for line, node in tree.nodes(trees, "init_declarator", "assignment_expression"):
        is_new = node.type == "init_declarator"
        value = tree.field(node, "value" if is_new else "right")
        name = _name_of(node) if is_new else tree.last_name(tree.field(node, "left"))
        if value is not None and name in whole and _has_axis(value):
            yield line, name
    for line, node in tree.nodes(trees, "cast_expression", "call_expression"):
        kind = tree.field(node, "type" if node.type == "cast_expression" else "function")
        is_whole = WHOLE.match(tree.text_of(kind).replace("static_cast<", ""))
        if is_whole and _has_axis(node):
            yield line, f"{tree.text_of(kind)}"


def _has_axis(node: Node) -> bool:
    fields = tree.below(node, "field_expression")
    return any(tree.last_name(field) == "axes" for field in fields)


def _indices(trees: Sequence[Tree]) -> Iterator[OddIndex]:
    for line, node in tree.nodes(trees, "subscript_expression"):
        given = tree.field(node, "indices") or tree.field(node, "index")
        yield from _index(line, tree.field(node, "argument"), tree.text_of(given).strip("[] "))
    for line, call in tree.calls(trees, "at"):
        text = tree.text_of(tree.field(call, "arguments")).strip("() ")
        yield from _index(line, tree.field(tree.field(call, "function"), "argument"), text)


def _index(line: int, array: Node | None, text: str) -> Iterator[OddIndex]:
    name = tree.last_name(array)
    if name in ("axes", "buttons") and text.isdecimal() and len(text) < 10:
        yield OddIndex(line, name, int(text))


def _unset_pointers(trees: Sequence[Tree]) -> Iterator[Place]:
    """Yield (line of the first use, name) of pointers without a value."""
    left = [
        (tree.last_name(tree.field(node, "left")), tree.above(node, *FUNCTIONS))
        for _, node in tree.nodes(trees, "assignment_expression")
    ]
    for node in (n for _, n in tree.nodes(trees, "declaration", "field_declaration")):
        is_smart = POINTER.search(tree.text_of(tree.field(node, "type")))
        for declarator in node.children_by_field_name("declarator"):
            name = _name_of(declarator)
            setting = [function for set_name, function in left if set_name == name]
            # A callback may set it later than it is used.
            if _is_unset(declarator, bool(is_smart)) and (not setting or is_smart):
                yield from _uses(trees, name, setting)


def _is_unset(declarator: Node, is_smart: bool) -> bool:
    """Return whether a declarator makes a pointer without a value, or with a null."""
    inner = tree.field(declarator, "declarator")
    if declarator.type == "init_declarator":
        is_null = tree.text_of(tree.field(declarator, "value")) in ("nullptr", "NULL", "0")
        return is_null and inner is not None and inner.type == "pointer_declarator"
    is_name = declarator.type in ("identifier", "field_identifier")
    return declarator.type == "pointer_declarator" or (is_smart and is_name)


def _uses(trees: Sequence[Tree], name: str, setting: Sequence[Node]) -> Iterator[Place]:
    for line, node in tree.nodes(trees, "field_expression", "pointer_expression"):
        is_it = tree.text_of(tree.field(node, "argument")) == name
        if is_it and tree.above(node, *FUNCTIONS) not in setting:
            yield line, name
