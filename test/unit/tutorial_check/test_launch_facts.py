"""What is read of a node in a launch file."""

from types import SimpleNamespace

import pytest

from tutorial_check.launch_facts import device_of

PARAMS = {"/joy_node/dev": SimpleNamespace(value="/dev/input/js2")}


@pytest.mark.parametrize(
    ("args", "params", "device"),
    [
        ("_dev:=/dev/input/js1 _autorepeat_rate:=20", {}, "/dev/input/js1"),
        ("_autorepeat_rate:=20 _dev:='/dev/input/js1'", PARAMS, "/dev/input/js1"),
        ("", PARAMS, "/dev/input/js2"),
        ("_dev:='/dev/input/js1", {}, ""),
        (None, {}, ""),
    ],
)
def test_the_device_of_a_joystick(args, params, device):
    node = SimpleNamespace(args=args, namespace="/", name="joy_node")
    assert device_of(node, params) == device
