"""What counts as released."""

import pytest

from node_kit.rules.released import are_released


@pytest.mark.parametrize(("deflections", "released"), [
    ((), True), ((0.0, -0.1, 0.1), True), ((0.0, 0.101), False), ((-0.101,), False),
    ((float("nan"), 0.0), False), ((0.0, float("inf")), False),
])  # fmt: skip
def test_sticks_are_released_within_a_tenth_of_their_way_and_nan_is_no_position(
    deflections, released
):
    assert are_released(deflections) is released
