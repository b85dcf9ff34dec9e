"""The parameters of kobuki_node's base.yaml."""

import pytest
import yaml

from kobuki_driver.parameters import KobukiParameters, parse_parameters
from kobuki_protocol.battery import Limits
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("The parameters are those of kobuki_node's base.yaml; a mistake is one line")
BASE = REPOSITORY / "common/stand_ins/kobuki_node/param/base.yaml"


def test_base_yaml_has_the_defaults():
    assert parse_parameters(yaml.safe_load(BASE.read_text())) == KobukiParameters()
    assert KobukiParameters().battery == Limits()


@pytest.mark.parametrize(("given", "part"), [
    ({"device_port": "ttyUSB0"}, "~device_port: 'ttyUSB0': must be the path"),
    ({"device_prot": "/dev/kobuki"}, "did you mean ~device_port?"),
    ({"cmd_vel_timeout": 0}, "must be a number from 0.02 to 60 s"),
    ({"cmd_vel_timeout": float("nan")}, "must be a number"),
    ({"odom_frame": "base_footprint"}, "must differ from ~odom_frame"),
    ({"battery_low": 13.0}, "~battery_dangerous: 13.2: must be less than ~battery_low"),
    ({"battery_low": 17.0}, "must be less than ~battery_capacity"),
    ({"publish_tf": "yes"}, "must be true or false"),
    ({"wheel_left_joint_name": "wheel_right_joint"}, "must differ"),
])  # fmt: skip
def test_a_mistake_is_one_line(given, part):
    with pytest.raises(ValueError, match=r"^~\w+: ") as error:
        parse_parameters(given)
    assert part in str(error.value)
