"""Files that no student writes by hand: reading takes bounded time and memory, and one line."""

import os
import random
import resource
import shutil
import subprocess

import pytest
from edits import write

from tutorial_check.errors import CannotCheck
from tutorial_check.examining.examination import examine
from tutorial_check.sandbox.privileges import MOST_CPU_S, MOST_MB
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim

# Replaces bubblewrap and its worker: each build prints the content of a file beside it.
WORKER = """#!/usr/bin/python3 -IS
import json, os, socket, sys
if sys.argv[-1] == "true":  # the test whether it can isolate
    sys.exit()
line = socket.socket(fileno=os.dup(1))
for number, order in enumerate(line.makefile()):
    answer = {"cannot": "left out by this test"}
    if number == 0:
        answer = {"ready": True}
    elif json.loads(order)["recorder"].endswith(":built"):
        output = open(os.path.dirname(os.path.abspath(__file__)) + "/output").read()
        answer = {"recording": {"code": 1, "output": output, "unbuilt": ""}}
    line.sendall(json.dumps(answer).encode() + b"\\n")
"""
TARGETS = [
    "beginner_tutorials/scripts/talker.py", "beginner_tutorials/scripts/listener.py",
    "beginner_tutorials/package.xml", "beginner_tutorials/CMakeLists.txt",
    "joy2twist/package.xml", "joy2twist/scripts/joy2twist.py", "joy2twist/launch/launch_bag.launch",
    "other/package.xml", "../devel/setup.sh", "../devel/_setup_util.py", "output",
]  # fmt: skip
UNITS = (
    "<!--", "-->", "--", "<![CDATA[", "]]>", "<a>", "<a", "&lt;", '="', "='", "</", "<arg name=",
    "$(find ", "$(arg ", "(", "[", "{", ")", "x = 1\n", "x = [1, 2]\n", "except ", "    except\t",
    "if 1:\n", "def f(): pass\n", "1+", "a.", "a(", "-", "not ", "lambda: ", "'''", '"', "\\", "#",
    "# coding: ", " ", "\t", "\n", "\r", "\0", "\x1b[31m", "\u201c", "a", "a a", "1",
    "find_package(catkin ", "find_package(catkin COMPONENTS ", "CMake Error at ", "CMake Error: ",
    "Could not find ", 'Could not find a package "x"', "could not find\n  ",
    "traversing 3 packages:\n-- ~~ - a", "-- ~~  - ", "Call Stack", "x/CMakeLists.txt:1", "error: ",
    "CMAKE_PREFIX_PATH = r'", "_CATKIN_SETUP_DIR:=", "Traceback (most recent call last)\n",
    '  File "', "ValueError: ", "[/x/a.msg] ", "unable to load msg [", "a/",
    "undefined reference to `", "No rule to make target ",
)  # fmt: skip


def drawn(number):
    """Return {path: text} of a submission of up to 50 MB, and the depth of its folders."""
    draw = random.Random(number)
    files = {}
    for path in draw.sample(TARGETS, draw.randint(1, 3)):
        size = int(10 ** draw.uniform(0, 7.7))
        units = draw.sample(UNITS, draw.randint(1, 3))
        pattern = "".join(unit * int(10 ** draw.uniform(0, 5)) for unit in units)
        text = (pattern * (size // len(pattern) + 1))[:size]
        inside = draw.choice(
            ("{}", "<package format='2'><name>x{}", "<launch>\n{}\n</launch>", "x = {}")
        )
        files[path] = inside.format(text)
    return files, int(10 ** draw.uniform(0, 3.4)) if draw.random() < 0.2 else 0


@pytest.fixture
def hostile(literal, tmp_path, monkeypatch):
    """hostile(number): the workspace of a random submission."""
    stand_in = tmp_path / "bin" / "bwrap"
    stand_in.parent.mkdir()
    stand_in.write_text(WORKER)
    stand_in.chmod(0o755)
    monkeypatch.setenv("PATH", f"{stand_in.parent}:{os.environ['PATH']}")

    def written(number):
        workspace = tmp_path / str(number)
        shutil.copytree(literal.parent, workspace)
        files, depth = drawn(number)
        (stand_in.parent / "output").write_text(files.pop("output", "error: x")[:250_000])
        for path, text in files.items():
            write(path, text)(workspace / "src")
        here = os.open(workspace / "src", os.O_RDONLY)
        for _ in range(depth):  # too deep for one path
            os.mkdir("d", dir_fd=here)
            below = os.open("d", os.O_RDONLY, dir_fd=here)
            os.close(here)
            here = below
        os.close(here)
        return workspace

    yield written
    # Python's own functions fail to remove folders this deep.
    subprocess.run(["rm", "-rf", *tmp_path.glob("[0-9]*")], check=True)


NUMBERS = [
    *range(16),
    *(pytest.param(number, marks=pytest.mark.night) for number in range(16, 200)),
]


@claim(
    "Whatever files were handed in, reading them has bounds of time and memory, and ends in a line"
)
@pytest.mark.parametrize("number", NUMBERS)
def test_what_no_student_wrote_is_read_in_bounded_time_and_memory(hostile, underlay, number):
    workspace = hostile(number)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    exercises = ("2", "3", "4.3", "5", "6.1", "6.2")
    try:
        outcomes = examine(Order(workspace, underlay, exercises, is_callers_own=False))
        lines = [result.seen for outcome in outcomes for result in outcome.results]
        lines += [outcome.trouble for outcome in outcomes]
    except CannotCheck as error:
        lines = [str(error)]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    assert used_s < MOST_CPU_S + 3  # the programs that it starts need some more
    assert after.ru_maxrss >> 10 < MOST_MB + 50  # libraries need some more
    assert all("\n" not in line and "\x1b" not in line and len(line) < 700 for line in lines), lines
