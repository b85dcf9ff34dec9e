"""Which Python files are rostests: the rule that test/CMakeLists.txt has in CMake's language."""


def is_rostest(path):
    """Return whether a Python file is a rostest that needs no .test file of its own."""
    return "\n    run()\n" in path.read_text() and not path.with_suffix(".test").exists()
