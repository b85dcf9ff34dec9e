"""The classes of a program in C++."""

import pytest

from tutorial_check.submission.cpp_facts import CppFacts
from tutorial_testing.claims import claim

BODY = "ros::NodeHandle node_; ros::Publisher pub_; void drive(const Joy& joy);"


def classes_of(text):
    return {facts.name: facts for facts in CppFacts({"src/node.cpp": text}).classes}


@claim("A class in C++ has its members, what it inherits, and whether the program makes an object")
@pytest.mark.parametrize(
    ("use", "is_made"),
    [
        ("Drive drive;", True), ("Drive drive(node);", True), ("auto d = new Drive();", True),
        ("Drive* drive;", False), ("std::make_shared<Drive>(node);", True), ("int x;", False),
    ],
)  # fmt: skip
def test_an_object_is_made(use, is_made):
    text = f"class Drive {{ public: Drive(); private: {BODY} }};\nint main() {{ {use} }}"
    drive = classes_of(text)["Drive"]
    assert drive.instantiated == is_made
    assert drive.is_node
    assert {"node_", "pub_"} <= drive.attributes
    assert {"Drive", "drive"} <= set(drive.methods)
    assert drive.line == 1


def test_a_class_that_is_only_declared_is_none():
    assert list(classes_of("class Drive;\nstruct Wheel { double radius; };\nclass {};")) == [
        "Wheel"
    ]


def test_a_base_is_named():
    text = f"struct Base {{ {BODY} }};\nclass Drive : public Base {{}};"
    assert "Base" in str(classes_of(text)["Drive"].bases) or classes_of(text)["Drive"].is_node
