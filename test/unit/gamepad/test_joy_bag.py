"""joy.bag is what the handout needs, and is exactly what its script writes."""

import math
import subprocess
from pathlib import Path

import pytest

rosbag1 = pytest.importorskip("rosbags.rosbag1", reason="no rosbags: ./tutorial setup")
pytest.importorskip("sensor_msgs.msg", reason="no ROS for this Python: ./tutorial setup")

from rosbags.typesys import Stores, get_typestore  # noqa: E402

FOLDER = Path(__file__).resolve().parents[3] / "common" / "gamepad" / "bag"
LB = 4
PERIOD_S = 0.02
STEPS_OF_THE_DEVICE = 32767


@pytest.fixture(scope="module")
def messages():
    """[(time [ns], Joy), ...] of joy.bag."""
    store = get_typestore(Stores.ROS1_NOETIC)
    with rosbag1.Reader(FOLDER / "joy.bag") as bag:
        assert [(c.topic, c.msgtype) for c in bag.connections] == [("/joy", "sensor_msgs/msg/Joy")]
        return [
            (time_ns, store.deserialize_ros1(raw, connection.msgtype))
            for connection, time_ns, raw in bag.messages()
        ]


def test_the_script_writes_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    import make_joy_bag  # noqa: PLC0415

    make_joy_bag.write_bag(tmp_path / "joy.bag")
    assert (tmp_path / "joy.bag").read_bytes() == (FOLDER / "joy.bag").read_bytes()


def test_rosbag_takes_it():
    command = ["rosbag", "check", str(FOLDER / "joy.bag")]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.strip() == "Bag file does not need any migrations."


def test_a_held_stick_never_rests_for_long(messages):
    """So no ~vigilance_timeout stops a robot that it drives."""
    still = longest = 0
    for (_, before), (_, joy) in zip(messages, messages[1:]):
        same = (joy.axes == before.axes).all() and (joy.buttons == before.buttons).all()
        still = still + 1 if same and joy.axes.any() else 0
        longest = max(longest, still)
    assert longest * PERIOD_S < 0.1


def test_it_is_an_f710_in_d_mode_at_50_hz(messages):
    assert {(len(joy.axes), len(joy.buttons)) for _, joy in messages} == {(6, 12)}
    times = [time_ns for time_ns, _ in messages]
    assert {after - before for before, after in zip(times, times[1:])} == {20_000_000}
    assert 50 <= (times[-1] - times[0]) / 1e9 <= 70
    for time_ns, joy in messages:
        assert joy.header.stamp.sec * 10**9 + joy.header.stamp.nanosec == time_ns


def test_it_starts_and_ends_neutral_and_moves_only_with_lb_held(messages):
    for _, joy in (messages[0], messages[-1]):
        assert not joy.axes.any()
        assert not joy.buttons.any()
    for _, joy in messages:
        assert joy.buttons[LB] or not joy.axes.any()
        assert joy.buttons.sum() == joy.buttons[LB]
        steps = joy.axes * STEPS_OF_THE_DEVICE
        assert (abs(steps - steps.round()) < 0.01).all()  # what float32 leaves of it


def test_it_stays_within_a_turtlebot_2_and_is_smooth(messages):
    forward = [float(joy.axes[1]) for _, joy in messages]
    turn = [float(joy.axes[0]) for _, joy in messages]
    assert 0.4 < max(forward) <= 0.7  # [m/s]
    assert 0.5 < max(turn) <= math.pi  # [rad/s]
    for speeds in (forward, turn):
        change = max(abs(after - before) for before, after in zip(speeds, speeds[1:]))
        assert change / PERIOD_S < 1.0  # [m/s2], [rad/s2]


def test_the_tour_closes_on_an_eight_a_spin_and_a_way_back(messages):
    x = y = heading = 0.0
    path, turned_on_the_spot, backed = [], 0.0, 0.0
    for _, joy in messages:
        forward, turn = float(joy.axes[1]), float(joy.axes[0])
        for _ in range(20):  # plain small steps: a model of its own
            middle = heading + turn * PERIOD_S / 40
            x += forward * PERIOD_S / 20 * math.cos(middle)
            y += forward * PERIOD_S / 20 * math.sin(middle)
            heading += turn * PERIOD_S / 20
        path.append((x, y))
        turned_on_the_spot += abs(turn) * PERIOD_S * (forward == 0)
        backed -= min(forward, 0) * PERIOD_S
    assert math.hypot(x, y) < 1e-3
    assert math.remainder(heading, 2 * math.pi) == pytest.approx(0, abs=1e-3)
    assert turned_on_the_spot == pytest.approx(2 * math.pi, abs=1e-3)
    assert backed == pytest.approx(1.2, abs=1e-3)
    # The two loops of the eight lie on opposite sides of where it starts and crosses itself.
    xs, ys = zip(*path)
    assert max(ys) > 0.5 and min(xs) < -0.5 and max(xs) > 0.5
