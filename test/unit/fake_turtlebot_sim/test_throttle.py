"""Each text once in a period, one not held up by another."""

from fake_turtlebot_sim.throttle import Throttle


def test_each_text_once_in_a_period():
    throttle = Throttle(10.0)
    assert throttle.ready("a", 0.0)
    assert not throttle.ready("a", 9.9)
    assert throttle.ready("b", 9.9)
    assert throttle.ready("a", 10.0)
    assert not throttle.ready("b", 10.0)
