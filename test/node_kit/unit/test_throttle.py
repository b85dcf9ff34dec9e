"""Throttling to a rate, with bursts."""

from node_kit.rules.throttle import Throttle, ThrottleEach


def passed(throttle, times):
    return sum(throttle.ready(t) for t in times)


def test_a_series_is_thinned_to_the_rate_and_a_pause_saves_up_no_more_than_the_burst():
    throttle = Throttle(50, burst=5)
    assert 500 <= passed(throttle, [i / 1000 for i in range(10_000)]) <= 505
    assert passed(throttle, [1000.0] * 50) == 5
    uneven = [i / 50 + (0.004 if i % 2 else -0.004) for i in range(500)]
    assert passed(Throttle(50, burst=5), uneven) == 500
    assert passed(Throttle(0, burst=5), range(100)) == 0  # rate 0 means never


def test_one_text_does_not_hold_up_another():
    throttle = ThrottleEach(0.1)
    assert [throttle.ready(text, 0.0) for text in "aab"] == [True, False, True]
