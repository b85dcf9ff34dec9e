"""Which target of CMake is the program that an exercise asks for."""

from pathlib import Path

import pytest

from tutorial_check.checking import cpp_programs
from tutorial_check.checking.cpp_programs import find_compiled, must_be_built
from tutorial_check.checking.programs import find_script
from tutorial_check.checking.results import Wrong
from tutorial_check.data.recordings import Executable
from tutorial_testing.claims import claim

PACKAGE = "joy2twist"
CMAKE = "project(joy2twist)\ncatkin_package()\nadd_executable(joy2twist src/drive.cpp)\n"


@pytest.fixture
def submission(make_submission, monkeypatch):
    """submission(name=source, ...): joy2twist with these executables. elsewhere: their folder."""
    made = make_submission(PACKAGE, "4.3")
    monkeypatch.setattr(cpp_programs, "must_build", lambda submission: None)

    def with_programs(*others, folder="devel/lib/joy2twist", is_built=True, **programs):
        paths = [*others, *programs.values()]
        for path in (made.source / PACKAGE / path for path in paths):
            path.parent.mkdir(exist_ok=True)
            path.write_text("int main() {}\n", encoding="utf-8")
        (made.source / PACKAGE / "CMakeLists.txt").write_text(CMAKE, encoding="utf-8")
        executables = tuple(
            Executable(name, f"{folder}/{name}", (f"{PACKAGE}/{source}",), is_built)
            for name, source in programs.items()
        )
        monkeypatch.setattr(type(made), "executables", executables)
        return made

    return with_programs


@claim("A program that was built and handed in with its source is no script")
def test_a_program_that_was_handed_in_is_no_script(submission):
    made = submission(joy2twist="src/drive.cpp")
    (made.source / PACKAGE / "joy2twist").write_bytes(b"\x7fELF\2")
    assert find_script(made, PACKAGE, "joy2twist.py") == "src/drive.cpp"


@claim("A program in C++ may have a longer name than the exercise's; the nearest one is taken")
@pytest.mark.parametrize(
    ("programs", "source"),
    [
        ({"joy2twist": "src/a.cpp", "joy2twist_node": "src/b.cpp"}, "src/a.cpp"),
        ({"node": "src/joy2twist.cpp", "joy2twist_node": "src/b.cpp"}, "src/joy2twist.cpp"),
        ({"test_joy2twist": "test/a.cpp", "joy2twist_node": "src/b.cpp"}, "src/b.cpp"),
        ({"teleop_joy2twist": "src/teleop.cc", "display": "src/b.cpp"}, "src/teleop.cc"),
        ({"new_joy2twist": "src/a.cpp", "my_joy2twist": "src/b.cpp"}, "src/b.cpp"),
        ({"Joy2Twist": "src/main.cpp", "display": "src/b.cpp"}, "src/main.cpp"),
        ({"teleop_node": "src/teleop.cpp"}, "src/teleop.cpp"),
    ],
)
def test_the_nearest_name_is_the_program(submission, programs, source):
    assert find_compiled(submission(**programs), PACKAGE, "joy2twist.py") == source


@claim("A missing program in C++ is explained: no target, a source in none, another name")
@pytest.mark.parametrize(
    ("sources", "programs", "seen", "hint"),
    [
        ((), {}, "none", "write src/joy2twist.cpp, and in CMakeLists.txt add_executable"),
        (("src/joy2twist.cc",), {"a": "src/a.cpp"}, "src/joy2twist.cc is in no add_executable",
            "add_executable(joy2twist src/joy2twist.cc)"),
        ((), {"JoyToTwist": "src/joy2Twist.cpp", "b": "src/b.cpp"}, "called JoyToTwist, b",
            "src/joy2Twist.cpp)"),
        ((), {"new_joy2twist": "src/n.cpp"}, "called new_joy2twist", "src/joy2twist.cpp)"),
    ],
)  # fmt: skip
def test_why_there_is_no_program(submission, sources, programs, seen, hint):
    with pytest.raises(Wrong) as wrong:
        find_compiled(submission(*sources, **programs), PACKAGE, "joy2twist.py")
    assert seen in wrong.value.seen
    assert hint in wrong.value.hint
    assert wrong.value.where == "joy2twist/CMakeLists.txt:3"


@claim("A program in C++ is right where rosrun finds it, in devel or in its package, and built")
@pytest.mark.parametrize(
    ("folder", "is_built", "seen"),
    [
        ("devel/lib/joy2twist", True, ""), ("src/joy2twist/bin", True, ""),
        ("build/joy2twist", True, "it is made as build/joy2twist/joy2twist"),
        ("devel/lib/joy2twist", False, "catkin_make has made no joy2twist"),
    ],
)  # fmt: skip
def test_rosrun_finds_it(submission, folder, is_built, seen):
    made = submission(joy2twist="src/drive.cpp", folder=folder, is_built=is_built)
    if not seen:
        must_be_built(made, PACKAGE, "src/drive.cpp")
        return
    with pytest.raises(Wrong) as wrong:
        must_be_built(made, PACKAGE, "src/drive.cpp")
    assert wrong.value.seen == seen


@claim("Programs in C++ count in a package without a node in Python, or if they are asked for")
def test_which_language_counts(submission):
    made = submission(joy2twist="src/drive.cpp")
    folder = Path(made.package(PACKAGE).folder, "scripts")
    folder.mkdir()
    (folder / "plot.py").write_text("import math\n", encoding="utf-8")
    assert list(made.programs(PACKAGE)) == ["scripts/plot.py", "src/drive.cpp"]
