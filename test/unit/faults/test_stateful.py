"""The rules of joy2twist and mux under any events at any time, judged by the invariants.

derandomize: the same examples in every run. Add Phase.shrink to see a short one.
"""

import itertools
import math

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from fake_turtlebot_sim.mux.arbitration import Publisher
from fake_turtlebot_sim.mux.parameters import Input
from tutorial_faults.arbiter_world import ZERO, ArbiterWorld, Command
from tutorial_faults.teleoperation_world import LEFT, Message, TeleoperationWorld
from tutorial_faults.worlds import SUSPENDED, TICK

SETTINGS = settings(
    max_examples=200,
    phases=[Phase.generate],
    deadline=None,
    derandomize=True,
    suppress_health_check=list(HealthCheck),
)
# Each threshold of the rules, and just before it; else any time, mostly short.
THRESHOLDS_S = (0.02, 0.05, 0.1, 0.15, 0.25, 0.3, 0.45, 0.5, 0.6, 1.0)
PAUSES_S = [0.001, *THRESHOLDS_S, *(one - 1e-6 for one in THRESHOLDS_S)]


def chosen(kind, *lists):
    """Draw kind() of one of each list: by a single number, which is quicker than by several."""
    return st.sampled_from([kind(*one) for one in itertools.product(*lists)])


# What happens in a row; a float is a time that passes [s].
waits = chosen(lambda pause: [pause], PAUSES_S) | st.floats(0, 1.5).map(lambda pause: [pause])
looks = chosen(lambda pause: [pause, TICK], PAUSES_S)


def series(event, times, pause):
    return [event] + [min(pause, 0.3), event] * (times - 1)


def in_any_order(*kinds):
    return st.lists(st.one_of(waits, looks, *kinds), min_size=40, max_size=40)


# Private parameters of joy2twist. A dead-man button that is needed, and one that is not.
BUTTONS = [
    {"enable_button": enable, "enable_turbo_button": turbo, "require_enable_button": is_needed}
    for enable, turbo in ((-1, -1), (0, -1), (0, 1), (1, 0), (-1, 0))
    for is_needed in (False, max(enable, turbo) >= 0)
]
ARMING = [{}, *({"arm_on_neutral": True, "vigilance_timeout": s} for s in (0, 0, 1.0, 2.0))]
STOPS = [{}, {"stop_button": 2, "stop_reset_button": 3}]
scales = st.just(0.5) | st.floats(0.01, 100) | st.floats(-100, -0.01)
limits = st.sampled_from([0, 0, 1.0]) | st.floats(0.01, 1000)
parameters = st.builds(
    lambda *drawn: {name: value for one in drawn for name, value in one.items()},
    chosen(lambda *drawn: {**drawn[0], **drawn[1], **drawn[2]}, BUTTONS, ARMING, STOPS),
    st.fixed_dictionaries({
        "axis_curve": st.sampled_from([1, 1, 2]),
        "inverted_reverse": st.booleans(),
        "joy_timeout": st.sampled_from([0, 0.02, 0.5, 0.5, 3.0]),
        "max_joy_age": st.sampled_from([0, 0.3]),
        "stop_messages": st.integers(1, 7),
        "output_rate": st.just(4.0) | st.floats(1, 1000),
        **dict.fromkeys(("scale_linear", "scale_angular", "scale_linear_turbo"), scales),
        "max_linear_speed": limits,
        "max_angular_speed": limits,
        "max_linear_acceleration": limits,
        "max_angular_acceleration": limits,
    }),
)  # fmt: skip
SENDERS = ["ada", "ada", "ada", "bob"]

joys = chosen(
    lambda sender, axes, buttons, age, *more: series(Message(sender, axes, buttons, age), *more),
    SENDERS,
    [(0.0, 1.0), (0.5, -1.0), (0.0, 0.0)],
    [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 0, 0)],
    [0.0, 0.0, 0.0, 0.2, 0.4, -1.0],
    [1, 1, 6],
    PAUSES_S,
)
releases = chosen(
    lambda sender, stick: [Message(sender, (stick, 0.0), (0,) * 4)], SENDERS, [0.0, 0.05]
)
noise = st.builds(
    lambda axes, buttons: [Message("ada", tuple(axes), tuple(buttons))],
    st.sampled_from([(0.0, math.nan), (math.inf, 0.0), (0.0,)])
    # Of 16 bits: none is so small that half of it is 0.
    | st.lists(st.floats(-1, 1, width=16), min_size=2, max_size=4)
    | st.lists(st.floats(width=16), max_size=4),
    st.sampled_from([(1, 0, 0, 0), (0, 1, 0, 0), (1, 0, 1)])
    | st.lists(st.sampled_from([0, 1, -1, 7]), max_size=4),
)
stops_and_resets = chosen(
    lambda buttons, stick: [Message("ada", (0.0, stick), buttons)],
    [(0, 0, 1, 0), (0, 0, 0, 1), (1, 0, 0, 1), (0, 0, 1, 1)],
    [0.0, 1.0],
)
losses = chosen(lambda what: [what], [LEFT, SUSPENDED])


@SETTINGS
@given(parameters, in_any_order(joys, joys, joys, releases, noise, stops_and_resets, losses))
def test_teleoperation(given, happens):
    world = TeleoperationWorld(**given)
    for event in itertools.chain(*happens):
        world.take(event)


timeouts = st.sampled_from([0.02, 0.5, 1.0]) | st.floats(0.02, 60)
inputs = st.dictionaries(st.integers(0, 99), timeouts, min_size=1, max_size=4).map(
    lambda drawn: [Input(f"in {n}", f"topic_{n}", timeout_s, n) for n, timeout_s in drawn.items()]
)
any_speed = st.floats(-10, 10) | st.floats()
velocities = chosen(lambda x: (x, *ZERO[1:]), [0.0, 0.5, 0.5, math.nan]) | st.builds(
    lambda x, yaw: (x, *ZERO[2:], yaw), any_speed, any_speed
)
senders = chosen(lambda *one: one, range(4), ["ada", "bob"], [False, True])
times = chosen(lambda *one: one, [1, 1, 3], [0.0, 0.019, 0.02, 0.1])
commands = st.builds(
    lambda who, what, when: series((*who, what), *when), senders, velocities, times
)


def command(inputs, number, who, is_stick, velocity):
    name = inputs[number % len(inputs)].name
    return Command(name, velocity, Publisher(f"{who} on {name}", is_stick, is_remote=True))


@SETTINGS
@given(inputs, in_any_order(commands, commands))
def test_mux(inputs, happens):
    world = ArbiterWorld(inputs)
    for event in itertools.chain(*happens):
        world.take(command(inputs, *event) if isinstance(event, tuple) else event)
