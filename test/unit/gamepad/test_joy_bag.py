"""joy.bag is what the handout needs, and is exactly what its script writes."""

import math
from pathlib import Path

import pytest

rosbag1 = pytest.importorskip("rosbags.rosbag1", reason="no rosbags: ./tutorial setup")
pytest.importorskip("sensor_msgs.msg", reason="no ROS for this Python: ./tutorial setup")

import numpy as np  # noqa: E402
from rosbags.typesys import Stores, get_typestore  # noqa: E402

FOLDER = Path(__file__).resolve().parents[3] / "common" / "gamepad" / "bag"
LB = 4
PERIOD_S = 0.02
STEPS_OF_THE_DEVICE = 32767


@pytest.fixture(scope="module")
def recording():
    """Times and stamps [ns], axes and buttons of every Joy of joy.bag, as arrays."""
    store = get_typestore(Stores.ROS1_NOETIC)
    with rosbag1.Reader(FOLDER / "joy.bag") as bag:
        assert [(c.topic, c.msgtype) for c in bag.connections] == [("/joy", "sensor_msgs/msg/Joy")]
        rows = []
        for connection, time_ns, raw in bag.messages():
            joy = store.deserialize_ros1(raw, connection.msgtype)
            stamp_ns = joy.header.stamp.sec * 10**9 + joy.header.stamp.nanosec
            rows.append((time_ns, stamp_ns, joy.axes, joy.buttons))
    times, stamps, axes, buttons = map(np.array, zip(*rows))
    return times, stamps, axes.astype(float), buttons


def test_the_script_writes_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    import make_joy_bag  # noqa: PLC0415

    make_joy_bag.write_bag(tmp_path / "joy.bag")
    assert (tmp_path / "joy.bag").read_bytes() == (FOLDER / "joy.bag").read_bytes()


def test_it_is_an_f710_in_d_mode_at_50_hz(recording):
    times, stamps, axes, buttons = recording
    assert (axes.shape[1], buttons.shape[1]) == (6, 12)
    assert set(np.diff(times)) == {20_000_000} and (times == stamps).all()
    assert 50 <= (times[-1] - times[0]) / 1e9 <= 70
    steps = axes * STEPS_OF_THE_DEVICE
    assert abs(steps - steps.round()).max() < 0.01  # what float32 leaves of it


def test_lb_is_held_and_no_stick_rests_for_long_and_the_speed_is_a_turtlebots(recording):
    _, _, axes, buttons = recording
    assert not axes[[0, -1]].any() and not buttons[[0, -1]].any()
    assert buttons[axes.any(axis=1), LB].all()
    assert (buttons.sum(axis=1) == buttons[:, LB]).all()
    # So no ~vigilance_timeout stops a robot that it drives.
    changes = np.diff(axes, axis=0).any(axis=1) | np.diff(buttons, axis=0).any(axis=1)
    is_live = changes | ~axes[1:].any(axis=1)
    assert np.diff(np.flatnonzero(is_live)).max() * PERIOD_S < 0.1
    for values, least, most in ((axes[:, 1], 0.4, 0.7), (axes[:, 0], 0.5, math.pi)):
        assert least < values.max() <= most  # [m/s], [rad/s]
        assert abs(np.diff(values)).max() / PERIOD_S < 1.0  # [m/s2], [rad/s2]


def test_the_tour_closes_on_an_eight_a_spin_and_a_way_back(recording):
    _, _, axes, _ = recording
    # Plain small steps: another model than that of the script.
    forward, turn = (np.repeat(axes[:, i], 20) * PERIOD_S / 20 for i in (1, 0))
    heading = turn.cumsum()
    x = (forward * np.cos(heading - turn / 2)).cumsum()
    y = (forward * np.sin(heading - turn / 2)).cumsum()
    assert math.hypot(x[-1], y[-1]) < 1e-3
    assert math.remainder(heading[-1], math.tau) == pytest.approx(0, abs=1e-3)
    assert abs(turn[forward == 0]).sum() == pytest.approx(math.tau, abs=1e-3)
    assert -forward[forward < 0].sum() == pytest.approx(1.2, abs=1e-3)
    # The two loops of the eight are on opposite sides of where it starts and crosses itself.
    assert y.max() > 0.5 and x.min() < -0.5 and x.max() > 0.5
