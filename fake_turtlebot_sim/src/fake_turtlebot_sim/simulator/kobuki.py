"""A Kobuki's messages: its core packet, in the units of its protocol, and its events (pure)."""

from __future__ import annotations

from math import floor, tau
from typing import TYPE_CHECKING, Sequence

from kobuki_msgs.msg import BumperEvent, CliffEvent, SensorState, WheelDropEvent

from fake_turtlebot_sim.kobuki_protocol import packets
from fake_turtlebot_sim.kobuki_protocol.packets import bits

if TYPE_CHECKING:  # the safety controller, too, needs EVENTS, and no simulation
    from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot

# Topic, message, and the field that says which sensor it was, in the order of sensors.Sensed.
EVENTS = (
    ("bumper", BumperEvent, "bumper"),
    ("cliff", CliffEvent, "sensor"),
    ("wheel_drop", WheelDropEvent, "wheel"),
)
QUEUE = 30  # events; none of them may be lost
BOTTOM = (1500, 0)  # a cliff sensor above ground and above none, about: the farther, the less
WRAP = 1 << 16  # counters have 16 bits
TICKS_PER_TURN = 52 * 6545 / 132  # encoder and gears: 2578.33 (kobuki_driver's appendix)
FULL_RATE = 0.7 / 0.035  # [rad/s] of a wheel at full voltage: 0.7 m/s (Kobuki's specifications)
FULL_CURRENT = 30  # [10 mA] of a motor at FULL_RATE, about
BATTERY = 164  # [0.1 V] of 4 lithium cells that are almost full


def core(now_ns: int, robot: SimulatedRobot, pressed: Sequence[bool]) -> SensorState:
    """Return the core packet without its header; pressed: buttons 0 to 2."""
    sensed, state = robot.sensed(), robot.state()
    left, right = (floor(angle / tau * TICKS_PER_TURN) % WRAP for angle in robot.turned)
    rates = state.left_rate, state.right_rate
    pwm = [max(-100, min(100, round(100 * rate / FULL_RATE))) for rate in rates]
    return SensorState(
        time_stamp=now_ns // 1_000_000 % WRAP,
        bumper=bits(reversed(sensed.bumpers)),  # right, center, left, as the next
        wheel_drop=bits(reversed(sensed.wheels)),
        cliff=bits(reversed(sensed.cliffs)),
        left_encoder=left,
        right_encoder=right,
        left_pwm=pwm[0],
        right_pwm=pwm[1],
        buttons=bits(pressed),
        battery=BATTERY,
        bottom=[BOTTOM[is_cliff] for is_cliff in reversed(sensed.cliffs)],
        current=[abs(share) * FULL_CURRENT // 100 for share in pwm],
        analog_input=[0] * 4,
    )


def stream(state: SensorState, heading: float, rate: float, rates: Sequence[float]) -> bytes:
    """Return the packet that a Kobuki would send now.

    heading [rad], rate [rad/s]: of the gyro, which no reset changes. rates: of its raw readings.
    """
    frame = state.time_stamp // 10  # a reading is 10 ms
    return packets.packet(
        packets.core(state),
        packets.dock_ir(0, 0, 0),
        packets.inertia(heading, rate),
        packets.cliff(state.bottom),
        packets.current(state.current),
        packets.raw_gyro(frame, [(0.0, 0.0, raw) for raw in rates]),
        packets.inputs(state.digital_input, state.analog_input),
    )
