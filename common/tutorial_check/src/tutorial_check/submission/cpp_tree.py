"""The syntax tree of a C++ file, by tree-sitter, which reads on after a mistake.

It comes from PyPI with the set-up; where it is absent, a program in C++ has no facts, and a
diagnosis names the file without a line.
"""

from __future__ import annotations

import functools
import importlib.util
import re
from pathlib import Path
from typing import Any, Iterator, Sequence, Tuple

Node = Any  # tree_sitter.Node: .type, .children, .text, .child_by_field_name(), .start_point
# Of a program; one of 1,000 lines has about 10,000. tree-sitter may need 3 kB for a token, as in
# a<a<a<a, or seconds for many, as in [[a]][[a]][[a]].
MOST_TOKENS = 20_000
TOKEN = re.compile(r"\w+|[^\w\s]")
MOST_LEVELS = 200  # each node is read once for each node around it
MOST_LETTERS = 3000  # of an expression's text
Tree = Tuple[int, Node]  # (number of its file's first line, less one; root)


@functools.lru_cache(maxsize=None)
def _parser() -> Any:
    """Return the parser, or None."""
    try:
        import tree_sitter  # noqa: PLC0415  not everywhere
        import tree_sitter_cpp  # noqa: PLC0415
    except ImportError:
        return None
    language: Any = tree_sitter.Language
    try:
        return tree_sitter.Parser(language(tree_sitter_cpp.language()))
    except TypeError:  # as of the release for Python 3.8
        parser: Any = tree_sitter.Parser()
        parser.set_language(language(tree_sitter_cpp.language(), "cpp"))
        return parser


def folder() -> Path | None:
    """Return the folder from which Python imports tree-sitter, or None."""
    spec = importlib.util.find_spec("tree_sitter")
    return Path(spec.origin).parents[1] if spec and spec.origin else None


def tokens_of(text: str) -> int:
    """Return about how many tokens a text has."""
    return len(TOKEN.findall(text))


def parsed(text: str) -> Node | None:
    """Return the root of a file's tree, or None without tree-sitter, or for too long a text."""
    parser = _parser()
    if parser is None or tokens_of(text) > MOST_TOKENS:
        return None
    # A byte order mark would hide the first line.
    root = parser.parse(text.lstrip("\ufeff").encode(errors="replace")).root_node
    return root if _depth(root) <= MOST_LEVELS else None


def _depth(root: Node) -> int:
    """Return the levels of a tree, or a number above MOST_LEVELS."""
    level, depth = [root], 0
    while level and depth <= MOST_LEVELS:
        level, depth = [child for node in level for child in node.children], depth + 1
    return depth


def included(root: Node | None) -> set[str]:
    """Return the files that a file includes, such as ros/ros.h."""
    lines = below(root, "preproc_include") if root is not None else []
    return {text_of(field(line, "path")).strip("<>") for line in lines}


def walk(node: Node | None) -> Iterator[Node]:
    """Yield a node and all below it, in the order of the text."""
    waiting = [node] if node is not None else []
    while waiting:
        current = waiting.pop()
        yield current
        waiting += reversed(current.children)


def below(node: Node, *kinds: str) -> list[Node]:
    return [inner for inner in walk(node) if inner.type in kinds]


def above(node: Node, *kinds: str) -> Node | None:
    """Return the innermost node of these kinds around a node, or None."""
    outer = node.parent
    while outer is not None and outer.type not in kinds:
        outer = outer.parent
    return outer


def nodes(trees: Sequence[Tree], *kinds: str) -> Iterator[tuple[int, Node]]:
    """Yield (line, node) of the nodes of these kinds in several files."""
    for start, root in trees:
        for node in below(root, *kinds):
            yield start + line_of(node), node


def calls(trees: Sequence[Tree], *names: str) -> Iterator[tuple[int, Node]]:
    """Yield (line, node) of the calls of functions whose last name is one of these."""
    for line, call in nodes(trees, "call_expression"):
        if last_name(field(call, "function")) in names:
            yield line, call


def field(node: Node, name: str) -> Node | None:
    return node.child_by_field_name(name)


def text_of(node: Node | None) -> str:
    """Return the text of an expression, of a string without its quotes; "" if it is very long."""
    if node is None or node.end_byte - node.start_byte > MOST_LETTERS:
        return ""
    text: str = node.text.decode(errors="replace")
    return text.strip('"') if node.type == "string_literal" else " ".join(text.split())


def line_of(node: Node) -> int:
    return int(node.start_point[0]) + 1


def last_name(node: Node | None) -> str:
    """Return the last part of a name: `init` of ros::init, `publish` of node.pub_.publish."""
    while node is not None:
        inner = field(node, "field") or field(node, "name")
        if inner is None or node.type in ("call_expression", "lambda_expression"):
            break
        node = inner
    return text_of(node)


def arguments_of(node: Node) -> list[Node]:
    """Return the arguments of a call, or of a declaration such as `ros::Rate rate(10)`."""
    given = field(node, "arguments") or field(node, "value")
    inner = given.children if given is not None else []
    return [child for child in inner if child.is_named and child.type != "comment"]


def template_of(node: Node) -> str:
    """Return the last name in the <...> of a call, such as String; or ""."""
    function = field(node, "function")
    given = below(function, "template_argument_list") if function is not None else []
    kinds = below(given[-1], "type_identifier") if given else []
    return text_of(kinds[-1]) if kinds else ""
