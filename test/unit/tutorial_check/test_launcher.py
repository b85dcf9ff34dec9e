"""An examination that does not finish: what it found until then is reported."""

from types import SimpleNamespace

import pytest

from tutorial_check import launcher
from tutorial_check.isolation import bubblewrap
from tutorial_check.model import CannotCheck

RESULT = '{"exercise": "2", "result": {"id": "C1", "status": "ok", "title": "one"}}'
DONE = '{"exercise": "2", "done": 1.0, "trouble": ""}'
BEGUN = '{"exercise": "3", "result": {"id": "C5", "status": "wrong", "title": "two"}}'


@pytest.fixture
def examine(tmp_path, monkeypatch):
    """examine(lines, ending, tell): with a script in place of the examination."""
    (tmp_path / "setup.bash").touch()

    def examined(lines, ending="", tell=lambda outcome, result: None):
        script = "\n".join(["cat >/dev/null", *(f"echo '{line}'" for line in lines), ending])
        monkeypatch.setattr(bubblewrap, "command", lambda *_: ["sh", "-c", script])
        return launcher.examine(tmp_path, tmp_path / "setup.bash", ["2", "3", "5"], tell)

    return examined


def found_in(outcomes):
    """{exercise: (ids of its results, trouble)}."""
    return {one.id: ([result.id for result in one.results], one.trouble) for one in outcomes}


@pytest.mark.parametrize(
    ("ending", "why"),
    [
        ("echo no room >&2", "the examination ended without a result: no room"),
        ("""echo '{"cannot": "no room"}'""", "no room"),
    ],
)
def test_what_was_found_before_it_ended(examine, ending, why):
    outcomes = examine([RESULT, DONE, BEGUN], ending)
    assert found_in(outcomes) == {"2": (["C1"], ""), "3": (["C5"], why), "5": ([], why)}
    assert [one.passed for one in outcomes] == [True, False, False]


def test_what_was_found_before_the_time_was_over(examine, monkeypatch):
    clock = SimpleNamespace(monotonic=lambda: 0.0)
    monkeypatch.setattr(launcher, "time", clock)

    def let_it_be_over(outcome, _):
        if outcome.id == "3":
            clock.monotonic = lambda: launcher.LONGEST_S + 1

    outcomes = found_in(examine([RESULT, DONE, BEGUN], "exec sleep 3600", let_it_be_over))
    assert outcomes["2"] == (["C1"], "")
    assert outcomes["3"][0] == ["C5"] and "took longer than 900 s" in outcomes["3"][1]


def test_an_examination_that_finds_nothing_has_no_verdict(examine):
    with pytest.raises(CannotCheck, match="ended without a result"):
        examine([])


def test_a_result_that_nobody_asked_for_or_that_comes_twice_is_none(examine):
    stray = RESULT.replace('"2"', '"4.3"')
    late = RESULT.replace("C1", "C2")
    seen = []
    outcomes = examine(
        [stray, DONE.replace('"2"', '"4.3"'), RESULT, RESULT.replace("ok", "wrong"), DONE, late],
        """echo '{"end": true}'""",
        lambda outcome, result: seen.append((outcome.id, result.id, result.status)),
    )
    assert seen == [("2", "C1", "ok")]
    assert found_in(outcomes)["2"] == (["C1"], "")
