"""The entries of /diagnostics for a Kobuki, with the words of kobuki_node (diagnostics.cpp)."""

from __future__ import annotations

from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticStatus

from kobuki_protocol.battery import Battery, Level
from kobuki_protocol.feedback import Cliff, Feedback

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
CAPACITY_AH = 2.2  # of the small battery; the Kobuki does not report which it has
CHARGER_A = 3.14  # of the charger, about
STALLED = 6  # [10 mA] of a motor; more may mean a stall
YES_NO = ("NO", "YES")


class Entry(NamedTuple):
    """One task of diagnostic_updater."""

    name: str
    level: int
    text: str
    values: dict[str, object]


def entries(feedback: Feedback, battery: Battery, is_online: bool, has_power: bool) -> list[Entry]:
    """Return all entries, in kobuki_node's order."""
    core, current = feedback.core, feedback.current
    strongest = max(current.left, current.right)
    stalled = WARN, "Is robot stalled? Motors current is very high"
    motors = (OK, "Motors Enabled") if has_power else (WARN, "Motors Disabled")
    pins = ", ".join(str(feedback.inputs.digital >> bit & 1) for bit in (3, 2, 1, 0))
    return [
        _battery(battery),
        Entry("Watchdog", *((OK, "Alive") if is_online else (ERROR, "No Signal")), {}),
        _sides("Wall Sensor", core.bumper, "Wall Hit!", {"Left": 4, "Center": 2, "Right": 1}),
        _cliff(core.cliff, feedback.cliff),
        _sides("Wheel Drop", core.wheel_drop, "Wheel Drop!", {"Left": 2, "Right": 1}),
        Entry(
            "Motor Current",
            *(stalled if strongest > STALLED else (OK, "All right")),
            {"Left": current.left, "Right": current.right},
        ),
        Entry("Motor State", *motors, {"State": int(has_power)}),
        Entry("Gyro Sensor", OK, f"Heading: {0.01 * feedback.inertia.angle:.2f} degrees", {}),
        Entry("Digital Input", OK, f"[{pins}]", {}),
        Entry("Analog Input", OK, str(list(feedback.inputs.analog)), {}),
    ]


def _battery(battery: Battery) -> Entry:
    is_fed = battery.is_charging or battery.is_charged
    state = "Not Charging"
    if is_fed:
        state = "Trickle Charging" if battery.is_charged else "Full Charging"
    values: dict[str, object] = {
        "Voltage (V)": f"{battery.voltage:.1f}",
        "Percent": f"{battery.percent:.1f}",
        "Charge (Ah)": f"{0.01 * battery.percent * CAPACITY_AH:.2f}",
        "Capacity (Ah)": CAPACITY_AH,
        "Source": battery.source,
        "Charging State": state,
        "Current (A)": CHARGER_A if is_fed else 0.0,
    }
    is_well = battery.level in (Level.MAXIMUM, Level.HEALTHY)
    return Entry("Battery", OK if is_well else WARN, battery.level.value, values)


def _sides(name: str, bits: int, alarm: str, sides: dict[str, int]) -> Entry:
    values: dict[str, object] = {side: YES_NO[bool(bits & bit)] for side, bit in sides.items()}
    return Entry(name, *_state(bits, alarm), values)


def _cliff(bits: int, cliff: Cliff) -> Entry:
    readings = {"Left": (4, cliff.left), "Center": (2, cliff.center), "Right": (1, cliff.right)}
    values: dict[str, object] = {
        side: f"Reading: {reading}  Cliff: {YES_NO[bool(bits & bit)]}"
        for side, (bit, reading) in readings.items()
    }
    return Entry("Cliff Sensor", *_state(bits, "Cliff Detected!"), values)


def _state(bits: int, alarm: str) -> tuple[int, str]:
    return (WARN, alarm) if bits else (OK, "All right")
