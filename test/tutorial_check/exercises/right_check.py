"""The fixture with which right solutions are checked."""

import pytest

from tutorial_check.report.text import lines_of


@pytest.fixture
def check(examined):
    """check(workspace, exercises): {id: result}; it fails if a result is wrong."""

    def judge(workspace, exercises):
        outcomes = examined(workspace, exercises)
        assert [outcome.id for outcome in outcomes] == exercises
        results = [result for outcome in outcomes for result in outcome.results]
        assert not [
            lines_of(result) for result in results if result.status in ("wrong", "unreached")
        ]
        return {result.id: result for result in results}

    return judge
