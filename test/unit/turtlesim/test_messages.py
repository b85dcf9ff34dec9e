"""Programs and recordings for the real turtlesim fit: a node of ROS 1 compares these sums."""

import pytest
from turtlesim import msg, srv

# The fields of ros/ros_tutorials, Noetic; `rosmsg md5` there.
UPSTREAM = {
    msg.Pose: "863b248d5016ca62ea2e895ae5265cf9",
    msg.Color: "353891e354491c51aabe32df673fb446",
    srv.Spawn: "0b2d2e872a8e2887d5ed626f2bf2c561",
    srv.Kill: "c1f3d28f1b044c871e6eff2e9fc3c667",
    srv.SetPen: "9f452acce566bf0c0954594f69a8e41b",
    srv.TeleportAbsolute: "a130bc60ee6513855dc62ea83fcc5b20",
    srv.TeleportRelative: "9d5c2dcd348ac8f76ce2a4307bd63a13",
}


@pytest.mark.parametrize("kind", UPSTREAM, ids=lambda kind: kind.__name__)
def test_a_message_has_the_md5_sum_of_the_real_one(kind):
    assert kind._md5sum == UPSTREAM[kind]
