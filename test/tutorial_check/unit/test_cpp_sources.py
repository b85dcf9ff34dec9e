"""The files that a program in C++ is made of."""

import pytest

from tutorial_check.data.recordings import Executable
from tutorial_check.errors import CannotCheck
from tutorial_check.submission.cpp_sources import main_of, texts_of
from tutorial_testing.claims import claim

MAIN = "int main (int argc, char** argv) {}"


@pytest.fixture
def read(tmp_path):
    """Return read(path) of a text, which refuses a long one as student_files does."""

    def text_of(path):
        text = path.read_text(encoding="utf-8")
        if len(text) > 9000:
            raise CannotCheck("more than 256 kB")
        return text

    return text_of


@claim("A program in C++ is called by the source with its name, or else by the one with main()")
@pytest.mark.parametrize(
    ("name", "files", "main"),
    [
        ("talker", {"a.cpp": MAIN, "talker.cpp": "int f();"}, "talker.cpp"),
        ("node", {"common.cpp": "", "node_main.cc": MAIN}, "node_main.cc"),
        ("node", {"a.cpp": "", "b.cpp": ""}, "a.cpp"),
        ("node", {"long.cpp": "x" * 9999, "b.cpp": MAIN}, "b.cpp"),
    ],
)
def test_the_main_source(tmp_path, read, name, files, main):
    for path, text in files.items():
        (tmp_path / path).write_text(text, encoding="utf-8")
    executable = Executable(name, f"devel/lib/p/{name}", (), True)
    assert main_of(executable, [tmp_path / path for path in files], read) == tmp_path / main


def test_headers_are_those_that_are_included_even_by_a_header(tmp_path, read):
    files = {
        "src/main.cpp": '#include <ros/ros.h>\n#include "drive.h"\n#include <p/long.hpp>',
        "src/more.cpp": '#include "../include/p/ring.h"',
        "include/p/drive.h": '#include "p/wheel.hpp"',
        "include/p/wheel.hpp": "",
        "include/p/ring.h": '#include "ring.h"',
        "include/p/long.hpp": "x" * 9999,
        "include/p/other.h": "",
        "include/p/my_drive.h": "",
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text + "\n", encoding="utf-8")
    main, more = tmp_path / "src/main.cpp", tmp_path / "src/more.cpp"
    texts = texts_of(main, [more, main], tmp_path, read)
    names = [path.rpartition("/")[2] for path in texts]
    assert names == ["main.cpp", "more.cpp", "drive.h", "ring.h", "wheel.hpp"]
