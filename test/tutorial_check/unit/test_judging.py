"""A worker that stops: the results of the checks until then are reported."""

import json
import os
from dataclasses import dataclass

import pytest

from tutorial_check.checking.checks import Check
from tutorial_check.errors import CannotCheck, Ended
from tutorial_check.examining import judging
from tutorial_check.examining.ask_once import AskOnce
from tutorial_check.recording import worker_process
from tutorial_check.sandbox import bubblewrap
from tutorial_check.submission.order import Order, Question, Reply
from tutorial_testing.claims import claim
from tutorial_testing.clock import Clock

pytestmark = claim("What was found before a worker ended, or its 15 minutes were over, is reported")
READY, SEEN = "{}", json.dumps({"recording": {"number": 1}})


@dataclass(frozen=True)
class Seen:
    number: int


def look(workspace, what: str) -> Seen:
    """A recorder, for a script in place of the worker."""


def looks(name):
    return lambda submission: f"{submission.recording(look, name).number}"


@pytest.fixture
def examine(tmp_path, monkeypatch):
    """examine(answers, ending, tell): with a script in place of the worker."""
    setup = tmp_path / "lower" / "devel" / "setup.bash"
    setup.parent.mkdir(parents=True)
    setup.touch()
    checks = [Check(f"C{n}", n, "", n, function=looks(n)) for n in ("2", "3", "5")]
    monkeypatch.setattr(judging, "checks_of", lambda course: checks)

    def examined(answers, ending="", tell=lambda outcome, result: None, beside=()):
        # Order and questions arrive where answers are sent.
        script = [*(f"read -r _ <&1; echo '{line}'" for line in answers), ending]
        scripts = iter([script, beside])
        command = lambda *_: ["sh", "-c", "\n".join(next(scripts))]  # noqa: E731
        monkeypatch.setattr(bubblewrap, "command", command)
        order = Order(tmp_path, setup, ("2", "3", "5"))
        return judging.examine(order, tell, side_by_side=bool(beside))

    return examined


def found_in(outcomes):
    return {o.id: ([result.id for result in o.results], o.trouble) for o in outcomes}


def test_what_was_found_before_the_worker_ended(examine):
    outcomes = examine([READY, SEEN], "echo no room >&2")
    why = "the worker exited without a result: no room"
    assert found_in(outcomes) == {"2": (["C2"], ""), "3": ([], why), "5": ([], why)}
    assert [outcome.passed for outcome in outcomes] == [True, False, False]


@claim("A compiler's errors are read whatever the language of the system")
def test_programs_of_a_worker_print_english(examine, monkeypatch):
    monkeypatch.setenv("LANG", "de_DE.UTF-8")
    outcomes = examine([READY, SEEN], 'echo "$LANG $LC_MESSAGES" >&2')
    assert outcomes[1].trouble.endswith(": de_DE.UTF-8 C.UTF-8")


@pytest.mark.parametrize(("answer", "why"), [
    ("nonsense", "is no recording: 'nonsense'"), ("7", "is no recording"),
    ("[" * 9000, "is no recording"), ("0" * 20_000, "is longer than 10,000 bytes"),
])  # fmt: skip
def test_what_was_found_before_a_worker_answered_nonsense(examine, monkeypatch, answer, why):
    monkeypatch.setattr(worker_process, "MOST_BYTES", 10_000)
    found, trouble = found_in(examine([READY, SEEN, answer], "exec sleep 3600"))["3"]
    assert not found and why in trouble


def test_what_was_recorded_before_the_worker_ended(examine):
    def end(outcome, _):
        raise Ended("no room")

    (asked,) = examine([READY, SEEN], "", end)[0].recordings
    assert asked["recording"] == {"number": 1}


def test_what_was_found_before_the_time_was_over(examine, monkeypatch):
    clock = Clock()
    monkeypatch.setattr(worker_process, "time", clock)
    monkeypatch.setattr(judging, "time", clock)

    def let_it_be_over(outcome, _):
        clock.now = worker_process.LONGEST_S + 1

    outcomes = found_in(examine([READY, SEEN], "exec sleep 3600", let_it_be_over))
    assert outcomes["2"] == (["C2"], "")
    assert "took longer than 900 s" in outcomes["3"][1]


@pytest.mark.parametrize(("answers", "why"), [
    ([], "exited without a result"), ([READY], "exited without a result"),
    (['{"cannot": "no room"}'], "no room"),
])  # fmt: skip
def test_a_worker_that_records_nothing_gives_no_verdict(examine, answers, why):
    with pytest.raises(CannotCheck, match=why):
        examine(answers)


def test_a_second_worker_records_for_the_last_exercise_first(examine, monkeypatch, tmp_path):
    monkeypatch.setattr(judging.os, "sched_getaffinity", lambda _: {0, 1})
    monkeypatch.setattr(worker_process, "LONGEST_S", 30.0)
    gate = tmp_path / "gate"
    os.mkfifo(gate)
    ready, seen = (f"read -r _ <&1; echo '{line}'" for line in (READY, SEEN))
    # One is asked for 2, the other for 5, and each waits for it; either may record for 3.
    one = f"read -r _ <&1; read -r _ <{gate}; echo '{SEEN}'; {seen}; exec sleep 3600"
    other = f"read -r _ <&1; echo >{gate}; echo '{SEEN}'; {seen}; exec sleep 3600"
    outcomes = examine([READY], one, beside=[ready, other])
    assert all(outcome.passed for outcome in outcomes), found_in(outcomes)


def test_two_workers_record_each_thing_once():
    asked, shared = [], {}

    def worker(name, ends=False):
        def ask(question):
            asked.append((name, question.recorder))
            if ends:
                raise Ended
            return Reply(name)

        return AskOnce(ask, shared)

    one, other = worker("one"), worker("other")
    assert other(Question("talk")).recording == "other"
    assert one(Question("talk")).recording == "other"
    assert one(Question("talk")).recording == "one"  # a repeated question wants a new recording
    with pytest.raises(Ended):
        worker("last", ends=True)(Question("drive"))
    one(Question("drive"))
    talk, drive = [("other", "talk"), ("one", "talk")], [("last", "drive"), ("one", "drive")]
    assert asked == talk + drive
