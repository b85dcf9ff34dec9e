"""The classes of a C++ file."""

from __future__ import annotations

from typing import Iterator

from tutorial_check.submission import cpp_tree as tree
from tutorial_check.submission.cpp_tree import Node
from tutorial_check.submission.source_facts import ClassFacts

OF_A_NODE = {"NodeHandle", "Publisher", "Subscriber", "Timer"}  # roscpp's classes


def classes_of(root: Node, start: int) -> Iterator[ClassFacts]:
    """Yield the ClassFacts of a file. start: number of its first line, less one."""
    made = _made(root)
    for node in tree.below(root, "class_specifier", "struct_specifier"):
        name, body = tree.text_of(tree.field(node, "name")), tree.field(node, "body")
        if not name or body is None:
            continue
        methods, attributes, kinds = set[str](), set[str](), set[str]()
        for member in body.children:
            declared = tree.below(member, "function_declarator")
            if declared:
                methods.add(tree.last_name(tree.field(declared[0], "declarator")))
            elif member.type == "field_declaration":
                attributes |= {tree.text_of(n) for n in tree.below(member, "field_identifier")}
                kinds |= {tree.text_of(n) for n in tree.below(member, "type_identifier")}
        bases = {
            tree.last_name(inner)
            for clause in node.children
            if clause.type == "base_class_clause"
            for inner in clause.children
            if inner.type in ("type_identifier", "qualified_identifier")
        }
        yield ClassFacts(
            name=name,
            line=start + tree.line_of(node),
            methods=sorted(methods),
            instantiated=name in made,
            is_node=bool(kinds & OF_A_NODE),
            attributes=attributes,
            bases=bases,
        )


def _made(root: Node) -> set[str]:
    """Return the types of which a file makes objects, outside of their own definition."""
    kinds = [tree.field(node, "type") for node in tree.below(root, "declaration", "new_expression")]
    names = {tree.last_name(kind) for kind in kinds}
    for node in tree.below(root, "template_argument_list", "call_expression"):
        inner = node if node.type == "template_argument_list" else tree.field(node, "function")
        names |= {tree.text_of(n) for n in tree.below(inner, "type_identifier", "identifier")}
    return names
