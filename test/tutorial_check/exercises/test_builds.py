"""Builds that are kept: what changed is built, nothing else is, and nothing stale is right."""

import os
import re

import pytest
from edits import move, put, remove, write

from tutorial_check.data.json_data import from_json
from tutorial_check.data.recorders import BUILT
from tutorial_check.data.recordings import Built
from tutorial_check.examining.examination import examine
from tutorial_check.recording import build_store
from tutorial_check.recording.launcher import started
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Order, Question
from tutorial_testing.claims import claim
from tutorial_testing.submissions import MANIFEST

P = "beginner_tutorials"
CMAKE = f"""cmake_minimum_required(VERSION 3.5)
project({P})
find_package(catkin REQUIRED COMPONENTS)
catkin_package(INCLUDE_DIRS include)
include_directories(include ${{catkin_INCLUDE_DIRS}} ${{CATKIN_DEVEL_PREFIX}}/include)
file(STRINGS note.md note)
add_executable(talker src/talker.cpp src/words.cpp)
add_executable(listener src/listener.cpp)
"""
FILES = {
    "CMakeLists.txt": CMAKE,
    "package.xml": MANIFEST.format(P).replace(
        "<license>", "<buildtool_depend>catkin</buildtool_depend><license>"
    ),
    "include/words.h": "const char* words();\n",
    "src/words.cpp": '#include "words.h"\nconst char* words() { return "hello"; }\n',
    "src/talker.cpp": '#include "words.h"\nint main() { return words()[0] == 0; }\n',
    "src/listener.cpp": "int main() { return 0; }\n",
    "note.md": "a note\n",
}
MAKE_SERVICE = "add_service_files(FILES Double.srv)\ngenerate_messages()"
# With a service: {path: text}.
SERVICE = {
    "CMakeLists.txt": CMAKE.replace("COMPONENTS", "COMPONENTS message_generation").replace(
        "catkin_package", f"{MAKE_SERVICE}\ncatkin_package"
    )
    + "add_dependencies(talker ${PROJECT_NAME}_generate_messages_cpp)\n",
    "srv/Double.srv": "int64 number\n---\nint64 twice\n",
    "src/talker.cpp": f"#include <{P}/Double.h>\n"
    f"int main() {{ return static_cast<int>({P}::Double().request.number); }}\n",
}


@pytest.fixture
def source(tmp_path, monkeypatch):
    """The src folder of a right workspace in C++; no build of it is kept yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    write_files(FILES, tmp_path / "ws/src")
    return tmp_path / "ws/src"


def write_files(texts, source):
    for name, text in texts.items():
        write(f"{P}/{name}", text, 0o644)(source)


@pytest.fixture
def build(source, underlay):
    """build(): what a worker builds of the workspace."""

    def built():
        with started(Order(source.parent, underlay, ["2"])) as (_, worker):
            return from_json(Built, worker.ask(Question(BUILT.name)).recording)

    return built


def compiled(built):
    return sorted(re.findall(r"Building CXX object \S+/(\S+)\.cpp\.o", built.output))


def programs(built):
    return sorted(program.name for program in built.executables if program.is_built)


@claim("Of a workspace in C++, only what has changed is built again")
def test_only_what_has_changed_is_built(source, build):
    first = build()
    assert first.code == 0 and compiled(first) == ["listener", "talker", "words"], first.output
    assert build() == first  # what was printed then, too
    put(f"{P}/src/words.cpp", "hello", "hallo")(source)
    again = build()
    assert (again.code, compiled(again)) == (0, ["words"]), again.output
    assert programs(again) == programs(first) == ["listener", "talker"]
    put(f"{P}/src/words.cpp", ";", "")(source)
    wrong = build()
    assert (wrong.code, programs(wrong)) == (1, []) and "error: expected" in wrong.output
    assert build() == wrong
    put(f"{P}/src/words.cpp", '"hallo"', "&;")(source)
    fixed = build()
    assert (fixed.code, programs(fixed)) == (0, programs(first)), fixed.output
    assert compiled(fixed) == ["words"] and "Configuring done" in fixed.output


def of_package(edit, path, *words):
    return edit(f"{P}/{path}", *words)


def long_ago(path, old, new):
    """Change a file, and let it look older than the build."""

    def edit(source):
        of_package(put, path, old, new)(source)
        os.utime(source / P / path, (0, 0))

    return edit


MISTAKES = {
    "a source is removed": (remove(f"{P}/src/words.cpp"), "Cannot find source file"),
    "a source has another name": (move(f"{P}/src/words.cpp", f"{P}/src/word.cpp"), "Cannot find"),
    "a source has changed, and is old": (long_ago("src/words.cpp", "words()", "word()"), "undef"),
    "a header has changed": (long_ago("include/words.h", "words", "word"), "was not declared"),
    "a header is removed": (remove(f"{P}/include/words.h"), "No such file"),
    "a package is not found": (
        of_package(put, "CMakeLists.txt", "COMPONENTS", "& none_such"), "none_such"
    ),
    "a folder of headers is removed": (
        lambda source: (source / P / "include").rename(source / P / "headers"), "include"
    ),
    "a file that CMake reads is removed": (remove(f"{P}/note.md"), "note.md"),
}  # fmt: skip


@claim("No build of an earlier check makes a wrong workspace right")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_nothing_stale_makes_a_mistake_right(source, build, mistake):
    change, words = MISTAKES[mistake]
    assert build().code == 0
    change(source)
    made = build()
    assert made.code and words in made.output, made.output
    assert build() == made


SERVICE_MISTAKES = {
    "another field": (long_ago("srv/Double.srv", "number", "value"), "number"),
    "not generated": (
        of_package(put, "CMakeLists.txt", f"{MAKE_SERVICE}\n", ""), "does not exist",
    ),
}  # fmt: skip


@claim("No build of an earlier check ...", because="a header that is generated")
@pytest.mark.parametrize("mistake", SERVICE_MISTAKES)
def test_no_stale_service_makes_a_mistake_right(source, build, mistake):
    change, words = SERVICE_MISTAKES[mistake]
    write_files(SERVICE, source)
    assert build().code == 0
    change(source)
    made = build()
    assert made.code and words in made.output, made.output


@claim("No build of an earlier check ...", because="a target")
def test_a_target_that_was_removed_is_no_program(source, build):
    assert programs(build()) == ["listener", "talker"]
    put(f"{P}/CMakeLists.txt", "add_executable(listener src/listener.cpp)\n", "")(source)
    assert programs(build()) == ["talker"]


@claim("No build of an earlier check ...", because="a script, then a source")
def test_a_missing_script_stays_a_mistake_when_a_source_changes(source, build):
    assert build().code == 0
    remove(f"{P}/note.md")(source)
    assert build().code
    put(f"{P}/src/words.cpp", "hello", "hallo")(source)
    assert build().code


@claim("Of a workspace in C++ ...", because="of which a part cannot be built")
def test_a_package_that_cannot_be_built_is_tried_once(source, build):
    write("other/package.xml", MANIFEST.format("other"))(source)
    write("other/CMakeLists.txt", "project(other)\nfind_package(none_such REQUIRED)\n")(source)
    first = build()
    assert first.code == 0 and "none_such" in first.unbuilt
    assert programs(first) == ["listener", "talker"] and build() == first
    of_package(put, "src/words.cpp", "hello", "hallo")(source)
    assert build().code == 0


@claim("Two workers of a check build a workspace once")
@pytest.mark.skipif(not bubblewrap.granted().options, reason="one worker without namespaces")
def test_two_workers_build_once(source, underlay):
    """What CMake prints differs from build to build."""
    put(f"{P}/CMakeLists.txt", "file(", 'string(RANDOM LENGTH 9 is)\nmessage("it ${is}")\n&')(
        source
    )
    several = {"exercises": ["2", "3"], "only_first": False}
    outcomes = examine(Order(source.parent, underlay, **several), side_by_side=True)
    (printed,) = {
        exchange["recording"]["output"]
        for outcome in outcomes
        for exchange in outcome.recordings
        if exchange["recorder"] == BUILT.name
    }
    (file,) = build_store.cache().iterdir()
    assert re.search("it .{9}", printed)[0].encode() in file.read_bytes()
