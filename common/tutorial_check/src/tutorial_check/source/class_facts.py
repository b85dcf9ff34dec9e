"""What a class of a Python file says of itself. Pure."""

from __future__ import annotations

import ast
from dataclasses import dataclass, replace

from tutorial_check.source.python_text import last_name, text_of


@dataclass
class ClassFacts:
    """A class of the file."""

    name: str
    line: int
    methods: list[str]
    instantiated: bool
    is_node: bool
    attributes: set[str]  # that an object has, besides methods
    bases: set[str]  # but object


def class_facts(node: ast.ClassDef, called: set[str]) -> ClassFacts:
    """Return the ClassFacts of a ClassDef. called: the names of all that the file calls."""
    parts = list(ast.walk(node))
    words = {last_name(part) for part in parts if isinstance(part, ast.Call)}
    bases = {text_of(base) for base in node.bases}
    stored = [part for part in parts if isinstance(getattr(part, "ctx", None), ast.Store)]
    return ClassFacts(
        name=node.name,
        line=node.lineno,
        methods=[part.name for part in node.body if isinstance(part, ast.FunctionDef)],
        instantiated=node.name in called,
        # A message or an exception of its own is no node.
        is_node=bool(words & {"Subscriber", "Publisher", "init_node", "publish"})
        and not any(base.endswith(("Exception", "Error")) for base in bases),
        attributes={getattr(part, "attr", getattr(part, "id", "")) for part in stored},
        bases=bases - {"object"},
    )


def with_bases(classes: list[ClassFacts]) -> list[ClassFacts]:
    """Return the ClassFacts, each with what the bases among them give it."""
    by_name = {one.name: one for one in classes}

    def whole(one: ClassFacts, below: tuple[str, ...] = ()) -> ClassFacts:
        for base in sorted(one.bases):
            parent = by_name.get(base.rpartition(".")[2])
            if parent is None or parent.name in (one.name, *below):
                continue
            parent = whole(parent, (one.name, *below))
            one = replace(
                one,
                methods=[*one.methods, *parent.methods],
                is_node=one.is_node or parent.is_node,
                attributes=one.attributes | parent.attributes,
                bases=(one.bases - {base}) | parent.bases,
            )
        return one

    return [whole(one) for one in classes]
