"""The private parameters of joy_node: from a dict to a checked, frozen dataclass (pure).

Names, meanings and defaults are those of ROS Noetic's package joy, but for autorepeat_rate, which
is 0 there: a node that stops the robot on silence needs a held stick to be repeated.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

from node_kit.parameters import checked, number, parameter, switch, text

_PATH = text("a whole path, such as /dev/input/js0", lambda value: value.startswith("/"))


@dataclass(frozen=True)
class DriverParameters:
    """All parameters of the driver. Units: s, Hz; deadzone as a part of an axis' way."""

    dev: str = parameter("/dev/input/js0", _PATH)
    dev_name: str = parameter("", text("the name of a gamepad, or a part of it, or nothing"))
    dev_ff: str = parameter("", text("the path of a device, which is not used"))  # for rumble
    deadzone: float = parameter(0.05, number(0, 1))
    autorepeat_rate: float = parameter(20.0, number(0, 1000, "Hz (0: off)"))
    coalesce_interval: float = parameter(0.001, number(0, 10, "s"))
    default_trig_val: bool = parameter(False, switch)
    sticky_buttons: bool = parameter(False, switch)
    diagnostic_period: float = parameter(1.0, number(0.1, 60, "s"))


def load(given: Mapping[str, Any]) -> DriverParameters:
    """Check the given private parameters and fill in the defaults.

    Raises ValueError, one line that names the parameter, its value and what is allowed.
    """
    return DriverParameters(**checked(DriverParameters, given))
