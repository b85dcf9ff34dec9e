"""The private parameters of the driver, those of kobuki_node's base.yaml, and their checks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Mapping

from kobuki_protocol.battery import Limits
from node_kit.parameters.declaration import checked, number, parameter, switch, text

_NAME = text(
    "a name without blanks and leading slash", lambda value: re.fullmatch(r"[^/\s]\S*", value)
)
_PATH = text("the path of a device", lambda value: re.fullmatch(r"/\S+", value))
_VOLTAGE = number(5.0, 25.0, "V")


@dataclass(frozen=True)
class KobukiParameters:
    """The parameters with their defaults; README.md has them as a table."""

    device_port: str = parameter("/dev/kobuki", _PATH, "the serial port; the driver waits for it")
    cmd_vel_timeout: float = parameter(
        0.6, number(0.02, 60.0, "s"), "after which a command expires and the robot stops"
    )
    publish_tf: bool = parameter(
        True, switch, "false leaves the transform to another node, such as a filter"
    )
    use_imu_heading: bool = parameter(
        True, switch, "true takes the heading from the gyro, false from the wheels"
    )
    odom_frame: str = parameter("odom", _NAME)
    base_frame: str = parameter("base_footprint", _NAME)
    wheel_left_joint_name: str = parameter("wheel_left_joint", _NAME)
    wheel_right_joint_name: str = parameter("wheel_right_joint", _NAME)
    battery_capacity: float = parameter(16.5, _VOLTAGE, "100 %")
    battery_low: float = parameter(14.0, _VOLTAGE, "below it the battery is low")
    battery_dangerous: float = parameter(13.2, _VOLTAGE, "5 %; below it the battery is critical")
    acceleration_limiter: bool = parameter(
        False,
        switch,
        "velocities rise by at most 0.5 m/s2 and 3.5 rad/s2, and fall by 1.2 times that",
    )

    @property
    def battery(self) -> Limits:
        """Return the voltages of the battery."""
        return Limits(self.battery_capacity, self.battery_low, self.battery_dangerous)


def parse_parameters(given: Mapping[str, Any]) -> KobukiParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    parameters = KobukiParameters(**checked(KobukiParameters, given))
    for left, right in (
        ("odom_frame", "base_frame"),
        ("wheel_left_joint_name", "wheel_right_joint_name"),
    ):
        value = getattr(parameters, left)
        if value == getattr(parameters, right):
            raise ValueError(f"~{right}: {value!r}: must differ from ~{left}")
    for less, more in (
        ("battery_dangerous", "battery_low"),
        ("battery_low", "battery_capacity"),
    ):
        value = getattr(parameters, less)
        if value >= getattr(parameters, more):
            raise ValueError(f"~{less}: {value:g}: must be less than ~{more}")
    return parameters
