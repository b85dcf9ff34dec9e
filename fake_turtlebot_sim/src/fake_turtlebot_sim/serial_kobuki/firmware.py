"""A Kobuki's firmware: takes the driver's bytes and returns packets of sensor values.

Times are whole numbers of nanoseconds that never decrease, as for the simulated robot, which has
the wheels. The facts are those of kobuki_driver's appendix "Protocol Specification"; a comment
marks what is assumed because no source states it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from fake_turtlebot_sim.serial_kobuki.outputs import changes
from fake_turtlebot_sim.simulator.differential_drive import wrap_angle
from fake_turtlebot_sim.simulator.kobuki_feedback import BATTERY, WRAP, sensors, with_gyro
from fake_turtlebot_sim.simulator.simulated_robot import REST, SimulatedRobot
from kobuki_protocol import commands, identity
from kobuki_protocol.base_control import velocity_of
from kobuki_protocol.commands import MELODIES
from kobuki_protocol.feedback import Feedback
from kobuki_protocol.framing import Framer
from kobuki_protocol.robot_packets import RobotPart, build

BOOT_NS = 2_000_000_000  # from power-on to the first packet: assumed
HARDWARE = identity.HardwareVersion(patch=4, minor=0, major=1)
FIRMWARE = identity.FirmwareVersion(patch=0, minor=2, major=1)
UNIQUE_ID = identity.UniqueId((1, 2, 3))
BUTTONS = 3
DOCK_CHARGING = 6  # charger in the core packet
GAINS_FROM = (1, 2, 0)  # the first firmware that accepts gains


@dataclass(frozen=True)
class Equipment:
    """The hardware: versions, unique id, battery [0.1 V] and charger."""

    hardware: identity.HardwareVersion = HARDWARE
    firmware: identity.FirmwareVersion = FIRMWARE
    unique_id: identity.UniqueId = UNIQUE_ID
    battery: int = BATTERY
    charger: int = 0


@dataclass(frozen=True)
class Zeros:
    """The values at switch-on, from which a Kobuki counts."""

    now_ns: int
    left: int  # [ticks]
    right: int
    yaw: float  # [rad]


class Firmware:
    """The firmware's state; the robot obeys the newest command until its own timeout."""

    def __init__(self, robot: SimulatedRobot, equipment: Equipment = Equipment()) -> None:
        """Start switched on, at the time 0."""
        self.robot, self._equipment = robot, equipment
        self.charger = equipment.charger
        self._pressed = [False] * BUTTONS
        self._is_on, self._rate_before = True, 0.0
        self._boot(0)

    def _boot(self, now_ns: int) -> None:
        self._ready_ns = now_ns
        self._framer = Framer()
        core = sensors(now_ns, self.robot, self._pressed).core
        yaw = self.robot.true_pose[2]
        self._zeros = Zeros(now_ns, core.left_encoder, core.right_encoder, yaw)
        self._outputs = commands.Outputs()  # assumed: those that the driver starts with
        self._controller = identity.Controller()
        self._answers: list[RobotPart] = []

    def switch(self, is_on: bool, now_ns: int) -> None:
        """Switch the robot on or off: its wheels stop, and it forgets all settings."""
        self.robot.command(REST, now_ns)
        self._is_on = is_on
        self._boot(now_ns + BOOT_NS)

    def runs(self, now_ns: int) -> bool:
        """Return whether the robot is switched on and has booted."""
        return self._is_on and now_ns >= self._ready_ns

    def press(self, button: int, is_pressed: bool) -> None:
        """Press or release a button, 0 to 2; other numbers have no effect."""
        if 0 <= button < BUTTONS:
            self._pressed[button] = is_pressed

    @property
    def damaged(self) -> int:
        """Return how many damaged packets have arrived since the robot was switched on."""
        return self._framer.damaged

    def receive(self, data: bytes, now_ns: int) -> list[str]:
        """Obey the commands that these bytes complete; return lines about what has changed."""
        if not self.runs(now_ns):
            return []
        received = map(commands.parse, self._framer.feed(data))
        return [line for group in received for part in group for line in self._obey(part, now_ns)]

    def _obey(self, command: commands.Command, now_ns: int) -> list[str]:
        if isinstance(command, commands.BaseControl):
            self.robot.command(velocity_of(command), now_ns)
        elif isinstance(command, commands.Outputs):
            before, self._outputs = self._outputs, command
            return changes(before, command)
        elif isinstance(command, commands.IdentityRequest):
            self._answers += self._identity(command.flags)
        elif isinstance(command, commands.GetController):
            self._answers.append(self._controller)
        elif isinstance(command, commands.SetController):
            return self._set_controller(command.wanted)
        elif isinstance(command, commands.SoundSequence):
            is_known = command.number < len(MELODIES)
            return [f"sound: {MELODIES[command.number] if is_known else command.number}"]
        else:
            return [f"sound: note {command.note} for {command.duration} ms"]
        return []

    def _identity(self, flags: int) -> list[RobotPart]:
        parts: list[tuple[int, RobotPart]] = [
            (commands.IdentityRequest.HARDWARE, self._equipment.hardware),
            (commands.IdentityRequest.FIRMWARE, self._equipment.firmware),
            (commands.IdentityRequest.UNIQUE_ID, self._equipment.unique_id),
        ]
        return [part for flag, part in parts if flags & flag]

    def _set_controller(self, wanted: identity.Controller) -> list[str]:
        version = self._equipment.firmware
        if (version.major, version.minor, version.patch) < GAINS_FROM:
            return [f"gains: firmware {version} does not accept any"]
        self._controller = wanted
        p, i, d = (gain / 1000.0 for gain in wanted.gains)
        return [f"gains: {'own' if wanted.kind else 'factory'}, P {p:g}, I {i:g}, D {d:g}"]

    def feedback(self, now_ns: int) -> bytes:
        """Return the packet of the sensors and answers; empty while the robot is off."""
        if not self.runs(now_ns):
            return b""
        self.robot.advance(now_ns)
        answers, self._answers = self._answers, []
        return build(*self._sensors(now_ns).parts(), *answers)

    def _sensors(self, now_ns: int) -> Feedback:
        zeros, time_ns = self._zeros, now_ns - self._zeros.now_ns
        sensed = sensors(time_ns, self.robot, self._pressed)
        core = replace(
            sensed.core,
            left_encoder=(sensed.core.left_encoder - zeros.left) % WRAP,
            right_encoder=(sensed.core.right_encoder - zeros.right) % WRAP,
            charger=self.charger,
            battery=self._equipment.battery,
        )
        rate, before = self.robot.true_state().w, self._rate_before
        self._rate_before = rate
        heading = wrap_angle(self.robot.true_pose[2] - zeros.yaw)
        return with_gyro(sensed.updated([core]), heading, rate, (0.5 * (before + rate), rate))
