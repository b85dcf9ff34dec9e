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
        ("dev", "js0", "Parameter ~dev is 'js0'; allowed is a whole path, such as /dev/input/js0."),
        ("dev", 0, "Parameter ~dev is 0; "),
        ("dev_name", 710, "Parameter ~dev_name is 710; "),
        ("deadzone", -0.1, "Parameter ~deadzone is -0.1; allowed is a number from 0 to 1."),
        ("deadzone", 1638, "Parameter ~deadzone is 1638; "),
        ("deadzone", float("nan"), "Parameter ~deadzone is nan; "),
        ("autorepeat_rate", "fast", "Parameter ~autorepeat_rate is 'fast'; "),
        ("autorepeat_rate", -1, "Parameter ~autorepeat_rate is -1; "),
        ("coalesce_interval", True, "Parameter ~coalesce_interval is True; "),
        ("default_trig_val", 1, "Parameter ~default_trig_val is 1; allowed is true or false."),
        ("deadzon", 0.1, "There is no parameter ~deadzon; the parameters are autorepeat_rate, "),
    ],
)
def test_a_mistake_is_named(name, value, line):
    with pytest.raises(ValueError) as error:
        load({name: value})
    assert str(error.value).startswith(line)
    assert "\n" not in str(error.value)
