"""The driver's private parameters; test/unit/node_kit tests each kind of check."""

import pytest

from gamepad.driver.parameters import load


def test_the_defaults_are_those_of_the_package_joy_but_for_autorepeat():
    p = load({})
    assert (p.dev, p.dev_name, p.deadzone) == ("/dev/input/js0", "", 0.05)
    assert (p.autorepeat_rate, p.coalesce_interval) == (20.0, 0.001)
    assert (p.default_trig_val, p.sticky_buttons) == (False, False)


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("dev", "js0", "~dev: 'js0': must be a whole path, such as /dev/input/js0"),
        ("deadzone", 1638, "~deadzone: 1638: must be a number from 0 to 1"),
        ("autorepeat_rate", -1, "~autorepeat_rate: -1: must be a number from 0 to 1000 Hz"),
        ("coalesce_interval", 11, "~coalesce_interval: 11: must be a number from 0 to 10 s"),
        ("default_trig_val", 1, "~default_trig_val: 1: must be true or false"),
        ("deadzon", 0.1, "~deadzon: 0.1: no such parameter; did you mean ~deadzone?"),
    ],
)
def test_a_mistake_is_named(name, value, line):
    with pytest.raises(ValueError) as error:
        load({name: value})
    assert str(error.value).startswith(line)
