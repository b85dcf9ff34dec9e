"""What pages may cost: time is a number."""

import pytest

from cockpit_server.budget import Budget

RATE = 0.25  # s/s


def test_a_burst_is_there_at_once_and_what_is_more_is_waited_for():
    budget = Budget(1.0)
    assert budget.wait_s(100.0, RATE) == 0.0
    budget.spend(1.0)
    assert budget.wait_s(100.0, RATE) == 0.0
    budget.spend(0.5)
    assert budget.wait_s(100.0, RATE) == 2.0
    assert budget.wait_s(101.0, RATE) == 1.0
    assert budget.wait_s(101.0, 2 * RATE) == 0.5
    assert budget.wait_s(102.0, RATE) == 0.0


def test_nobody_saves_more_than_a_burst():
    budget = Budget(1.0)
    budget.wait_s(0.0, RATE)
    budget.wait_s(1000.0, RATE)
    budget.spend(1.5)
    assert budget.wait_s(1000.0, RATE) == pytest.approx(2.0)


def test_a_clock_that_stands_still_gives_nothing():
    budget = Budget(1.0)
    budget.wait_s(10.0, RATE)
    budget.spend(2.0)
    assert [budget.wait_s(10.0, RATE) for _ in range(3)] == [4.0] * 3
