"""Hashes of the code that recorded the rows: a recorder and all that it imports.

They include only code of this repository, node_kit and gamepad too, with which recorders publish
and play. A name of the checker's API stands for the module that defines it. So a change of a check
makes no recording old; a change of the runner makes all of them old.
"""

import ast
import functools
import hashlib
import importlib.util
import io
import itertools
import tokenize
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
BEFORE_A_STATEMENT = (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)


@functools.lru_cache(maxsize=None)
def code_hash(module):
    """Return a hash of the code, without comments, of a module of recorders.

    It hashes words, because the syntax tree differs between versions of Python.
    """
    if not file_of(module):  # the recorder no longer exists
        return ""
    files = map(file_of, sorted(closure(module)))
    words = (word for file in files for word in code_of_file(file).split())
    return hashlib.sha256(" ".join(words).encode()).hexdigest()[:12]


def closure(module):
    """Return the names of a module and of all that it imports, directly or not."""
    modules, new = set(), [module]
    while new:
        module = new.pop()
        if module not in modules:
            modules.add(module)
            new += imported_by(module)
    return modules


@functools.lru_cache(maxsize=None)
def imported_by(module):
    """Return the names of this repository's modules that a module imports."""
    return {name for base, alias in imports(module) for name in modules_of(base, alias)}


def imports(module):
    """Yield (imported module, name imported from it or None) for each import in a module."""
    spec = importlib.util.find_spec(module)
    for node in ast.walk(ast.parse(file_of(module).read_text())):
        if isinstance(node, ast.Import):
            yield from ((alias.name, None) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            relative = "." * node.level + (node.module or "")
            base = importlib.util.resolve_name(relative, spec.parent)
            yield from ((base, alias.name) for alias in node.names)


def modules_of(base, name):
    """Return the modules of ours that `from base import name` uses: one or none."""
    if not file_of(base):
        return []
    inner = f"{base}.{name}"
    if not importlib.util.find_spec(base).submodule_search_locations:
        return [base]
    if name and importlib.util.find_spec(inner):
        return [inner]
    definitions = (other for other, known in imports(base) if known == name)
    return [module for other in definitions for module in modules_of(other, name)] or [base]


@functools.lru_cache(maxsize=None)
def file_of(module):
    """Return the file of a module of this repository, or None."""
    try:
        spec = importlib.util.find_spec(module)
    except ModuleNotFoundError:  # its package is not installed
        return None
    path = Path(spec.origin) if spec and spec.origin else Path()
    return path if REPOSITORY in path.parents else None


def code_of_file(path):
    """Return the text of a file without comments and docstrings."""
    text = path.read_text()
    starts = [0, *itertools.accumulate(map(len, text.splitlines(keepends=True)))]
    kept, rest, begins = [], 0, True  # begins: a statement begins
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT or (token.type == tokenize.STRING and begins):
            kept.append(text[rest : starts[token.start[0] - 1] + token.start[1]])
            rest = starts[token.end[0] - 1] + token.end[1]
        goes_on = token.type in (tokenize.COMMENT, tokenize.NL)
        begins = token.type in BEFORE_A_STATEMENT or (begins and goes_on)
    return "".join(kept) + text[rest:]
