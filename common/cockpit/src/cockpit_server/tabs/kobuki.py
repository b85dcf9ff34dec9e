"""What pages show of a Kobuki's core sensors, real or simulated."""

from __future__ import annotations

from kobuki_msgs.msg import SensorState

CHARGERS = {
    SensorState.DISCHARGING: "none",
    SensorState.DOCKING_CHARGED: "dock, charged",
    SensorState.DOCKING_CHARGING: "dock, charging",
    SensorState.ADAPTER_CHARGED: "adapter, charged",
    SensorState.ADAPTER_CHARGING: "adapter, charging",
}
BUTTONS = ((SensorState.BUTTON0, "0"), (SensorState.BUTTON1, "1"), (SensorState.BUTTON2, "2"))
WHEELS = ((SensorState.WHEEL_DROP_LEFT, "left"), (SensorState.WHEEL_DROP_RIGHT, "right"))


def core_shown(core: SensorState) -> dict[str, str]:
    """Return battery, charger, pressed buttons and dropped wheels as text."""
    return {
        "battery": f"{core.battery / 10:.1f}",
        "charger": CHARGERS.get(core.charger, f"unknown ({core.charger})"),
        "buttons": _set(core.buttons, BUTTONS),
        "wheel_drops": _set(core.wheel_drop, WHEELS),
    }


def _set(bits: int, names: tuple[tuple[int, str], ...]) -> str:
    return ", ".join(name for bit, name in names if bits & bit) or "none"
