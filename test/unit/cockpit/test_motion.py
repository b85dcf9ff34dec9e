"""Where a robot is, and the way that it has covered, from its odometry."""

from math import nan

import pytest

from cockpit_server.motion import Motion, covered


@pytest.mark.parametrize(
    ("x", "yaw", "way"),
    [(1.1, 0.5, 7.1), (1.1, 0.0, 7.1), (1.6, 0.5, 7.0), (0.0, 0.0, 0.0), (nan, 0.5, 7.0)],
    ids=["drives", "drives straight", "was carried", "was reset", "is nowhere"],
)
def test_way_grows_only_by_driving(x, yaw, way):
    last = Motion(1.0 if x else 0.2, 0.0, yaw, 0.5, 0.0)
    assert covered(last, Motion(x, 0.0, yaw, 0.5, 0.0), 7.0) == pytest.approx(way)
