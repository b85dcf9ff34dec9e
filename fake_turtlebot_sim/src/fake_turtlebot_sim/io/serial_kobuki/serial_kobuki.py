"""A simulated Kobuki on a serial line, in real time."""

from __future__ import annotations

import select
import time
from functools import partial
from typing import Callable

from fake_turtlebot_sim.io.serial_kobuki.observer_process import ObserverProcess
from fake_turtlebot_sim.io.serial_kobuki.serial_line import SerialLine
from fake_turtlebot_sim.serial_kobuki.damage import Damage
from fake_turtlebot_sim.serial_kobuki.firmware import DOCK_CHARGING, Firmware
from fake_turtlebot_sim.serial_kobuki.parameters import SerialKobukiParameters
from fake_turtlebot_sim.simulator.clock import PhaseLock
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

HINT = "to drive it: roslaunch turtlebot_bringup minimal.launch serialport:="
PERIOD_NS = 20_000_000
SUSPENDED_NS = 500_000_000  # longer than a busy machine delays a process
UNPLUGGED_S = 2.0  # with ~unplug_after


class Clock:
    """The time since the start, and whether this process was suspended."""

    def __init__(self) -> None:
        self._begin_ns = self._looked_ns = time.monotonic_ns()

    def now_ns(self) -> int:
        """Return the time [ns]."""
        return time.monotonic_ns() - self._begin_ns

    def was_suspended(self) -> bool:
        """Return whether the process was suspended since the last call; call it in each cycle."""
        before, self._looked_ns = self._looked_ns, time.monotonic_ns()
        return self._looked_ns - before > SUSPENDED_NS


class SerialKobuki:
    """The firmware and its robot, the serial line, and the observer."""

    def __init__(
        self,
        parameters: SerialKobukiParameters,
        observer: ObserverProcess | None,
        report: Callable[[str], None],
    ) -> None:
        """Plug the robot in. observer: connects it to ROS. Raises ValueError, one line."""
        p = self._parameters = parameters
        self._report, self._observer = report, observer
        robot = self._robot = SimulatedRobot(p.simulation(), p.start_pose())
        self._firmware = Firmware(robot, p.equipment())
        self._damage = Damage(p.drop, p.corrupt, p.stall, p.seed)
        self._reported: set[str] = set()  # lines that are reported once
        self._plan: list[tuple[float, Callable[[], None]]] = []  # when [s], and what happens
        if p.reboot_after:
            self._plan.append((p.reboot_after, self._reboot))
        if p.unplug_after:
            self._plan.append((p.unplug_after, partial(self._plug_in, False)))
            self._plan.append((p.unplug_after + UNPLUGGED_S, partial(self._plug_in, True)))
        self._requests: dict[str, Callable[..., None]] = {
            "press": self._firmware.press,
            "reset": self._robot.reset,
            "reboot": self._reboot,
            "switch_on": self._switch_on,
            "plug_in": self._plug_in,
            "charge": self._charge,
            "send_garbage": self._damage.switch_noise,
        }
        self._line: SerialLine | None = None
        self._clock = Clock()
        self._plug_in(True)
        self.is_ending = False

    def spin(self) -> None:
        """Simulate the robot until is_ending."""
        schedule = PhaseLock(PERIOD_NS, self._clock.now_ns())
        while not self.is_ending:
            now_ns = self._clock.now_ns()
            if now_ns >= schedule.deadline_ns:
                self._cycle(now_ns)
                schedule.complete(now_ns)
            self._wait((schedule.deadline_ns - self._clock.now_ns()) * 1e-9)

    def close(self) -> None:
        """Unplug the robot for good."""
        if self._line:
            self._line.unplug()
        if self._observer:
            self._observer.close()

    def _cycle(self, now_ns: int) -> None:
        """Move to the present, send a packet, and show the observer the pose."""
        now_s = now_ns * 1e-9
        for at_s, happen in self._plan:
            if at_s <= now_s:
                self._try(happen)
        self._plan = [(at_s, happen) for at_s, happen in self._plan if at_s > now_s]
        self._read()
        stamp_ns = time.time_ns()
        if self._robot.advance(now_ns):
            timeout_s = self._parameters.base_control_timeout
            self._report(f"no base control for {timeout_s:g} s: the wheels stop")
        packet = self._firmware.feedback(now_ns)
        if self._line:
            self._line.write(self._damage.delay(self._damage.spoil(packet), now_s))
        self._report_fall()
        if self._observer:
            truth = self._robot.true_state()
            self._observer.show({"stamp_ns": stamp_ns, "truth": truth[:5]})

    def _report_fall(self) -> None:
        if any(self._robot.sensed().wheels):
            x, y, _ = self._robot.true_pose
            what = f"fell over an edge at ({x:.2f}, {y:.2f}): lift it with the service reset"
            self._report_once(what)

    def _report_once(self, line: str) -> None:
        if line not in self._reported:
            self._reported.add(line)
            self._report(line)

    def _wait(self, longest_s: float) -> None:
        """Wait for a command or a request, at most longest_s [s], and obey it."""
        sources = [self._line.descriptor] if self._line and self._line.is_open else []
        sources += [self._observer.descriptor] if self._observer else []
        ready, _, _ = select.select(sources, [], [], max(0.0, longest_s))
        if self._line and self._line.descriptor in ready:
            self._read()
        if self._observer and self._observer.descriptor in ready:
            self._obey(self._observer)

    def _read(self) -> None:
        """Obey the commands of the driver."""
        if not self._line:
            return
        if self._clock.was_suspended():
            self._line.drain()
        data = self._damage.spoil(self._line.read())
        for line in self._firmware.receive(data, self._clock.now_ns()):
            self._report(line)
        if self._firmware.damaged:
            self._report_once("damaged commands arrive; they are ignored")

    def _obey(self, observer: ObserverProcess) -> None:
        for name, *values in observer.requests():
            self._robot.advance(self._clock.now_ns())
            self._try(self._requests[name], *values)
        if observer.has_ended:
            self.is_ending = self.is_ending or observer.was_asked_to_end
            self._observer = None

    def _try(self, happen: Callable[..., None], *values: object) -> None:
        """Do what a request asks for, or report why it is impossible."""
        try:
            happen(*values)
        except ValueError as error:
            self._report(str(error))

    def _reboot(self) -> None:
        self._report("switched off and on")
        self._firmware.switch(True, self._clock.now_ns())

    def _switch_on(self, is_on: bool) -> None:
        self._report(f"switched {'on' if is_on else 'off'}")
        self._firmware.switch(is_on, self._clock.now_ns())

    def _charge(self, is_charging: bool) -> None:
        self._firmware.charger = DOCK_CHARGING if is_charging else 0

    def _plug_in(self, is_in: bool) -> None:
        if is_in and not self._line:
            self._line = SerialLine(self._parameters.link)
            self._report(f"plugged in at {self._line.path}; {HINT}{self._line.port}")
        elif self._line and not is_in:
            self._line.unplug()
            self._line = None
            self._report("the cable is out")
