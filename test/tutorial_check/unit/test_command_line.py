"""The command line."""

import sys

import pytest

from tutorial_check.checking.results import OK, UNREACHED, WRONG, Outcome, Result
from tutorial_check.commands import check as command
from tutorial_check.commands import command_line
from tutorial_check.commands.options import parse
from tutorial_check.commands.watch import stamps
from tutorial_check.report.formats import FORMATS
from tutorial_testing.claims import claim

pytestmark = claim(
    "A section is all its exercises, in a shell of a workspace that one is meant, and words that "
    "do not fit are refused"
)
UNDERLAY = ["--underlay", "setup.bash"]
BEFORE = [*UNDERLAY, "--in", "ws"]
WELL = Outcome("2", [Result("C1", OK, "one")], 1.0, True)
BAD = Outcome("2", [Result("C1", WRONG, "no file", hint="mkdir src")], 1.0, True)
NO_VERDICT = Outcome("5", [Result("C21", UNREACHED, "two")], 1.0, True, "C21: no space")


@pytest.mark.parametrize(("words", "exercises"), [
    (["4"], ["4.2", "4.3", "4.4", "4.5"]),
    (["6", "2"], ["2", "6.1", "6.2"]),
    (["4.3", "4"], ["4.2", "4.3", "4.4", "4.5"]),
    (["5.1", "3.2."], ["3", "5"]),
])  # fmt: skip
def test_a_section_is_all_its_exercises(words, exercises):
    assert parse([*BEFORE, *words]).exercises == exercises


def test_in_a_shell_of_a_workspace_that_is_meant(monkeypatch):
    monkeypatch.setenv("TUTORIAL_IN", "/mine")
    assert parse(UNDERLAY).workspace == "/mine"
    assert parse([*UNDERLAY, "--watch"]).workspace == "/mine"
    assert parse([*UNDERLAY, "--in", "/another"]).workspace == "/another"
    options = parse([*UNDERLAY, "--all", "/class"])
    assert (options.all, options.jobs, options.hints) == ("/class", 2, 2)


@claim("A command's help has its options alone, and `check --help` all")
@pytest.mark.parametrize(("words", "command"), [
    ("--in ws 3 --keep a --json b --junit c --gradescope d --classroom e --no-hints", "check"),
    ("3 --in ws --variant file.yaml --watch --hints 0 --language cpp", "watch"),
    ("--solution 3 --in ws", "solution"),
    ("3 --all=class --jobs 3 --again --out a --variants 1 --keep b --cluster c", "all"),
    ("--course wiki --self-test --jobs 3", "self-test"),
    ("--package gradescope 2 3 --out a --course square --language any", "package"),
    ("--variants 2026 --show-variant ada", "show-variant"),
])  # fmt: skip
def test_an_option_says_which_command_is_meant(words, command, capsys):
    """Its help has its options; the general help has all."""
    words = words.replace(" 2 3 ", " 1 ").split()
    assert parse([*UNDERLAY, *words]).command == command
    for given in (words, [])[command == "check" :]:
        with pytest.raises(SystemExit, match="0"):
            parse([*given, "--help"])
        shown = capsys.readouterr().out
        assert all(word.partition("=")[0] in shown for word in words if word.startswith("-"))
        assert ("--show-variant NAME" in shown) == (command == "show-variant" or not given)
    assert command in command_line.COMMANDS


@pytest.mark.parametrize(("words", "error"), [
    ([*UNDERLAY, "3"], "which workspace? For example: --in ~/ros/hydro/catkin_ws 3;"),
    *(([*BEFORE, word], "no exercise") for word in ("8", "", ".", "4.9")),
    *(([*UNDERLAY, f"--{name}", ""], "an empty word is no path") for name in ("in", "all")),
    *(([*BEFORE, f"--{name}", ""], "an empty word") for name in ("keep", "json", "underlay")),
    ([*UNDERLAY, "--all", "class", "--json", "a"], "--json is for one workspace"),
    ([*UNDERLAY, "--all", "class", "--json=a"], "--json is for one workspace, not for --all"),
    ([*UNDERLAY, "--all", "class", "--watch"], "--watch is for one workspace, not for --all"),
    ([*BEFORE, "--all", "class"], "--in is for one workspace, not for --all"),
    ([*BEFORE, "--watch", "--classroom", "a"], "--classroom is for one workspace, not for --w"),
    ([*BEFORE, "--watch", "--solution", "3"], "--watch is for one workspace, not for --sol"),
    ([*BEFORE, "--out", "a"], "--out is for --all and --package, not for one workspace"),
    ([*BEFORE, "--jobs", "2"], "--jobs is for --all and --self-test, not for one workspace"),
    ([*BEFORE, "--again"], "--again is for --all, not for one workspace"),
    ([*BEFORE, "--variants", "1"], "--variants is for --all and --show-variant, not for"),
    ([*UNDERLAY, "--package", "a", "--all", "b"], "--all is a command, not for --package"),
    ([*UNDERLAY, "--self-test", "--variant", "a"], "--variant is for one workspace, --all and"),
    ([*UNDERLAY, "--self-test", "--keep", "a"], "--keep is for one workspace and --all, not"),
    ([*UNDERLAY, "--self-test", "4.3"], "unrecognized arguments: 4.3"),
    ([*BEFORE, "--language", "java"], '"java": must be python, cpp or any'),
    ([*UNDERLAY, "--self-test", "--language", "cpp"], "--language is for one workspace, --all"),
    ([*BEFORE, "--solution"], "--solution of which exercise? For example: --solution 4.3"),
    ([*BEFORE, "--colour"], "unrecognized arguments: --colour"),
])  # fmt: skip
def test_words_that_are_refused(words, error, capsys, monkeypatch):
    monkeypatch.delenv("TUTORIAL_IN", raising=False)
    with pytest.raises(SystemExit, match="2"):
        parse(words)
    assert error in capsys.readouterr().err


@pytest.fixture
def main(monkeypatch):
    def called(examine, *words):
        monkeypatch.setattr(command, "examine", examine)
        monkeypatch.setattr(sys, "argv", ["check", *UNDERLAY, *map(str, words)])
        monkeypatch.setenv("TUTORIAL_IN", "ws")
        with pytest.raises(SystemExit) as ended:
            command_line.main()
        return ended.value.code

    return called


@claim("Exit code 0 is ...", because="right and wrong")
@pytest.mark.parametrize(
    ("outcomes", "code"), [([WELL], 0), ([BAD], 1), ([WELL, NO_VERDICT], 2), ([BAD, NO_VERDICT], 2)]
)
def test_the_exit_code_tells_right_wrong_and_no_verdict(main, outcomes, code, capsys, tmp_path):
    files = [word for name in FORMATS for word in (f"--{name}", tmp_path / name)]
    assert main(lambda *_, **__: outcomes, *files) == code
    written = {path.name for path in tmp_path.iterdir() if path.stat().st_size > 100}
    assert written == {*FORMATS} - {"classroom" if code == 2 else ""}
    out, err = capsys.readouterr()
    assert f"{sum(outcome.passed for outcome in outcomes)} of {len(outcomes)} exercises done" in out
    assert ("check: 5: no verdict: C21: no space\n" in err) == (NO_VERDICT in outcomes)
    assert (f"check: {tmp_path}/classroom is not written" in err) == (NO_VERDICT in outcomes)


def test_no_file_has_hints_if_there_are_none(main, tmp_path):
    main(lambda *_, **__: [BAD], "--keep", tmp_path, "--json", tmp_path / "report", "--no-hints")
    (kept,) = tmp_path.glob("*.json")
    assert '"recordings"' in kept.read_text()
    assert not any("mkdir src" in file.read_text() for file in (kept, tmp_path / "report"))


@claim("A bug of the checker, or a file that cannot be written, is no fault of the student's")
@pytest.mark.parametrize("name", FORMATS)
def test_a_bug_of_the_checker_is_no_fault_of_the_students(main, tmp_path, capsys, name):
    (tmp_path / "file").write_text("last week's")
    assert main(lambda *_, **__: [].pop(), f"--{name}", tmp_path / "file") == 2
    error = capsys.readouterr().err
    assert "check: IndexError: pop from empty list (test_command_line.py:" in error
    assert "a fault of the check, not of your exercises" in error and "Traceback" not in error
    assert not (tmp_path / "file").exists()  # last week's result is not today's


def test_a_reader_that_has_seen_enough_is_no_fault(main, monkeypatch, capsys):
    def closed(*_, **__):
        raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", sys.stdout)  # main() closes it
    monkeypatch.setattr(command_line.bubblewrap, "lacking", list)  # on any machine
    assert main(closed) == 2 and not capsys.readouterr().err


@claim("A bug of the checker, or ...", because="a file that cannot be written")
def test_a_file_that_cannot_be_written(main, tmp_path, capsys):
    """The other files are written; a fault known beforehand stops the run at its start."""
    files = "--json", tmp_path / "json", "--junit", tmp_path / "junit"
    assert main(lambda *_, **__: (tmp_path / "json").mkdir() or [WELL], *files) == 2
    assert (tmp_path / "junit").exists()
    assert main(lambda *_, **__: pytest.fail("started"), *files) == 2
    why = f"check: no verdict: {tmp_path / 'json'}: Is a directory"
    assert capsys.readouterr().err.count(why) == 2


@claim("--watch checks again ...", because="build and devel")
@pytest.mark.parametrize("folder", ["ws", "build/ws", "me~/devel"])
def test_build_devel_and_files_of_editors_are_not_watched(tmp_path, folder):
    names = "src/package.xml build/CMakeCache.txt devel/setup.bash src/.joy2twist.py.swp src/a.py~"
    for name in names.split():
        (tmp_path / folder / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / name).touch()
    assert list(stamps(tmp_path / folder)) == [str(tmp_path / folder / "src/package.xml")]


def test_a_zip_cannot_be_watched(main, tmp_path, capsys):
    (tmp_path / "ws.zip").touch()
    assert main(pytest.fail, "--in", tmp_path / "ws.zip", "--watch") == 2
    assert "ws.zip: no folder, and --watch is for one" in capsys.readouterr().err


def test_a_folder_of_tasks_is_for_a_class(main, tmp_path, capsys):
    assert main(pytest.fail, "--variant", tmp_path) == 2
    assert "--variant FOLDER is for --all and --show-variant" in capsys.readouterr().err


@pytest.mark.parametrize(("words", "printed"), [
    (["--variants", "7", "--show-variant", "ada"], "axis_linear: 1"),
    (["--package", "github:a/b", "--out"], "check.yml"),
])  # fmt: skip
def test_what_is_printed(main, words, printed, tmp_path, capsys):
    words = [*words, tmp_path / "check.yml"] if "--out" in words else words
    assert main(pytest.fail, *words) == 0
    assert printed in capsys.readouterr().out
