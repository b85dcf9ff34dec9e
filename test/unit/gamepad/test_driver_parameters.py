"""The driver's private parameters; test/unit/node_kit tests each kind of check."""

import pytest

from gamepad.driver.parameters import load


def test_the_defaults_are_those_of_the_package_joy_but_for_autorepeat():
    p = load({})
    assert (p.dev, p.dev_name, p.deadzone) == ("/dev/input/js0", "", 0.05)
    assert (p.autorepeat_rate, p.coalesce_interval) == (20.0, 0.001)
    assert (p.default_trig_val, p.sticky_buttons) == (False, False)


def test_a_device_is_a_whole_path():
    with pytest.raises(ValueError, match="~dev: 'js0': must be a whole path, such as /dev/input"):
        load({"dev": "js0"})
