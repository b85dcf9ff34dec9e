"""The driver's private parameters."""

import pytest

from gamepad.driver.parameters import load


def test_the_defaults_are_those_of_the_package_joy_but_for_autorepeat():
    p = load({})
    assert (p.dev, p.dev_name, p.deadzone) == ("/dev/input/js0", "", 0.05)
    assert (p.autorepeat_rate, p.coalesce_interval) == (20.0, 0.001)
    assert (p.default_trig_val, p.sticky_buttons) == (False, False)


def test_values_are_taken():
    given = {"dev": "/dev/input/js3", "deadzone": 0, "autorepeat_rate": 50, "sticky_buttons": True}
    p = load(given)
    assert {name: getattr(p, name) for name in given} == given


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("dev", "js0", "~dev: 'js0': must be a whole path, such as /dev/input/js0"),
        ("dev", 0, "~dev: 0: must be "),
        ("dev_name", 710, "~dev_name: 710: must be "),
        ("deadzone", -0.1, "~deadzone: -0.1: must be a number from 0 to 1"),
        ("deadzone", 1638, "~deadzone: 1638: must be "),
        ("deadzone", float("nan"), "~deadzone: nan: must be "),
        ("autorepeat_rate", "fast", "~autorepeat_rate: 'fast': must be "),
        ("autorepeat_rate", -1, "~autorepeat_rate: -1: must be "),
        ("coalesce_interval", True, "~coalesce_interval: True: must be "),
        ("default_trig_val", 1, "~default_trig_val: 1: must be true or false"),
        ("deadzon", 0.1, "~deadzon: 0.1: no such parameter; did you mean ~deadzone?"),
    ],
)
def test_a_mistake_is_named(name, value, line):
    with pytest.raises(ValueError) as error:
        load({name: value})
    assert str(error.value).startswith(line)
    assert "\n" not in str(error.value)
