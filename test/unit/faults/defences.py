"""What keeps a robot from moving when it must not, and how it is taken away: one row each.

A row: what the defence does, where it is, what stands there instead, the exploration that must miss
it. A defence is a method or a function, so that no edit of its lines changes a row.
"""

import math

from fake_turtlebot_sim.mux import arbitration
from fake_turtlebot_sim.mux.arbitration import IDLE, Arbiter, Sender, Verdict
from gamepad.driver import driver
from gamepad.driver.driver import Driver
from gamepad.driver.schedule import Schedule
from gamepad.js_event import Decoder
from joy_to_twist import mapping, safety
from joy_to_twist.mapping import Mapping
from joy_to_twist.safety import Safety
from joy_to_twist.teleoperation import Teleoperation
from node_kit.arming import Arming, Resumption

PLAIN, ARMING, FREE = "dead-man", "dead-man, arming", "no dead-man"
STOP, STOP_ARMING, VIGILANCE, RAMP = (
    "stop button", "stop button, arming", "vigilance, arming", "ramp, arming",
)  # fmt: skip
MUX, PAD = "a stick and a program", "driver"

joy, velocity, latch = Teleoperation.joy, Mapping.velocity, Safety.latch
command, lost, init = Arbiter.command, Driver.lost, Decoder.__init__


def nothing(*_, **__):
    """Do nothing, and send nothing."""


def no(*_, **__):
    return False


def yes(*_, **__):
    return True


def obeyed(self, velocity, now):
    self.heard_s, self.moves = now, any(velocity)
    return Verdict.OBEYED


def unwoken(self, next_output):
    self._next_output = next_output


def never_repeated(self, next_output):
    self._next_output = math.inf
    self._wake()


def armed_by_the_stop_button(self, now):
    answer = latch(self, now)
    self.arming.armed = True
    return answer


def lowest_first(self, now):
    speaking = [name for name in self._inputs if now < self._expiry_s[name]]
    return speaking[-1] if speaking else IDLE


def mute_no_longer(self, now):
    messages = lost(self, now)
    self._mute = False
    return messages


def made_up(self, now):
    self._told = True
    return lost(self, now)


def from_the_last_change(self, now):
    self.due = now + self._interval


DEFENCES = [
    ("time is watched", Safety, "tick", nothing, PLAIN),
    ("a loss stops", Safety, "lost", nothing, PLAIN),
    ("a released dead-man button stops", Safety, "_stop", nothing, PLAIN),
    ("a bad message stops", Safety, "reject", nothing, FREE),
    ("a stop is repeated", Safety, "_schedule", never_repeated, PLAIN),
    ("the node is woken for what is due", Safety, "_schedule", unwoken, PLAIN),
    ("a lost robot is reported rightly", Safety, "released", property(yes), ARMING),
    ("speed grows step by step", safety, "approach", lambda sent, target, *_: target, RAMP),
    ("the stop button stops", Safety, "latch", nothing, STOP),
    ("and is seen in a bad message", Teleoperation, "joy",
     lambda self, axes, *more: joy(self, axes, *more) if len(axes) > 1 else None, STOP),
    ("after it all must be released", Safety, "latch", armed_by_the_stop_button, STOP_ARMING),
    ("the stop button is in the message", Mapping, "stops", no, STOP),
    ("only the reset button resets", Mapping, "resets", yes, STOP),
    ("what is not armed is refused", Arming, "hear", yes, ARMING),
    ("a loss disarms", Arming, "lose", nothing, ARMING),
    ("all must be released", Mapping, "rests", yes, ARMING),
    ("the sticks must be released", Mapping, "rests",
     lambda self, axes, velocity: velocity is None or self._free, ARMING),
    ("no velocity without the dead-man button", Mapping, "velocity",
     lambda self, axes, buttons: velocity(self, axes, (1, *buttons[1:])), PLAIN),
    ("an infinite axis is refused", mapping, "LARGEST_AXIS_VALUE", math.inf, PLAIN),
    ("speed is limited", mapping, "limit_speed", lambda wanted, *_: wanted, PLAIN),
    ("an old message is refused", Teleoperation, "joy",
     lambda self, axes, buttons, now, age, sender: joy(self, axes, buttons, now, 0, sender), PLAIN),
    ("another sender disarms", Teleoperation, "joy",
     lambda self, axes, buttons, now, age, sender: joy(self, axes, buttons, now, age), ARMING),
    ("only a change is a sign of life", Teleoperation, "_has_changed", yes, VIGILANCE),
    ("a change is noticed", Teleoperation, "_has_changed", no, VIGILANCE),
    ("a suspension stops", Teleoperation, "suspended", nothing, PLAIN),
    ("a joystick node that leaves stops", Teleoperation, "left", nothing, PLAIN),
    ("messages of a suspension are old", Resumption, "is_old", no, PLAIN),
    ("a command must be finite", arbitration, "isfinite", yes, MUX),
    ("a command after a silence waits", Sender, "judge", obeyed, MUX),
    ("what waits for no other goes through", Arbiter, "waited", lambda self, now: (), MUX),
    ("what comes at once is late", arbitration, "TOGETHER_S", 0.0, MUX),
    ("and all that comes with it", arbitration, "SETTLING_S", 0.0, MUX),
    ("a stick rests first", Arbiter, "command",
     lambda self, name, velocity, now, sender: command(self, name, velocity, now), MUX),
    ("the highest drives", Arbiter, "active", lowest_first, MUX),
    ("silence of all inputs stops", Arbiter, "must_stop", no, MUX),
    ("the silence is noticed in time", Arbiter, "lull", lambda self, now: 9.0, MUX),
    ("a new gamepad is mute", Driver, "lost", mute_no_longer, PAD),
    ("a loss is published as released", Driver, "lost",
     lambda self, now: lost(self, now)[:0], PAD),
    ("and only of a gamepad that was published", Driver, "lost", made_up, PAD),
    ("a loss is silent for long enough", driver, "SHORTEST_SILENCE_S", 0.0, PAD),
    ("a missing sign of life is noticed", driver, "LONGEST_LIFELESS_S", math.inf, PAD),
    ("a quick press is published", Driver, "tick",
     lambda self, now: [], PAD),
    ("what the kernel repeats is a change", Decoder, "__init__",
     lambda self, late_init_is_change: init(self, False), PAD),
    ("a held stick is repeated", Schedule, "published",
     lambda self, now: setattr(self, "due", math.inf), PAD),
    ("a stick that never rests is published", Schedule, "soon", from_the_last_change, PAD),
]  # fmt: skip
