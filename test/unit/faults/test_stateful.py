"""What is not finite, and so cannot be gone through: any stick, any time, any parameter, at random.

Judged by the same Worlds as the exploration. derandomize: the same examples in every run.
"""

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from fake_turtlebot_sim.mux.arbitration import Publisher
from fake_turtlebot_sim.mux.parameters import Input
from gamepad.js_event import AXIS, BUTTON, INIT, SIGN_OF_LIFE_MS
from tutorial_faults import driver_world
from tutorial_faults.arbiter_world import ArbiterWorld, Configuration
from tutorial_faults.driver_world import DriverWorld
from tutorial_faults.events import Command
from tutorial_faults.explore import SUSPENDED, TICK
from tutorial_faults.teleoperation_alphabet import LEFT, Message
from tutorial_faults.teleoperation_world import TeleoperationWorld

SETTINGS = settings(
    max_examples=40,
    stateful_step_count=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=list(HealthCheck),
)
# Often what is near a threshold, and mostly short.
seconds = st.sampled_from([0.001, 0.049999, 0.05, 0.249999, 0.25, 0.499999, 0.5]) | st.floats(
    0, 1.5
)
# Without what is so small that half of it is 0.
sticks = st.floats(-1, 1, width=32).filter(lambda value: value == 0 or abs(value) > 1e-30)
any_number = st.floats(width=32).filter(lambda value: value == 0 or abs(value) > 1e-30)


class World(RuleBasedStateMachine):
    """Shows a World what the rules draw."""

    world = None

    def show(self, event):
        """No violation comes of an event."""
        wrong = self.world.take(event)
        assert not wrong, wrong

    @rule(pause=seconds)
    def time_passes(self, pause):
        self.show(float(pause))


@st.composite
def parameters(draw):
    """Private parameters of joy2twist that fit together; with all of them a held stick drives."""
    enable, turbo = draw(st.sampled_from([(-1, -1), (0, -1), (0, 1), (1, 0), (-1, 0)]))
    given = {
        "enable_button": enable,
        "enable_turbo_button": turbo,
        "require_enable_button": max(enable, turbo) >= 0 and draw(st.booleans()),
        "arm_on_neutral": draw(st.booleans()),
        "axis_curve": draw(st.sampled_from([1, 1, 2])),
        "inverted_reverse": draw(st.booleans()),
        "joy_timeout": draw(st.sampled_from([0, 0.02, 0.5, 3.0])),
        "max_joy_age": draw(st.sampled_from([0, 0.3])),
        "stop_messages": draw(st.integers(1, 7)),
        "output_rate": draw(st.floats(1, 1000)),
    }
    if given["arm_on_neutral"]:
        given["vigilance_timeout"] = draw(st.sampled_from([0, 1.0, 2.0]))
    if draw(st.booleans()):
        given.update(stop_button=2, stop_reset_button=3)
    for name in ("scale_linear", "scale_angular", "scale_linear_turbo"):
        given[name] = draw(st.floats(0.01, 100)) * draw(st.sampled_from([1, -1]))
    for name in ("max_linear_speed", "max_angular_speed"):
        given[name] = draw(st.just(0) | st.floats(0.01, 1000))
    for name in ("max_linear_acceleration", "max_angular_acceleration"):
        given[name] = draw(st.just(0) | st.floats(0.01, 1000))
    return given


class Teleoperation(World):
    """Any stick at any time, with any parameters."""

    @initialize(given=parameters())
    def start(self, given):
        self.world = TeleoperationWorld(**given)

    @rule(
        sender=st.sampled_from(["ada", "ada", "ada", "bob"]),
        axes=st.lists(sticks, min_size=2, max_size=4),
        buttons=st.lists(st.sampled_from([0, 0, 1]), min_size=2, max_size=4),
        age=st.sampled_from([0.0, 0.0, 0.0, 0.2, 0.4, -1.0]),
    )
    def joy(self, sender, axes, buttons, age):
        self.show(Message(sender, tuple(axes), tuple(buttons), age))

    @rule(sender=st.sampled_from(["ada", "bob"]))
    def release(self, sender):
        self.show(Message(sender, (0.0, 0.0), (0, 0, 0, 0)))

    @rule(axes=st.lists(any_number, max_size=4), buttons=st.lists(st.sampled_from([0, 1, -1, 7])))
    def noise(self, axes, buttons):
        self.show(Message("ada", tuple(axes), tuple(buttons)))

    @rule(what=st.sampled_from([TICK] * 4 + [LEFT, SUSPENDED]))
    def other(self, what):
        self.show(what)


@st.composite
def inputs(draw):
    """One to four inputs of a multiplexer."""
    priorities = draw(st.lists(st.integers(0, 99), min_size=1, max_size=4, unique=True))
    return tuple(
        Input(
            f"input {priority}",
            f"topic_{priority}",
            draw(st.sampled_from([0.02, 0.5, 1.0]) | st.floats(0.02, 60)),
            priority,
        )
        for priority in priorities
    )


class Mux(World):
    """Any command of any sender on any of several inputs."""

    @initialize(given=inputs())
    def start(self, given):
        self.names = [one.name for one in given]
        self.world = ArbiterWorld(Configuration(given, ()))

    @rule(
        number=st.integers(0, 3),
        sender=st.builds(Publisher, st.sampled_from(["ada", "bob"]), st.booleans(), st.just(True)),
        velocity=st.just((0.0,) * 6)
        | st.tuples(*[st.floats(-10, 10)] * 6)
        | st.tuples(*[st.floats()] * 6),
    )
    def command(self, number, sender, velocity):
        self.show(Command(0.0, self.names[number % len(self.names)], velocity, sender))

    @rule()
    def tick(self):
        self.show(TICK)


class Driver(World):
    """Any events of any gamepad, cut anywhere."""

    @initialize()
    def start(self):
        self.world = DriverWorld()

    @rule(what=st.sampled_from([TICK] * 3 + [driver_world.LOST, *driver_world.OPEN]))
    def other(self, what):
        self.show(what)

    @rule(
        kind=st.sampled_from([AXIS, BUTTON]),
        initial=st.sampled_from([0, 0, 0, INIT]),
        value=st.sampled_from([0, 1, 32767, -32768]) | st.integers(-32768, 32767),
        axis=st.integers(0, 5),
        is_sign=st.booleans(),
    )
    def read(self, kind, initial, value, axis, is_sign):
        number, time_ms = axis if kind == AXIS else 0, SIGN_OF_LIFE_MS if is_sign else 0
        data, cut = driver_world.event(kind | initial, value, number, time_ms), value % 8
        for piece in (data[:cut], data[cut:]):
            if piece:
                self.show(piece)


TestTeleoperation = Teleoperation.TestCase
TestMux = Mux.TestCase
TestDriver = Driver.TestCase
TestTeleoperation.settings = TestMux.settings = TestDriver.settings = SETTINGS
