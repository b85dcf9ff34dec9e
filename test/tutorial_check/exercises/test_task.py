"""Tasks: a right solution is right, one of another task is wrong; no result gives answers away."""

import re

import pytest
from edits import at_night, put
from solution import TALKER, J

from tutorial_check.course.definition import read_course
from tutorial_check.course.tasks import drawn
from tutorial_check.report.text import lines_of
from tutorial_testing.claims import claim

pytestmark = claim(
    "A right solution of a student's own task is right, that of another is wrong, and only hints "
    "show values"
)
COURSE = read_course()
TOPICS = {"joy", "cmd_vel"}
FEW = {
    "axis_linear": 5,
    "axis_angular": 2,
    "scale_linear": -2.0,
    "rate": 1,
}  # else the handout's
ADA, BOB = (drawn(COURSE, "test", name) for name in ("ada", "bob"))
NAMES_THE_PACKAGE = (f'pkg="{J}"', f"find {J})", f"<name>{J}<", f"project({J})", f"_manifest('{J}'")
HANDOUT = {"axis_linear": 1, "axis_angular": 0, "scale_linear": 1.0, "scale_angular": 1.0,
           "joy": "/joy", "cmd_vel": "/cmd_vel", "package": J, "node": "listener",
           "rate": 10}  # fmt: skip
CHECKS = {"joy": "C14", "cmd_vel": "C15", "package": "C12", "node": "C15", "rate": "C6"}


def texts(src):
    """Return {path: text} of all programs and launch files in a workspace."""
    files = (path for path in src.rglob("*") if path.is_file() and path.suffix != ".bag")
    return {path: path.read_text() for path in files}


def turn(src, values):
    """Change the literal solution in a src folder into one of another task."""
    its = {**HANDOUT, **values}
    held = f" * data.buttons[{values['enable_button']}]" if "enable_button" in values else ""
    new = {
        "data.axes[1]": f"{its['scale_linear']} * data.axes[{its['axis_linear']}]{held}",
        "data.axes[0]": f"{its['scale_angular']} * data.axes[{its['axis_angular']}]{held}",
        '("/joy"': f'("{its["joy"]}"',
        "'/cmd_vel'": f"'{its['cmd_vel']}'",
        'from="/cmd_vel"': f'from="{its["cmd_vel"]}"',
        "'listener'": f"'{its['node']}'",
        **{quoted: quoted.replace(J, its["package"]) for quoted in NAMES_THE_PACKAGE},
    }
    pattern = "|".join(map(re.escape, new))
    for path, text in texts(src / J).items():
        own = [key for key in TOPICS & set(values) if f'from="/{key}"' not in text]
        remaps = "".join(f'<remap from="{its[key]}" to="/{key}"/>' for key in own)
        connected = re.sub(f'(<node pkg="{J}"[^>]*>)', rf"\1{remaps}", text)
        path.write_text(re.sub(pattern, lambda word: new[word[0]], connected))
    (src / J).rename(src / its["package"])
    put(TALKER, "Rate(10)", f"Rate({its['rate']})")(src)


@pytest.fixture
def wrong_of(literal, examined):
    """wrong_of(exercises, values): a task's unsuccessful results; none gives it away."""

    def check(exercises, values):
        outcomes = examined(literal.parent, exercises, variant=values)
        assert not [outcome.trouble for outcome in outcomes if outcome.trouble]
        results = [result for outcome in outcomes for result in outcome.results]
        own = "\n".join((*texts(literal).values(), *map(str, literal.rglob("*"))))
        for result in results:
            assert not given_away(result, values, own), "\n".join(lines_of(result))
        return [result for result in results if result.status in ("wrong", "unreached")]

    return check


def given_away(result, values, own):
    """Return values of a task that a result names outside its hint and the student's files lack."""
    words = "\n".join((result.title, result.expected, result.seen, result.where, result.look))
    tokens = {
        **{key: rf"axes\[{values[key]}\]|axis {values[key]}\b" for key in values if "axis_" in key},
        **{key: rf"{values[key]}(?!\w)" for key in TOPICS & set(values)},
        **{key: rf"\b{values[key]}\b" for key in ("package", "node") if key in values},
        "enable_button": rf"buttons\[{values.get('enable_button')}\]",
    }
    numbers = ("scale_linear", "scale_angular", "rate")

    def is_new(token):
        return any(match[0] not in own for match in re.finditer(token, words))

    new = [key for key, token in tokens.items() if is_new(token)]
    return new + [key for key in numbers if re.search(rf"\b{values.get(key)}\b", result.expected)]


@pytest.mark.parametrize("values", [ADA, *at_night(BOB, FEW)], ids=str)
def test_a_right_solution_of_a_task_is_right(values, literal, wrong_of):
    turn(literal, values)
    assert not [*map(lines_of, wrong_of(COURSE.by_default, values))]


@pytest.mark.night
@pytest.mark.parametrize(
    "key", [*CHECKS, "enable_button", "scale_linear", "scale_angular", "axis_linear"]
)
def test_each_value_of_a_task_is_checked(key, literal, wrong_of):
    """All is right except for one value, the handout's."""
    values = BOB
    turn(literal, {name: value for name, value in values.items() if name != key})
    first = wrong_of(["3" if key == "rate" else "4.3"], values)[0]
    assert (first.status, first.id) == ("wrong", CHECKS.get(key, "C16"))


def test_a_factor_has_its_sign(literal, wrong_of):
    turn(literal, {"scale_linear": 0.5})
    wrong = wrong_of(["4.3"], {"scale_linear": -0.5})[0]
    assert (wrong.id, wrong.hint) == ("C16", "linear.x = -0.5 * axes[1]")
    assert "linear.x = 0.50 * axes[1]: the sign is wrong" in wrong.seen
