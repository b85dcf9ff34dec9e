"""joy.bag is exactly what its script writes, and what the handout needs."""

import math

import numpy as np
import pytest
import rosbag

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

pytestmark = claim("joy.bag is what its script writes, and what the handout needs")
FOLDER = REPOSITORY / "common" / "gamepad" / "bag"
LB = 4
PERIOD_S = 0.02


def test_the_script_writes_the_same_bytes(tmp_path, monkeypatch):
    pytest.importorskip("rosbags.rosbag1", reason="no rosbags: ./tutorial setup")
    monkeypatch.syspath_prepend(str(FOLDER))
    import make_joy_bag  # noqa: PLC0415

    make_joy_bag.write_bag(tmp_path / "joy.bag")
    assert (tmp_path / "joy.bag").read_bytes() == (FOLDER / "joy.bag").read_bytes()


def test_lb_is_held_and_no_stick_rests_for_long_and_the_speed_is_a_turtlebots():
    with rosbag.Bag(str(FOLDER / "joy.bag")) as bag:
        joys = [joy for _, joy, _ in bag.read_messages()]
    axes, buttons = (np.array([getattr(joy, part) for joy in joys]) for part in ("axes", "buttons"))
    assert (axes.shape[1], buttons.shape[1]) == (6, 12)  # an F710 in D mode
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
