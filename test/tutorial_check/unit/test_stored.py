"""Every row of the exercises, judged from its stored recordings."""

import os

import pytest
import stored
import test_cpp
from test_cpp import (  # noqa: F401
    test_a_literal_solution_in_cpp_is_right,
    test_a_mistake_in_cpp_is_found,
    test_a_right_program_in_cpp_is_noted,
    test_a_variant_in_cpp_is_right,
)
from test_mistakes import test_a_mistake_is_found  # noqa: F401
from test_right import (  # noqa: F401
    test_a_literal_solution_is_right_and_noted,
    test_a_right_solution_is_noted,
    test_a_variant_is_right,
    test_the_solutions_of_the_suite_are_right,
)
from test_task import (  # noqa: F401
    test_a_factor_has_its_sign,
    test_a_right_solution_of_a_task_is_right,
    test_each_value_of_a_task_is_checked,
    wrong_of,
)

from tutorial_check.submission import cpp_tree
from tutorial_testing.claims import claim

# A publisher that is made again and again works; only its source shows it.
CPP = [row for row in test_cpp.MISTAKES if row.exercise == "3" and "advertise in" not in row.what]


@claim(
    "Every row of mistakes and right solutions is judged at each commit from stored recordings, by "
    "the recorders of today"
)
def test_recordings_are_by_the_recorders_of_today():
    rows = [
        row for file in stored.FOLDER.glob("*.jsonl.xz") for row in stored.rows_of(file).values()
    ]
    codes = {(name, code) for row in rows for name, code in row["code"].items()}
    old = {name for name, code in codes if code != stored.code_hash(name)}
    assert rows and not old, "have changed since: ./tutorial test exercises --store"


@claim("Without tree-sitter the same programs in C++ are wrong, at the same check, without lines")
@pytest.mark.parametrize("row", CPP, ids=str)
def test_a_mistake_in_cpp_is_found_without_a_parser(row, literal_cpp, tmp_path, monkeypatch):
    monkeypatch.setattr(cpp_tree, "_parser", lambda: None)
    test_cpp.change(row, literal_cpp, row.exercise)
    (tmp_path / "judged").mkdir()
    name = f"test_a_mistake_in_cpp_is_found[{row}]"
    about = (os.environ["TUTORIAL_UNDERLAY"], [row.exercise], tmp_path / "judged")
    outcomes = stored.judged(name, literal_cpp.parent, *about, only_first=True)
    wrong = test_cpp.wrong_of(outcomes)
    assert [result.id for result in wrong[:1]] == [row.check]
