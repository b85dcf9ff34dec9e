"""The rules of joy2twist and mux under any events at any time, judged by the invariants.

A seed is a series of 40 steps, the same in every run.
"""

import math
import random

import pytest

from fake_turtlebot_sim.mux.arbitration import Publisher
from fake_turtlebot_sim.mux.parameters import Input
from tutorial_faults.arbiter_world import ZERO, ArbiterWorld, Command
from tutorial_faults.teleoperation_world import LEFT, Message, TeleoperationWorld
from tutorial_faults.worlds import SUSPENDED, TICK

SERIES, STEPS = range(400), 40
# Each threshold of the rules, and just before it; else any time, mostly short.
THRESHOLDS_S = (0.02, 0.05, 0.1, 0.15, 0.25, 0.3, 0.45, 0.5, 0.6, 1.0)
PAUSES_S = (0.001, *THRESHOLDS_S, *(one - 1e-6 for one in THRESHOLDS_S))
NUMBERS = (0.0, -0.0, 1.0, -2.0, 7e-30, 1e6, -1e7, 3e38, math.inf, -math.inf, math.nan)

# What decides which way a message takes; with all of it a held stick drives.
BASE = {
    "enable_button": 0, "enable_turbo_button": 1, "scale_linear": 0.5, "joy_timeout": 0.5,
    "output_rate": 4.0, "stop_messages": 2, "max_linear_speed": 0.75, "max_angular_speed": 1.0,
    "max_joy_age": 0.3,
}  # fmt: skip
STOPS = {"stop_button": 2, "stop_reset_button": 3}
CHANGES = [
    {}, {"enable_button": -1, "enable_turbo_button": -1}, {"enable_turbo_button": -1},
    {"enable_button": -1, "enable_turbo_button": 0, "require_enable_button": True},
    {"joy_timeout": 0}, STOPS,
    {"max_linear_acceleration": 1.0, "max_angular_acceleration": 2.0},
]  # fmt: skip
ARMING = [{}, *({"arm_on_neutral": True, "vigilance_timeout": s} for s in (0, 0, 1.0, 2.0))]
BUTTONS = [
    {"enable_button": enable, "enable_turbo_button": turbo, "require_enable_button": is_needed}
    for enable, turbo in ((-1, -1), (0, -1), (0, 1), (1, 0), (-1, 0))
    for is_needed in (False, max(enable, turbo) >= 0)
]
SCALES = ("scale_linear", "scale_angular", "scale_linear_turbo")
LIMITS = ("max_linear_speed", "max_angular_speed", "max_linear_acceleration",
          "max_angular_acceleration")  # fmt: skip


class Draw(random.Random):
    """What happens, by chance."""

    def seconds(self):
        return self.choice((self.choice(PAUSES_S), self.uniform(0, 1.5)))

    def several(self, values, least, most):
        return tuple(self.choices(values, k=self.randint(least, most)))

    def parameters(self):
        """Return private parameters of joy2twist that fit together."""
        if self.random() < 0.5:
            return {**BASE, **self.choice(CHANGES), **self.choice(ARMING)}
        return {
            "axis_curve": self.choice([1, 1, 2]),
            "inverted_reverse": self.choice([False, True]),
            "joy_timeout": self.choice([0, 0.02, 0.5, 3.0]),
            "max_joy_age": self.choice([0, 0.3]),
            "stop_messages": self.randint(1, 7),
            "output_rate": 10 ** self.uniform(0, 3),
            **{name: self.choice((1, -1)) * 10 ** self.uniform(-2, 2) for name in SCALES},
            **{name: self.choice((0, 10 ** self.uniform(-2, 3))) for name in LIMITS},
            **self.choice(BUTTONS), **self.choice([{}, STOPS]), **self.choice(ARMING),
        }  # fmt: skip


def time_passes(draw, world):
    world.take(draw.seconds())


def node_looks(draw, world):
    world.take(draw.seconds())
    world.take(TICK)


def joy(draw, world):
    any_axes = [n / 64 for n in range(-64, 65)]
    axes = draw.choice([(0.0, 1.0), (0.5, -1.0), (0.0, 0.0), *[draw.several(any_axes, 2, 4)] * 2])
    buttons = draw.choice([(1, 0, 0, 0), (0, 1, 0, 0), draw.several([0, 0, 1], 2, 4)])
    age_s, pause_s = draw.choice([0.0, 0.0, 0.0, 0.2, 0.4, -1.0]), min(draw.seconds(), 0.3)
    sender = draw.choice(["ada", "ada", "ada", "bob"])
    for number in range(draw.choice([1, 1, 6])):
        world.take(pause_s if number else 0.0)
        world.take(Message(sender, axes, buttons, age_s))


def release(draw, world):
    sender = draw.choice(["ada", "ada", "ada", "bob"])
    world.take(Message(sender, (draw.choice([0.0, 0.05]), 0.0), (0, 0, 0, 0)))


def noise(draw, world):
    axes = [(0.0, math.nan), (math.inf, 0.0), (0.0,), *[draw.several(NUMBERS, 0, 4)] * 3]
    buttons = [(1, 0, 0, 0), (1, 0, 1), *[draw.several([0, 1, -1, 7], 0, 6)] * 2]
    world.take(Message("ada", draw.choice(axes), draw.choice(buttons)))


def stop_and_reset(draw, world):
    buttons = draw.choice([(0, 0, 1, 0), (0, 0, 0, 1), (1, 0, 0, 1), (0, 0, 1, 1)])
    world.take(Message("ada", (0.0, draw.choice([0.0, 1.0])), buttons))


def loss(draw, world):
    world.take(draw.choice([LEFT, SUSPENDED]))


def happen(draw, world, always, others):
    """Let 40 of these happen, always some of them, of the others those that the series has."""
    acts = always + draw.sample(others, draw.randint(0, len(others)))
    for _ in range(STEPS):
        draw.choice(acts)(draw, world)


@pytest.mark.parametrize("seed", SERIES)
def test_any_stick(seed):
    """Any stick at any time, with any parameters."""
    draw = Draw(seed)
    world = TeleoperationWorld(**draw.parameters())
    always, others = [joy, release], [time_passes, node_looks, noise, stop_and_reset, loss]
    happen(draw, world, always, others)


@pytest.mark.parametrize("seed", SERIES)
def test_any_commands(seed):
    """Any command of any sender on any of several inputs."""
    draw = Draw(seed)
    inputs = [
        Input(f"in {priority}", f"topic_{priority}", timeout, priority)
        for priority in draw.sample(range(100), draw.randint(1, 4))
        for timeout in [draw.choice([0.02, 0.5, 1.0, draw.uniform(0.02, 60)])]
    ]

    def command(draw, world):
        name, who, is_stick = draw.choice(inputs).name, draw.choice("ab"), draw.choice([0, 1])
        sender = Publisher(f"{who} on {name}", bool(is_stick), is_remote=True)
        forward = draw.choice([0.0, 0.5, math.nan, draw.uniform(-10, 10), draw.choice(NUMBERS)])
        velocity = draw.choice([(forward, *ZERO[1:]), draw.several(NUMBERS, 6, 6)])
        pause_s = draw.choice([0.0, 0.019, 0.02, 0.1])
        for again in range(draw.choice([1, 1, 3])):
            world.take(pause_s if again else 0.0)
            world.take(Command(name, velocity, sender))

    happen(draw, ArbiterWorld(inputs), [command], [time_passes, node_looks])
