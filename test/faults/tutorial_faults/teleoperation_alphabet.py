"""The parameters, messages and events of the exploration of the teleoperation."""

import math
from typing import NamedTuple

from tutorial_faults.explore import PASS, SUSPENDED, TICK

OLD_S = 0.4  # more than max_joy_age
BASE = {
    "enable_button": 0, "enable_turbo_button": 1, "scale_linear": 0.5, "joy_timeout": 0.5,
    "output_rate": 4.0, "stop_messages": 2, "max_linear_speed": 0.75, "max_angular_speed": 1.0,
    "max_joy_age": 0.3,
}  # fmt: skip
ARMING = {**BASE, "arm_on_neutral": True}
NO_DEAD_MAN = {"enable_button": -1, "enable_turbo_button": -1}
TURBO_ALONE = {"enable_button": -1, "enable_turbo_button": 0, "require_enable_button": True}
STOP_BUTTON = {"stop_button": 2, "stop_reset_button": 3}
RAMP = {"max_linear_acceleration": 1.0, "max_angular_acceleration": 2.0}
# What decides which way a message takes.
CONFIGURATIONS = {
    "dead-man": BASE,
    "dead-man, arming": ARMING,
    "no dead-man": {**BASE, **NO_DEAD_MAN},
    "no dead-man, arming": {**ARMING, **NO_DEAD_MAN},
    "no turbo": {**BASE, "enable_turbo_button": -1},
    "turbo alone, arming": {**ARMING, **TURBO_ALONE},
    "no timeout, arming": {**ARMING, "joy_timeout": 0},
    "vigilance, arming": {**ARMING, "vigilance_timeout": 1.0},
    "vigilance, no dead-man": {**ARMING, **NO_DEAD_MAN, "vigilance_timeout": 1.0},
    "stop button": {**BASE, **NO_DEAD_MAN, **STOP_BUTTON},
    "stop button, arming": {**ARMING, **STOP_BUTTON},
    "ramp, arming": {**ARMING, **RAMP},
    "ramp, no dead-man": {**BASE, **NO_DEAD_MAN, **RAMP},
}


class Message(NamedTuple):
    """A message of a joystick node."""

    sender: str
    axes: tuple
    buttons: tuple
    age_s: float = 0.0


STICK, BACK, WORN = (0.0, 1.0), (0.5, -1.0), (0.05, 0.0)
TREMBLING = (0.0, 1.0 - 2.0**-15)  # by one step of 65,536
MESSAGES = {
    "neutral": Message("ada", (0.0, 0.0), (0, 0)),
    "LB": Message("ada", (0.0, 0.0), (1, 0)),
    "stick": Message("ada", STICK, (0, 0)),
    "LB and stick": Message("ada", STICK, (1, 0)),
    "LB and stick back": Message("ada", BACK, (1, 0)),
    "turbo and stick": Message("ada", STICK, (0, 1)),
    "LB and NaN": Message("ada", (0.0, math.nan), (1, 0)),
    "LB and infinity": Message("ada", (math.inf, 0.0), (1, 0)),
    "too few axes": Message("ada", (0.0,), (1, 0)),
    "too few buttons": Message("ada", STICK, ()),
    "LB and stick, old": Message("ada", STICK, (1, 0), OLD_S),
    "another's neutral, worn": Message("bob", WORN, (0, 0)),
    "another's LB": Message("bob", (0.0, 0.0), (1, 0)),
    "another's LB and stick": Message("bob", STICK, (1, 0)),
}
TREMBLES = {"LB and stick, trembling": Message("ada", TREMBLING, (1, 0))}
STOPS = {
    "stop": Message("ada", (0.0, 0.0), (0, 0, 1, 0)),
    "stop in a bad message": Message("ada", (math.nan,), (1, 0, 1)),
    "reset": Message("ada", (0.0, 0.0), (0, 0, 0, 1)),
    "reset with LB and stick": Message("ada", STICK, (1, 0, 0, 1)),
    "stop and reset": Message("ada", (0.0, 0.0), (0, 0, 1, 1)),
}
LEFT = "left"
EVENTS = {**{name: name for name in (PASS, TICK, LEFT, SUSPENDED)}, **MESSAGES}
# A ramp multiplies the states; what is no velocity takes the same way as without one.
WITHOUT_RAMP = (
    "stick", "turbo and stick", "LB and infinity", "too few axes", "too few buttons",
    "LB and stick, old", "another's neutral, worn", "another's LB",
)  # fmt: skip
# So does one more clock. The stateful machines add suspensions to it.
VIGILANT = (PASS, TICK, LEFT, "neutral", "LB and stick", "LB and NaN", "another's neutral, worn")


def events_of(name):
    """Return the events for one of the CONFIGURATIONS."""
    if name.startswith("vigilance"):
        return {**{event: EVENTS[event] for event in VIGILANT}, **TREMBLES}
    if name.startswith("ramp"):
        return {event: EVENTS[event] for event in EVENTS if event not in WITHOUT_RAMP}
    if not name.startswith("stop button"):
        return EVENTS
    padded = {
        event: what._replace(buttons=(*what.buttons, 0, 0)) for event, what in MESSAGES.items()
    }
    return {**EVENTS, **padded, **STOPS}
