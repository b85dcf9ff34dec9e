"""The reaction of a robot that bumps into something."""

import pytest
from kobuki_msgs.msg import BumperEvent

from fake_turtlebot_sim.safety.parameters import parse_parameters
from fake_turtlebot_sim.safety.reaction import Reaction
from tutorial_testing.claims import claim

LEFT, CENTER, RIGHT = BumperEvent.LEFT, BumperEvent.CENTER, BumperEvent.RIGHT
BACK = (-0.1, 0.0)


@claim("A bumped robot backs off and turns away")
@pytest.mark.parametrize("kind", ["bumper", "cliff"])
@pytest.mark.parametrize(("sensors", "velocity"), [
    ([LEFT], (-0.1, -0.4)), ([RIGHT], (-0.1, 0.4)), ([CENTER], BACK),
    ([LEFT, CENTER], BACK), ([RIGHT, CENTER], BACK),
    ([RIGHT, LEFT], (-0.1, -0.4)),  # the left one wins, as on the Kobuki
])  # fmt: skip
def test_it_backs_off_and_turns_away(kind, sensors, velocity):
    reaction = Reaction(parse_parameters({}).time_to_extend_bump_cliff_events)
    assert reaction.velocity(0.0) is None
    for sensor in sensors:
        reaction.event(kind, sensor, True, 1.0)
    assert reaction.velocity(1.0) == reaction.velocity(9.0) == velocity
    for sensor in sensors:
        reaction.event(kind, sensor, False, 9.0)
    assert reaction.velocity(9.0) is None


def test_with_a_dropped_wheel_it_stands():
    reaction = Reaction(5.0)
    reaction.event("bumper", CENTER, True, 0.0)
    reaction.event("wheel_drop", LEFT, True, 0.0)
    assert reaction.velocity(0.0) == (0.0, 0.0)
    reaction.event("wheel_drop", LEFT, False, 1.0)
    assert reaction.velocity(1.0) == BACK  # for a wheel there is no extra time


def test_a_press_counts_for_a_while_even_if_it_is_released_or_reset():
    """Like kobuki_safety_controller: from the last press of any sensor on, even after a ~reset."""
    reaction = Reaction(2.0)
    reaction.event("cliff", RIGHT, False, 0.0)  # it was never active
    assert reaction.velocity(0.0) is None
    reaction.event("cliff", RIGHT, True, 1.0)
    assert reaction.velocity(1.0) == (-0.1, 0.4)
    reaction.event("cliff", RIGHT, False, 1.1)
    reaction.reset()
    assert reaction.velocity(2.9) == (-0.1, 0.4)
    assert reaction.velocity(3.0) is None
    reaction.event("bumper", LEFT, True, 5.0)
    assert reaction.velocity(8.0) == (-0.1, -0.4)  # it is still pressed
    reaction.event("bumper", LEFT, False, 9.0)
    assert reaction.velocity(9.0) is None  # no extra time after the release


def test_a_reset_forgets_what_is_pressed():
    reaction = Reaction(0.0)
    reaction.event("bumper", CENTER, True, 1.0)
    assert reaction.velocity(1.0) == BACK
    reaction.reset()
    assert reaction.velocity(1.0) is None
