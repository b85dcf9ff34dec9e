"""The syntax tree of a C++ file, its limits, and programs where there is none."""

import builtins
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tutorial_check.submission import cpp_tree
from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_testing.claims import claim

TOKENS = ("(", ")", "{", "}", "<", ">", "a", "::", "class ", "template", "=", "*", ";", "\n", '"')
TOKENS += ("#if 0\n", "#endif\n", "f(", "[](", "'", "/*", "*/", "if", "for", "case", "\0", "é")
TOKENS += ("n.subscribe", "ros::Rate ", "ros::init", "main", "const ", "return ", ",", "\ufeff")
PUBLIC = ("called_back", "publishing_loops", "without_callback", "oddities", "attributes", "names")


def read_all(text):
    """Read all facts of a text; return the CppFacts."""
    facts = CppFacts({"src/a.cpp": text})
    for name in PUBLIC:
        getattr(facts, name)
    facts.called_by("Timer", 1)
    assert facts.line_of_text("no text is this one") == 0
    return facts


@pytest.fixture
def no_parser(monkeypatch):
    """Remove tree-sitter from this Python."""
    original = builtins.__import__

    def without(name, *arguments):
        if name.startswith("tree_sitter"):
            raise ImportError(name)
        return original(name, *arguments)

    monkeypatch.setattr(builtins, "__import__", without)
    cpp_tree._parser.cache_clear()
    yield
    cpp_tree._parser.cache_clear()


@claim("Without tree-sitter a program in C++ is read as one without facts, and its file is named")
def test_without_a_parser_there_are_no_facts(no_parser):
    facts = read_all('#include "ros/ros.h"\nint main() { ros::spin(); }\n')
    assert not facts.calls
    assert not facts.imports
    assert facts.text[1] == '#include "ros/ros.h"'
    assert facts.place("src/a.cpp", 0) == "src/a.cpp"


@claim("Any text of a program in C++ is read, in bounded time and memory")
@settings(max_examples=150, deadline=None)
@given(st.lists(st.sampled_from(TOKENS), max_size=60), st.integers(1, 20))
def test_any_text_is_read(tokens, times):
    read_all("".join(tokens) * times)


@settings(max_examples=100, deadline=None)
@given(st.binary(max_size=500))
def test_any_bytes_are_read(data):
    read_all(data.decode(errors="replace"))


@pytest.mark.parametrize("text", [
    "(" * 100_000, "{" * 15_000, "a<" * 10_000, "f(a," * 5000, "class a{void f(){" * 1500,
    'n.subscribe("a", 1, f);' * 1500, "[[a]]" * 2000, "void f(){n.subscribe(1,1,f);}\n" * 900,
    "\0" * 262_144, '"' * 262_144, "n.subscribe(1, 2, [](int a) {" * 1000, "\ud800",
], ids=lambda text: ascii(text[:9]))  # fmt: skip
def test_a_text_of_many_levels_or_tokens_takes_seconds_at_most(text):
    began_s = time.process_time()
    read_all(text)
    assert time.process_time() - began_s < 12.0


def test_what_is_too_long_or_too_deep_has_no_tree_and_the_rest_has():
    assert cpp_tree.parsed("a;" * cpp_tree.MOST_TOKENS) is None
    assert cpp_tree.parsed(f"int a = {'(' * 300}1{')' * 300};") is None
    chain = "".join(f' << "{number}"' for number in range(100))
    assert len(read_all(f"void f() {{ cout{chain}; ros::spin(); }}").calls["spin"]) == 1
    files = {"main.cpp": "int main() {}", "vendor.h": "int a;" * 9999, "b.h": "void g() {}"}
    assert list(CppFacts(files).functions) == ["main"]


def test_a_very_long_expression_has_no_text():
    text = f'int main() {{ ros::init(argc, argv, "{"x" * 4000}"); }}'
    assert read_all(text).first("init_node").words == [""]
    assert cpp_tree.text_of(None) == ""
