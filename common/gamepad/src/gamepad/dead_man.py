"""Whether a recording of a joystick presses the dead-man button, without which nothing moves."""

from pathlib import Path

import yaml

from gamepad.bags import opened
from gamepad.gamepads import F710

TOPIC = "/joy"
KEYS = ("enable_button", "enable_turbo_button")  # either of them drives


def check_recording(bag: str, preset: str) -> None:
    """Raise ValueError with one line if no Joy of the bag presses a dead-man button of the preset.

    Both are paths. A preset without a dead-man button drives by any recording.
    """
    parameters = yaml.safe_load(Path(preset).read_text(encoding="utf-8"))
    numbers = [parameters[key] for key in KEYS if parameters.get(key, -1) >= 0]
    with opened(bag) as recorded:
        for _, joy, _ in recorded.read_messages(TOPIC):
            if not numbers or any(any(joy.buttons[one : one + 1]) for one in numbers):
                return
    buttons = " or ".join(_name(number, Path(preset).stem) for number in numbers)
    raise ValueError(
        f"bag:={bag}: {buttons}, the dead-man button of {Path(preset).name}, is never pressed in"
        " it, so nothing would move: hold it while you record, or play this with launch_bag.launch"
    )


def _name(number: int, preset: str) -> str:
    if not preset.startswith("f710"):
        return f"button {number}"
    return f"{F710[preset[-1].upper()].buttons[number]} (button {number})"
