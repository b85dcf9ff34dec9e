"""Variants: what a file may contain, what a seed draws, and the words of a task."""

import dataclasses
import tempfile

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from courses.handout.task import JoystickTask
from tutorial_check.course.definition import read_course
from tutorial_check.course.tasks import drawn, read_variant, sheet, variant_of
from tutorial_check.errors import CannotCheck
from tutorial_testing.claims import claim

pytestmark = claim("What a seed draws is allowed and stays the same; a student's file comes first")
COURSE = read_course()
ALL = yaml.safe_load(
    "{axis_linear: 3, axis_angular: 4, scale_linear: 0.5, joy: /stick, cmd_vel: /drive,"
    " package: stick_drive, enable_button: 5, rate: 20}"
)


@pytest.mark.parametrize(("text", "why"), [
    ("[3]", "a map of values is wanted"),
    ("axis: 3", "axis is not known; known are: axis_linear, axis_angular"),
    ("axis_linear: 9", "axis_linear: 9; allowed is 0 to 5"),
    ("axis_linear: true", "axis_linear: True; allowed is 0 to 5"),
    ("axis_linear: 0", "axis_angular and axis_linear are both 0"),
    ("scale_linear: .nan", "scale_linear: nan; allowed is -2.0 to -0.2 or 0.2 to 2.0"),
    ("joy: stick", "joy: 'stick'; allowed is what fits /"),
    ("package: Stick Drive", "package: 'Stick Drive'; allowed"),
    ("joy: /x\ncmd_vel: /x", "cmd_vel"),
    ("a: [", "no YAML"),
])  # fmt: skip
def test_a_wrong_file_is_one_line(text, why, tmp_path):
    file = tmp_path / "v.yaml"
    file.write_text(text)
    with pytest.raises(CannotCheck) as error:
        read_variant(COURSE, file)
    assert why in str(error.value) and str(file) in str(error.value)
    assert "\n" not in str(error.value)


@given(st.text(), st.text())
def test_what_is_drawn_is_allowed(seed, name):
    values = drawn(COURSE, seed, name)
    assert list(values) == list(COURSE.variants)
    with tempfile.NamedTemporaryFile("w") as file:
        yaml.safe_dump(values, file)
        file.flush()
        assert read_variant(COURSE, file.name) == values


def test_what_a_seed_draws_does_not_change_with_python_or_machine():
    numbers = "axis_linear: 1, axis_angular: 4, scale_linear: 0.6, scale_angular: 0.5"
    names = "joy: /f710, cmd_vel: /wheels, package: stick_drive, node: converter"
    text = f"{{{numbers}, {names}, enable_button: 7, rate: 20}}"
    assert drawn(COURSE, "7", "ada") == yaml.safe_load(text)


def test_whose_variant_it_is(tmp_path):
    """The student's own file, else what the seed draws, else the file for all, else none."""
    for_all = tmp_path / "all.yaml"
    for_all.write_text("rate: 5")
    tasks = tmp_path / "tasks"
    tasks.mkdir()
    (tasks / "ada.yaml").write_text("rate: 25")
    (tasks / "eve.yaml").symlink_to("/etc/shadow")
    assert variant_of(COURSE, "ada", str(tasks), "7") == {"rate": 25}
    with pytest.raises(CannotCheck, match=r"eve\.yaml: a link is not followed"):
        variant_of(COURSE, "eve", str(tasks), "7")
    assert variant_of(COURSE, "bob", str(tasks), "7") == drawn(COURSE, "7", "bob")
    assert variant_of(COURSE, "bob", str(tasks)) == {}
    assert variant_of(COURSE, "bob", str(for_all)) == {"rate": 5}
    assert variant_of(COURSE, "bob", None) == {}


def test_a_task_sheet_has_all_values_and_the_file():
    text = sheet(COURSE, ALL, "ada")
    assert "the task of ada" in text and "axis 3 of the joystick drives linear.x" in text
    assert yaml.safe_load(text[text.rindex("axis_linear:") :]) == ALL
    with pytest.raises(CannotCheck, match="no variant of ada"):
        sheet(COURSE, {}, "ada")
    odd = "{nonsense} {name:9999999999} {name.__class__} {{} {"
    own = dataclasses.replace(COURSE, sheet=f"{{name}}: {odd}")
    assert sheet(own, ALL, "{file}") == f"{{file}}: {odd}"


@claim("A right solution ...", because="only hints show values")
def test_words_name_the_values_of_a_task_in_hints_alone():
    task = JoystickTask(ALL)
    names, answers = task.names, task.answers
    topics = ("<joy>", "<cmd_vel>", "<package>")
    assert (names.joy, names.cmd_vel, names.package) == topics
    assert (answers.joy, answers.cmd_vel, answers.package) == ("/stick", "/drive", "stick_drive")
    assert names.lb == names.button == "<enable_button>" and answers.lb == "buttons[5]"
    assert names.axes[:4] == ("axes[axis_angular]", "axes[axis_linear]", "axes[2]", "axes[1]")
    assert names.rules[1] == "scale_linear * axes[axis_linear]"
    assert answers.rules == {1: "0.5 * axes[3]", 0: "axes[4]"}
    assert task.fill("{n.sticks[1]} on {n.joy}") == "axes[axis_linear] on <joy>"
    names = JoystickTask({}).names
    assert [names.lb, names.button] == ["LB", "buttons[4]"]
    assert list(names.rules.values()) == ["axes[1]", "axes[0]"]


def test_a_factor_below_0_is_seen_above_0_and_named_as_it_is():
    """The checks send the opposite sign, and so see a positive factor; words have the real one."""
    task = JoystickTask({"axis_linear": 3, "scale_linear": -0.5})
    assert task.factors == {0: 0.5}
    assert task.answers.rules[1] == "-0.5 * axes[3]"
    assert task.product(-0.4, 1) == "0.40 * axes[axis_linear]"
