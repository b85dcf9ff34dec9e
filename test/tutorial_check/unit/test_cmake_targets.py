"""The programs of a workspace, by what CMake's file API writes about its targets."""

import json

import pytest

from tutorial_check.data.recordings import Executable
from tutorial_check.recording import cmake_targets
from tutorial_testing.claims import claim

LIBRARY = {
    "id": "drive_lib::@1", "name": "drive_lib", "type": "SHARED_LIBRARY",
    "sources": [{"path": "joy2twist/src/drive.cpp"}],
}  # fmt: skip
PROGRAM = {
    "id": "joy2twist::@1", "name": "joy2twist", "type": "EXECUTABLE",
    "artifacts": [{"path": "{ws}/devel/lib/joy2twist/drive"}],
    "sources": [
        {"path": "joy2twist/src/main.cpp"},
        {"path": "{ws}/src/joy2twist/src/twice.cpp"},
        {"path": "{ws}/build/made.cpp", "isGenerated": True},
        {"path": "/usr/src/gtest.cc"},
    ],
    "dependencies": [{"id": "drive_lib::@1"}, {"id": "messages::@2"}],
}  # fmt: skip
MESSAGES = {"id": "messages::@2", "name": "messages", "type": "UTILITY", "sources": []}


@pytest.fixture
def programs(tmp_path):
    """programs(*replies): the executables of a workspace for which CMake wrote these."""

    def executables(*replies):
        workspace = tmp_path / "ws"
        folder = workspace / cmake_targets.API / "reply"
        folder.mkdir(parents=True)
        for number, reply in enumerate(replies):
            text = reply if isinstance(reply, str) else json.dumps(reply)
            text = text.replace("{ws}", str(workspace))
            (folder / f"target-{number}.json").write_text(text, encoding="utf-8")
        return cmake_targets.executables(tmp_path, workspace)

    return executables


@claim("A program in C++ is found by its target in CMake: its name, its files and its libraries")
def test_a_program_has_its_own_files_and_those_of_its_libraries(programs):
    sources = ("joy2twist/src/main.cpp", "joy2twist/src/twice.cpp", "joy2twist/src/drive.cpp")
    program = Executable("drive", "devel/lib/joy2twist/drive", sources, False)
    assert programs(PROGRAM, LIBRARY, MESSAGES) == (program,)


DAMAGED = [
    "", "{", "[1]", "[" * 100_000, "null", {}, {**PROGRAM, "id": [1]},
    {**PROGRAM, "artifacts": [{}]}, {**PROGRAM, "artifacts": {"0": 1}},
    {**PROGRAM, "artifacts": [1]}, {**PROGRAM, "sources": 3}, {**PROGRAM, "sources": [3]},
    {**PROGRAM, "sources": [{"path": 3}]}, {**PROGRAM, "dependencies": [{"id": {}}]},
]  # fmt: skip


@pytest.mark.parametrize("reply", DAMAGED, ids=lambda reply: str(reply)[:60])
def test_a_reply_that_a_program_has_damaged_is_left_out(programs, reply):
    other = {**PROGRAM, "id": "other", "artifacts": [{"path": "{ws}/devel/lib/a/other"}]}
    assert [program.name for program in programs(reply, other)] == ["other"]


def test_libraries_that_need_each_other_have_an_end(programs):
    other = {**LIBRARY, "id": "other", "dependencies": [{"id": LIBRARY["id"]}]}
    library = {**LIBRARY, "dependencies": [{"id": "other"}]}
    assert len(programs(PROGRAM, library, other)[0].sources) == 3
