"""Limiting how often something happens."""

from node_kit.throttle import Throttle, ThrottleEach


def passed(throttle, times):
    return sum(throttle.ready(t) for t in times)


def test_once_at_first_then_once_in_a_period():
    throttle = Throttle(0.5)
    assert [throttle.ready(t) for t in (0, 1, 1.9, 2, 3, 4)] == [
        True, False, False, True, False, True,
    ]  # fmt: skip


def test_a_fast_series_is_thinned_to_the_rate():
    times = [i / 1000 for i in range(10_000)]
    assert 500 <= passed(Throttle(50, burst=5), times) <= 505


def test_a_series_at_the_rate_passes_though_it_is_uneven():
    times = [i / 50 + (0.004 if i % 2 else -0.004) for i in range(500)]
    assert passed(Throttle(50, burst=5), times) == 500


def test_a_long_pause_saves_up_no_more_than_the_burst():
    throttle = Throttle(50, burst=5)
    throttle.ready(0)
    assert passed(throttle, [1000.0] * 50) == 5


def test_rate_zero_is_never():
    assert passed(Throttle(0, burst=5), range(100)) == 0


def test_a_burst_is_no_longer_than_said():
    throttle = Throttle(10, burst=3)
    assert passed(throttle, [5.0] * 10) == 3
    assert not throttle.ready(5.09)
    assert throttle.ready(5.11)


def test_a_rate_below_zero_is_never():
    assert passed(Throttle(-1), range(100)) == 0


def test_each_text_once_in_a_period():
    throttle = ThrottleEach(0.1)
    assert throttle.ready("a", 0.0)
    assert not throttle.ready("a", 9.9)
    assert throttle.ready("b", 9.9)
    assert throttle.ready("a", 10.0)
    assert not throttle.ready("b", 10.0)
