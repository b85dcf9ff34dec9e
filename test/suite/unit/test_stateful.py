"""The rules of joy2twist and mux under any events at any time, judged by the invariants."""

import math

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from fake_turtlebot_sim.mux.arbitration import PublishingNode
from fake_turtlebot_sim.mux.parameters import Input
from tutorial_faults.arbiter_world import ZERO, ArbiterWorld, Command
from tutorial_faults.teleoperation_world import LEFT, Message, TeleoperationWorld
from tutorial_faults.worlds import SUSPENDED, TICK
from tutorial_testing.claims import claim

pytestmark = [
    claim("Late commands move nothing; a stick must rest first"),
    claim("(a) to (i), as the table of FAULTS.md has them"),
]
SETTINGS = settings(
    max_examples=200,
    stateful_step_count=40,
    deadline=None,
    derandomize=True,  # the same examples in every run
    suppress_health_check=list(HealthCheck),
)
# Each threshold of the rules, and just before it; else any time, mostly a short one.
THRESHOLDS_S = (0.02, 0.05, 0.1, 0.15, 0.25, 0.3, 0.45, 0.5, 0.6, 1.0)
times_s = [0.001, *THRESHOLDS_S, *(time_s - 1e-6 for time_s in THRESHOLDS_S)]
seconds = st.sampled_from(times_s) | st.floats(0, 1.5)
# Without numbers so small that half of them is 0.
sticks = st.floats(-1, 1, width=32).filter(lambda value: value == 0 or abs(value) > 1e-30)
any_number = st.floats(width=32).filter(lambda value: value == 0 or abs(value) > 1e-30)


class Rules(RuleBasedStateMachine):
    """Lets a World handle the events that hypothesis draws."""

    world = None

    @rule(pause=seconds)
    def time_passes(self, pause):
        self.world.take(float(pause))

    @rule(pause=seconds)
    def the_node_looks(self, pause):
        self.world.take(float(pause))
        self.world.take(TICK)


# The parameters that decide which way a message takes; with these a held stick drives.
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
SPEEDS = ("max_linear_speed", "max_angular_speed")
ACCELERATIONS = ("max_linear_acceleration", "max_angular_acceleration")
any_others = st.fixed_dictionaries({
    "axis_curve": st.sampled_from([1, 1, 2]),
    "inverted_reverse": st.booleans(),
    "joy_timeout": st.sampled_from([0, 0.02, 0.5, 3.0]),
    "max_joy_age": st.sampled_from([0, 0.3]),
    "stop_messages": st.integers(1, 7),
    "output_rate": st.floats(1, 1000),
    **dict.fromkeys(SCALES, st.floats(0.01, 100) | st.floats(-100, -0.01)),
    **dict.fromkeys(SPEEDS + ACCELERATIONS, st.just(0) | st.floats(0.01, 1000)),
})  # fmt: skip


def joined(*drawn):
    """Draw several dicts, joined: private parameters of joy2twist that fit together."""
    return st.tuples(*drawn).map(lambda parts: {k: v for part in parts for k, v in part.items()})


arming = st.sampled_from(ARMING)
stops = st.sampled_from([{}, STOPS])
parameters = joined(st.just(BASE), st.sampled_from(CHANGES), arming) | joined(
    any_others, st.sampled_from(BUTTONS), stops, arming
)
senders = st.sampled_from(["ada", "ada", "ada", "bob"])


class Teleoperation(Rules):
    """Any stick at any time, with any parameters."""

    @initialize(given=parameters)
    def start(self, given):
        self.world = TeleoperationWorld(**given)

    @rule(
        sender=senders,
        axes=st.sampled_from([(0.0, 1.0), (0.5, -1.0), (0.0, 0.0)])
        | st.lists(sticks, min_size=2, max_size=4),
        buttons=st.sampled_from([(1, 0, 0, 0), (0, 1, 0, 0)])
        | st.lists(st.sampled_from([0, 0, 1]), min_size=2, max_size=4),
        age=st.sampled_from([0.0, 0.0, 0.0, 0.2, 0.4, -1.0]),
        times=st.sampled_from([1, 1, 6]),
        pause=seconds,
    )
    def joy(self, sender, axes, buttons, age, times, pause):
        for number in range(times):
            self.world.take(float(min(pause, 0.3)) if number else 0.0)
            self.world.take(Message(sender, tuple(axes), tuple(buttons), age))

    @rule(sender=senders, stick=st.sampled_from([0.0, 0.05]))
    def release(self, sender, stick):
        self.world.take(Message(sender, (stick, 0.0), (0, 0, 0, 0)))

    @rule(
        axes=st.sampled_from([(0.0, math.nan), (math.inf, 0.0), (0.0,)])
        | st.lists(any_number, max_size=4),
        buttons=st.sampled_from([(1, 0, 0, 0), (1, 0, 1)])
        | st.lists(st.sampled_from([0, 1, -1, 7])),
    )
    def noise(self, axes, buttons):
        self.world.take(Message("ada", tuple(axes), tuple(buttons)))

    @rule(
        buttons=st.sampled_from([(0, 0, 1, 0), (0, 0, 0, 1), (1, 0, 0, 1), (0, 0, 1, 1)]),
        stick=st.sampled_from([0.0, 1.0]),
    )
    def stop_and_reset(self, buttons, stick):
        self.world.take(Message("ada", (0.0, stick), buttons))

    @rule(what=st.sampled_from([LEFT, SUSPENDED]))
    def loss(self, what):
        self.world.take(what)


timeouts = st.sampled_from([0.02, 0.5, 1.0]) | st.floats(0.02, 60)


def input_of(timeout, priority):
    return Input(f"in {priority}", f"topic_{priority}", timeout, priority)


any_input = st.builds(input_of, timeouts, st.integers(0, 99))
inputs = st.lists(any_input, min_size=1, max_size=4, unique_by=lambda given: given.priority)


class Mux(Rules):
    """Any command of any sender on any of several inputs."""

    @initialize(given=inputs)
    def start(self, given):
        self.names = [drawn.name for drawn in given]
        self.world = ArbiterWorld(given)

    @rule(
        number=st.integers(0, 3),
        who=st.sampled_from(["ada", "bob"]),
        is_stick=st.booleans(),
        velocity=st.sampled_from([ZERO, (0.5, *ZERO[1:]), (math.nan, *ZERO[1:])])
        | st.tuples(*[st.floats(-10, 10)] * 6)
        | st.tuples(*[st.floats()] * 6),
        times=st.sampled_from([1, 1, 3]),
        pause=st.sampled_from([0.0, 0.019, 0.02, 0.1]),
    )
    def command(self, number, who, is_stick, velocity, times, pause):
        name = self.names[number % len(self.names)]
        sender = PublishingNode(f"{who} on {name}", is_stick, is_remote=True)
        for again in range(times):
            self.world.take(pause if again else 0.0)
            self.world.take(Command(name, velocity, sender))


TestTeleoperation = Teleoperation.TestCase
TestMux = Mux.TestCase
TestTeleoperation.settings = TestMux.settings = SETTINGS
