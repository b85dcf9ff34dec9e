"""A professor's own course: its files, one line for each fault, and the order of its checks."""

from dataclasses import replace

import pytest

from tutorial_check.checking.checks import checks_of
from tutorial_check.checking.packages import package_of
from tutorial_check.checking.results import UNREACHED, Outcome, Result, Wrong
from tutorial_check.commands.self_test import complaint_of, patch, solutions
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck
from tutorial_testing.claims import claim

pytestmark = claim("A course has its exercises and checks in its order; a fault in it is one line")
YAML = 'title: T\ndocument: sheet\nexercises: {"2": two, "1": {title: one, points: 3}}\n'
CHECKS = '''
from tutorial_check.checking.checks import check
from .other import WORD
@check("S1", "a", "1")
def a(submission): pass
@check("S2", "b", "1.1", needs=(a, "S1 S10"))
def b(submission): return WORD
@check("S10", section="2", timeless=True)
def c(submission):
    """It drives.

    More of it.
    """
'''


@pytest.fixture
def course(tmp_path):
    def make(text=YAML, checks=CHECKS):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        folder.mkdir()
        (folder / "course.yaml").write_text(text)
        (folder / "checks.py").write_text(checks)
        (folder / "other.py").write_text("WORD = 'from beside'\n")
        return read_course(folder)

    return make


def test_a_course_and_its_checks_in_its_order(course):
    own = course()
    exercises = [(n, e.title, e.points, e.document) for n, e in own.exercises.items()]
    assert exercises == [("2", "two", 0.0, "sheet"), ("1", "one", 3, "sheet")]
    checks = checks_of(own)
    places = [(check.id, check.exercise, check.section) for check in checks]
    assert places == [("S10", "2", "sheet 2"), ("S1", "1", "sheet 1"), ("S2", "1", "sheet 1.1")]
    assert checks[2].needs == ("S1", "S1", "S10")
    assert checks[2].function(None) == "from beside"
    assert [check.title for check in checks] == ["it drives", "a", "b"]
    assert checks_of(course(checks="X = 1\n")) == []  # another course in the same process


@pytest.mark.parametrize(("text", "why"), [
    ("", "must be a map of title, document, sheet, language, exercises, variants, packages"),
    ("title: [", "no YAML"),
    ("title: T\n", "exercises: "),
    ("points: 3\n", "points is not known; known are title, document, sheet, language, exercises"),
    ("title: 3\nexercises: {'1': a}\n", "title: 3 is no str"),
    ("packages: [p]\n", "packages: ['p'] is no dict"),
    ("exercises: {1: a}\n", 'exercise 1: write "1", in quotes'),
    ("exercises: {'1': {title: a, points: many}}\n", "points: 'many' is no float"),
    ("exercises: {'1': {title: a, points: .nan}}\n", "exercise 1: points: 0 to 1000000"),
    ("exercises: {'1': {title: a, points: -1}}\n", "exercise 1: points: 0 to 1000000"),
    ("exercises: {'1': {title: a, point: 1}}\n", "point is not known; known are title"),
    ("exercises: {'1': {points: 1}}\n", "title"),
])  # fmt: skip
def test_a_wrong_file_is_one_line(course, text, why):
    with pytest.raises(CannotCheck, match=r"course\.yaml: ") as error:
        course(text)
    assert why in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(("checks", "why"), [
    ("def\n", "checks.py:1: "),
    ("import tutorial_check.judge.scripts\n", "COURSES.md says what a course of an earlier"),
    ("import tutorial_course.other\n", "COURSES.md says what a course of an earlier"),
    ("\nX = unknown\n", "checks.py:2: name 'unknown' is not defined"),
    (CHECKS.replace('"1.1"', '"3"'), "S2: section 3 is of no exercise"),
    (CHECKS.replace('"S10"', '"S1"'), "two checks are S1"),
    (CHECKS.replace("S1 S10", "S1 S7"), "S2 needs S7, which is no check"),
    (CHECKS.replace("(a, ", "(print, "), "checks.py:6: S2 needs print, which is no check"),
    (CHECKS.replace('"a", ', "section="), "checks.py:4: S1: a check has a title, or a doc"),
    (CHECKS.replace('"1.1", ', ""), "checks.py:6: S2: a check has a title, or a doc"),
])  # fmt: skip
def test_wrong_checks_are_one_line(course, checks, why):
    with pytest.raises(CannotCheck) as error:
        checks_of(course(checks=checks))
    assert why in str(error.value) and "\n" not in str(error.value)


@claim("A course of the suite is known by its name; a wrong solution may be a diff")
def test_a_course_that_is_shipped_has_a_name():
    assert read_course("wiki").folder.name == "wiki"
    with pytest.raises(CannotCheck, match="or one of handout, square, wiki"):
        read_course("viki")


def test_page_and_hint_of_the_wiki_name_the_same_dependencies(make_submission):
    course, submission = read_course("wiki"), make_submission("p", "5")
    submission.order = replace(submission.order, course=course.folder)
    page = " ".join((course.folder / "README.md").read_text().split())
    assert "turtlesim_cleaner" in course.packages
    for name, depends in course.packages.items():
        assert f"`{depends}` for `{name}`" in page
        with pytest.raises(Wrong) as wrong:
            package_of(submission, name)
        assert wrong.value.hint == f"catkin_create_pkg {name} {depends}"


@claim("A course of the suite ...", because="a diff")
def test_a_patch_changes_adds_and_removes(tmp_path):
    for name in ("changed", "removed"):
        (tmp_path / name).write_text("a\nb\n\na\nc\n")
    diff = tmp_path / "diff"
    diff.write_text(
        "--- a/changed\n+++ b/changed\n@@ -9 +9 @@\n a\n-b\n+B\n@@\n\n a\n-c\n"
        "--- /dev/null\n+++ b/new/file\n@@\n+x\n--- ../right/removed\n+++ /dev/null\n"
    )
    patch(tmp_path, diff)
    assert (tmp_path / "changed").read_text() == "a\nB\n\na\n"
    assert (tmp_path / "new/file").read_text() == "x\n"
    assert not (tmp_path / "removed").exists()
    diff.write_text("--- a/changed\n+++ b/changed\n@@\n-a\n")
    with pytest.raises(CannotCheck, match="changed has 2 places for: a"):
        patch(tmp_path, diff)
    for text in ("--- a/gone\n+++ /dev/null\n", "--- /dev/null\n+++ b/../gone\n@@\n+x\n"):
        diff.write_text(text)
        with pytest.raises(CannotCheck, match=r"there is no (\.\./)?gone"):
            patch(tmp_path, diff)


@claim("A course of the suite ...", because="of a solution in C++")
def test_a_wrong_solution_in_cpp_is_a_diff_of_the_right_one_in_cpp(course):
    own = course()
    folder = own.folder / "solutions"
    for name in ("right", "right_cpp", "wrong_S1"):
        (folder / name).mkdir(parents=True)
    for name in ("wrong_S2_cpp_late", "wrong_S2_late"):
        (folder / f"{name}.patch").touch()
    layers = {
        name: (check, [layer.name for layer in layers]) for name, check, layers in solutions(own)
    }
    assert layers == {
        "right": ("", ["right"]),
        "right_cpp": ("", ["right_cpp"]),
        "wrong_S1": ("S1", ["right", "wrong_S1"]),
        "wrong_S2_cpp_late": ("S2", ["right_cpp", "wrong_S2_cpp_late.patch"]),
        "wrong_S2_late": ("S2", ["right", "wrong_S2_late.patch"]),
    }


def test_the_check_that_was_not_reached_is_named():
    outcomes = [Outcome("1", [Result("K3", UNREACHED, "")])]
    assert complaint_of("K5", outcomes).endswith("; K3 was not reached")
