"""The feedback of a simulated Kobuki's sensors, in the units of its protocol."""

from __future__ import annotations

from dataclasses import replace
from math import floor, tau
from typing import TYPE_CHECKING, Sequence

from kobuki_protocol.commands import bits_of
from kobuki_protocol.feedback import Cliff, Core, Current, Feedback, Inertia, RawGyro

if TYPE_CHECKING:
    from fake_turtlebot_sim.simulator.sensors import Sensed
    from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

BOTTOM = (1500, 0)  # of a cliff sensor above the floor and above a cliff, about
WRAP = 1 << 16  # counters have 16 bits
TICKS_PER_TURN = 52 * 6545 / 132  # encoder and gears: 2578.33 (kobuki_driver's appendix)
FULL_RATE = 0.7 / 0.035  # [rad/s] of a wheel at full voltage: 0.7 m/s (Kobuki's specifications)
FULL_CURRENT = 30  # [10 mA] of a motor at FULL_RATE, about
BATTERY = 164  # [0.1 V] of 4 lithium cells that are almost full


def touch_feedback(sensed: Sensed) -> Feedback:
    """Return the feedback of bumpers, cliff sensors and wheel drop switches."""
    right_to_left = [bits_of(reversed(flags)) for flags in (sensed.bumpers, sensed.wheels)]
    cliffs = sensed.cliffs[::-1]
    core = Core(bumper=right_to_left[0], wheel_drop=right_to_left[1], cliff=bits_of(cliffs))
    return Feedback(core=core, cliff=Cliff(*(BOTTOM[is_cliff] for is_cliff in cliffs)))


def sensors(now_ns: int, robot: SimulatedRobot, pressed: Sequence[bool]) -> Feedback:
    """Return the feedback of all sensors but the gyro; pressed: buttons 0 to 2."""
    state, touch = robot.state(), touch_feedback(robot.sensed())
    left, right = (floor(angle / tau * TICKS_PER_TURN) % WRAP for angle in robot.turned)
    rates = state.left_rate, state.right_rate
    pwm = [max(-100, min(100, round(100 * rate / FULL_RATE))) for rate in rates]
    core = replace(
        touch.core,
        time_stamp=now_ns // 1_000_000 % WRAP,
        left_encoder=left,
        right_encoder=right,
        left_pwm=pwm[0],
        right_pwm=pwm[1],
        buttons=bits_of(pressed),
        battery=BATTERY,
    )
    return touch.updated([core, Current(*(abs(share) * FULL_CURRENT // 100 for share in pwm))])


def with_gyro(sensed: Feedback, heading: float, rate: float, rates: Sequence[float]) -> Feedback:
    """Return the feedback with that of the gyro, which no reset of the odometry changes.

    heading [rad], rate [rad/s]: the gyro's. rates [rad/s]: its raw readings.
    """
    frame = sensed.core.time_stamp // 10  # a reading lasts 10 ms
    turning = [(0.0, 0.0, raw) for raw in rates]
    return sensed.updated([Inertia.of(heading, rate), RawGyro.of(frame, turning)])
