"""The node joy_remap: ROS on one side, formulas on the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

import rospy
from sensor_msgs.msg import Joy

from gamepad.remap.formulas import Formula, formula
from node_kit.parameters.declaration import unknown
from node_kit.ros.lifecycle.start import run
from node_kit.ros.log import Log

NODE_NAME = "joy_remap"
PARTS = ("axes", "buttons")
KNOWN = ("mappings", "queue_size")  # Upstream has queue_size; it has no effect here.


@dataclass(frozen=True)
class Mappings:
    """A formula for each axis and each button that the node publishes."""

    axes: list[Formula]
    buttons: list[Formula]


def load(given: Mapping[str, Any]) -> Mappings:
    """Return ~mappings. Raises ValueError, one line."""
    for name in given:
        if name not in KNOWN:
            raise ValueError(unknown(name, given[name], KNOWN))
    mappings = given.get("mappings", {})
    if not isinstance(mappings, dict):
        raise ValueError("~mappings: must have the lists axes and buttons")
    lists: dict[str, list[Formula]] = {}
    for part in PARTS:
        values = mappings.get(part, [])
        if not isinstance(values, list):
            raise ValueError(f"~mappings/{part}: must be a list of formulas")
        try:
            lists[part] = [formula(value) for value in values]
        except ValueError as error:
            raise ValueError(f"~mappings/{part}: {error}") from None
    return Mappings(**lists)


class JoyRemap:
    """Publishes each Joy as the formulas make it.

    Subscriber: joy_in (sensor_msgs/Joy). Publisher: joy_out (sensor_msgs/Joy)
    Parameters: ~mappings/axes, ~mappings/buttons: lists of formulas, both []
    """

    def __init__(self, mappings: Mappings) -> None:
        """Take the formulas."""
        self._mappings, self._warn = mappings, Log().warn
        self._reported = ""
        self._publisher = rospy.Publisher("joy_out", Joy, queue_size=1)
        rospy.Subscriber("joy_in", Joy, self._on_joy, queue_size=1, tcp_nodelay=True)

    def _on_joy(self, joy: Joy) -> None:
        controls = {"axes": joy.axes, "buttons": joy.buttons}
        try:
            axes = [float(compute(controls)) for compute in self._mappings.axes]
            buttons = [int(compute(controls) > 0) for compute in self._mappings.buttons]
        except IndexError:
            has = f"{len(joy.axes)} axes and {len(joy.buttons)} buttons"
            self._report(f"a Joy is not passed on: the formulas need more than its {has}")
            return
        except (ArithmeticError, TypeError) as error:
            self._report(f"a Joy is not passed on: {error}")
            return
        self._publisher.publish(Joy(joy.header, axes, buttons))

    def _report(self, line: str) -> None:
        """Warn, unless the last warning was the same."""
        if line != self._reported:
            self._reported = line
            self._warn(line)


def main() -> int:
    """Run the node until it is shut down; return its exit code."""
    return run(NODE_NAME, load, lambda mappings: (JoyRemap(mappings), rospy.spin()))
