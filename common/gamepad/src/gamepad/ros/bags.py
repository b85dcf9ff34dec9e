"""Reads recordings, and checks whether they press the dead-man button."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

import rosbag
import yaml

from gamepad.errors import BagError
from gamepad.gamepads import F710

TOPIC, JOY = "/joy", "sensor_msgs/Joy"
KEYS = ("enable_button", "enable_turbo_button")  # holding either of them drives


@contextmanager
def opened(path: str | Path) -> Iterator[rosbag.Bag]:
    """Open a bag. Raises BagError, also for errors while it is read."""
    try:
        if Path(path).is_fifo() or Path(path).is_char_device():  # reading may block forever
            raise BagError(f"{path}: not a plain file")
        with rosbag.Bag(str(path)) as bag:
            yield bag
    except BagError:
        raise
    except OSError as error:
        raise BagError(f"{path}: cannot be read: {error.strerror or error}") from None
    except rosbag.ROSBagUnindexedException:
        raise BagError(f"{path}: cut short; fix it with: rosbag reindex {path}") from None
    except Exception as error:  # rosbag lets struct.error and more through from a damaged file
        why = " ".join(str(error).split()) or type(error).__name__
        raise BagError(f"{path}: not a bag that can be read: {why:.200}") from None


def check_topic(path: str) -> None:
    """Raise BagError, with what to do, if a bag has no joystick message on /joy."""
    with opened(path) as bag:
        topics = bag.get_type_and_topic_info().topics
    kinds = {topic: about.msg_type for topic, about in topics.items() if about.message_count}
    if kinds.get(TOPIC) == JOY:
        return
    joysticks = [topic for topic, kind in sorted(kinds.items()) if kind == JOY]
    if joysticks:
        todo = f"its joystick is on {joysticks[0]}: rosbag play {path} {joysticks[0]}:={TOPIC}"
    else:
        others = ", ".join(sorted(kinds)) or "nothing"
        todo = f"it has {others}; record one with: rosbag record {TOPIC}"
    raise BagError(f"{path}: no {JOY} on {TOPIC}, so nothing would move; {todo}")


def check_recording(bag: str, preset: str) -> None:
    """Raise ValueError, one line, if no Joy in the bag presses a dead-man button of the preset.

    bag, preset: paths. Without a dead-man button in the preset, any recording drives.
    """
    parameters = yaml.safe_load(Path(preset).read_text(encoding="utf-8"))
    numbers = [parameters[key] for key in KEYS if parameters.get(key, -1) >= 0]
    with opened(bag) as recorded:
        for _, joy, _ in recorded.read_messages(TOPIC):
            if not numbers or any(any(joy.buttons[n : n + 1]) for n in numbers):
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
