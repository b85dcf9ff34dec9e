"""The states and warnings that joy2twist reports, and their sentences."""

from __future__ import annotations

from enum import Enum

from joy_to_twist.parameters import Parameters
from node_kit.rules import arming

WARNS_BEFORE_S = 0.5  # before it stops because of a joystick that does not change
NO_CHANGE = f"the joystick does not change: the robot stops in {WARNS_BEFORE_S:g} s"


class State(Enum):
    """On /diagnostics. A value is the sentence; in braces a parameter p of the node."""

    WAITING = "waiting for the joystick"
    ARMED = "armed: hold the dead-man button to drive"
    DRIVING = arming.DRIVING
    STILL_SOON = f"{arming.DRIVING}: {NO_CHANGE}; move a stick"
    NOT_ARMED = "stopped: not armed, release the sticks and the dead-man button once"
    BAD_MESSAGE = "stopped: bad joystick message"
    BUTTON = (
        "stopped: the stop button was pressed; to go on, press button {p.stop_reset_button}, "
        "then let go"
    )
    SILENT = "stopped: no message for {p.joy_timeout:g} s"
    STILL = (
        "stopped: the joystick has not changed for {p.vigilance_timeout:g} s, it may be out of "
        "range; to go on, release the sticks and the dead-man button once"
    )
    ANOTHER = (
        "stopped: another joystick node sends; its sticks and dead-man button were not released yet"
    )
    LEFT = "stopped: the joystick node has left"
    SUSPENDED = "stopped: this node was suspended"


def _line(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


class Notice(Enum):
    """A warning of the safety rules. A value is the line of the log."""

    BUTTON = _line(State.BUTTON.value)
    STILL = _line(State.STILL.value)
    SILENT = (
        f"{_line(State.SILENT.value)} For a joystick without autorepeat, or a recording of "
        "one, set ~joy_timeout to 0."
    )
    LEFT = _line(State.LEFT.value)
    NOT_ARMED = _line(State.NOT_ARMED.value)
    STILL_SOON = f"{_line(NO_CHANGE)} Move a stick, or come back into range."
    IN_TURN = "Two joystick nodes send in turn: the robot stands until one has ended."


def sentence(about: State | Notice, parameters: Parameters) -> str:
    """Return the sentence that a user reads."""
    return about.value.format(p=parameters)
