"""Every row of the exercises, judged from its stored recordings."""

import stored
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

from tutorial_testing.claims import claim


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
