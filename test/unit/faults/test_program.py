"""The command line of the hunt: what it takes, what it refuses, and how a run is repeated."""

import pytest

from tutorial_faults.live import program


@pytest.fixture
def hunts(monkeypatch):
    """The seeds of the hunts that main() would have run, on a machine that stays as it is."""
    seeds = []
    monkeypatch.setattr(program.hosts, "move_in", lambda arguments: None)
    monkeypatch.setattr(program.signal, "signal", lambda *_: None)
    monkeypatch.setattr(program, "hunt", lambda options: seeds.append(options.seed) or 0)
    return seeds


def test_numbers_above_0_are_taken():
    assert program.parse(["--for", "0.5"]).seconds == 0.5
    assert program.parse(["--soak", "1"]).soak == 1.0
    assert program.parse(["--trials", "1"]).trials == 1
    assert program.parse(["--fuzz", "1000000"]).fuzz == 1_000_000


@pytest.mark.parametrize("option", ["--for", "--soak"])
@pytest.mark.parametrize("text", ["-1", "0", "nan", "inf", "1e999", "long", ""])
def test_a_time_that_is_none_is_refused(option, text, capsys):
    refused([option, text], f"{option}: {text}: not a number above 0, such as", capsys)


@pytest.mark.parametrize("option", ["--trials", "--fuzz"])
@pytest.mark.parametrize("text", ["-5", "0", "1.5", "nan", "inf", "many", ""])
def test_a_count_that_is_none_is_refused(option, text, capsys):
    refused([option, text], f"{option}: {text}: not a whole number above 0, such as", capsys)


def test_a_time_and_a_count_exclude_each_other(capsys):
    refused(["--for", "60", "--trials", "5"], "not allowed with argument --for", capsys)


def refused(arguments, why, capsys):
    with pytest.raises(SystemExit) as ended:
        program.parse(arguments)
    assert ended.value.code == program.CANNOT
    assert why in capsys.readouterr().err.splitlines()[-1]


def test_help_is_its_own(capsys):
    with pytest.raises(SystemExit) as ended:
        program.main(["--help"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("usage: ./tutorial faults ")


@pytest.mark.parametrize(
    "path, why", [("nodir/x.csv", "No such file or directory"), ("", "Is a directory")]
)
def test_a_table_that_cannot_be_written_is_one_line_and_no_trial(
    path, why, hunts, tmp_path, capsys
):
    table = str(tmp_path / path)
    assert program.main(["--trials", "1", "--table", table]) == program.CANNOT
    assert capsys.readouterr().err == f"faults: {table}: cannot be written: {why}\n"
    assert hunts == []


def test_without_a_seed_the_first_line_says_which_and_how_to_repeat_it(hunts, capsys):
    assert program.main(["--trials", "2", "--kinds", "stop", "--table", "/dev/null"]) == 0
    assert capsys.readouterr().out == (
        "faults: seed 1; the same again: "
        "./tutorial faults --trials 2 --kinds stop --table /dev/null --seed 1\n"
    )
    assert hunts == [1]


def test_a_seed_that_was_given_needs_no_word(hunts, capsys):
    assert program.main(["--seed", "0"]) == 0
    assert capsys.readouterr().out == ""
    assert hunts == [0]
