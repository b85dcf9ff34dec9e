"""The private parameters of serial_kobuki and their checks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Mapping

from fake_turtlebot_sim.serial_kobuki.damage import STALL_EVERY_S
from fake_turtlebot_sim.serial_kobuki.firmware import DOCK_CHARGING, Equipment
from fake_turtlebot_sim.simulator.differential_drive import Pose
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, simulated
from fake_turtlebot_sim.simulator.parameters import parse_parameters as parse_simulation
from fake_turtlebot_sim.simulator.world import World
from kobuki_protocol.identity import FirmwareVersion
from node_kit.parameters.declaration import checked, declared, number, parameter, text, whole_number

NODE_NAME = "serial_kobuki"
CHARGERS = {"none": 0, "dock": DOCK_CHARGING, "adapter": 22}  # charger in the core packet
_SHARE = number(0.0, 1.0, "(0: none, 1: all)")
_VERSION = text(
    "empty, or major.minor.patch", lambda value: re.fullmatch(r"(\d\d?\.\d\d?\.\d\d?)?", value)
)


@dataclass(frozen=True)
class SerialKobukiParameters:
    """The parameters with their defaults; common/doc/SERIAL_KOBUKI.md has them as a table."""

    link: str = parameter("", text("a path, or empty"), "symlink to the pseudo terminal")
    world: World | None = simulated("world")
    initial_x: float | str = simulated("initial_x")
    initial_y: float | str = simulated("initial_y")
    initial_yaw: float | str = simulated("initial_yaw")
    wheel_noise: float = simulated("wheel_noise")
    wheel_radius_ratio: float = simulated("wheel_radius_ratio")
    track_ratio: float = simulated("track_ratio")
    seed: int = parameter(0, whole_number(), "the same seed gives the same noise and damage")
    base_control_timeout: float = parameter(
        0.6,
        number(0.02, 60.0, "s"),
        "without a base control for so long, the firmware stops the wheels",
    )
    battery: float = parameter(16.4, number(0.0, 25.5, "V"))
    charger: str = parameter(
        "none", text("none, dock or adapter", CHARGERS.__contains__), "what charges the battery"
    )
    drop: float = parameter(0.0, _SHARE, "share of the packets that are lost, in both directions")
    corrupt: float = parameter(
        0.0, _SHARE, "share of the packets with a wrong byte, in both directions"
    )
    stall: float = parameter(
        0.0,
        number(0.0, 9.0, "s"),
        f"the line stalls this long every {STALL_EVERY_S:g} s; then everything arrives at once",
    )
    other_firmware: str = parameter("", _VERSION, "version to report instead of 1.2.0")
    reboot_after: float = parameter(
        0.0, number(0.0, 1e6, "s, or 0: never"), "the robot is switched off and on again, once"
    )
    unplug_after: float = parameter(
        0.0, number(0.0, 1e6, "s, or 0: never"), "the cable is out for 2 s, once"
    )

    def simulation(self) -> SimulatorParameters:
        """Return the parameters of the simulated robot. Raises ValueError, one line."""
        given = {
            name: getattr(self, name)
            for name in declared(SimulatorParameters)
            if hasattr(self, name)
        }
        return SimulatorParameters(**given, cmd_vel_timeout=self.base_control_timeout)

    def equipment(self) -> Equipment:
        """Return the hardware of the Kobuki."""
        charger, battery = CHARGERS[self.charger], round(10 * self.battery)
        if not self.other_firmware:
            return Equipment(battery=battery, charger=charger)
        major, minor, patch = map(int, self.other_firmware.split("."))
        version = FirmwareVersion(patch, minor, major)
        return Equipment(firmware=version, battery=battery, charger=charger)

    def start_pose(self) -> Pose:
        """Return the start pose of the robot."""
        (pose,) = self.simulation().start_poses().values()
        return pose


def parse_parameters(given: Mapping[str, Any]) -> SerialKobukiParameters:
    """Return the checked parameters, with defaults filled in. Raises ValueError, one line."""
    parameters = SerialKobukiParameters(**checked(SerialKobukiParameters, given))
    parse_simulation({name: given[name] for name in declared(SimulatorParameters) if name in given})
    return parameters
