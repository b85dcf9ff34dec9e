"""The private parameters of joy_node: from a dict to a checked, frozen dataclass.

Names, meanings and defaults are those of ROS Noetic's package joy, except autorepeat_rate, which is
0 there: a node that stops on silence needs repetitions of a held stick.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

from node_kit.parameters.declaration import checked, number, parameter, switch, text

_PATH = text("a whole path, such as /dev/input/js0", lambda value: value.startswith("/"))


@dataclass(frozen=True)
class DriverParameters:
    """All parameters of the driver. Units: s, Hz; deadzone: fraction of full deflection."""

    dev: str = parameter(
        "/dev/input/js0", _PATH, "device; also a FIFO, or a file of recorded events"
    )
    dev_name: str = parameter(
        "",
        text("the name of a gamepad, or a part of it, or nothing"),
        "used instead of `~dev`; a part must fit one gamepad only",
    )
    dev_ff: str = parameter(
        "", text("the path of a device, which is not used"), "for rumble, as upstream has it"
    )
    deadzone: float = parameter(
        0.05, number(0, 1), "this part around the middle is 0, the rest is stretched; at most 0.9"
    )
    autorepeat_rate: float = parameter(
        20.0, number(0, 1000, "Hz (0: off)"), "repeats what stays the same"
    )
    coalesce_interval: float = parameter(
        0.001, number(0, 10, "s"), "axes that change within it go out together; a button at once"
    )
    default_trig_val: bool = parameter(
        False, switch, "take the axes' values at opening, too; else 0 until they move"
    )
    sticky_buttons: bool = parameter(False, switch, "a press switches a button on or off")
    diagnostic_period: float = parameter(1.0, number(0.1, 60, "s"))


def load(given: Mapping[str, Any]) -> DriverParameters:
    """Return parameters, checked, with the defaults filled in. Raises ValueError, one line."""
    return DriverParameters(**checked(DriverParameters, given))
